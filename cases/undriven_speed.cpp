#include "cases/undriven_speed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cases/opening.hpp"
#include "cases/point_field.hpp"
#include "cases/table_file.hpp"

namespace puffin::cases {
namespace {

double largest_body_force(const Case& c) {
  const auto* file = std::get_if<ForceFile>(&c.air.body_force);
  if (file == nullptr) return std::get<Vec3>(c.air.body_force).norm();
  const Columns columns = read_columns(file->file, {"time", "fx", "fy", "fz"});
  double largest = 0.0;
  for (std::size_t n = 0; n < columns.at("time").size(); ++n) {
    if (n > 0 && columns.at("time")[n - 1] > c.stop.time) break;
    largest = std::max(largest, Vec3(columns.at("fx")[n], columns.at("fy")[n], columns.at("fz")[n]).norm());
  }
  return largest;
}

/// Pressures apart at the outlets [Pa], and the smallest of these openings [m^2].
struct Openings {
  double low = 0.0, high = 0.0, area = 0.0;
};
Openings openings(const Case& c, const Surface& s) {
  Openings o;
  for (const Boundary& b : c.air.boundaries) {
    if (b.type != BoundaryType::pressure_outlet) continue;
    const double area = s.area_of(b.patch);
    const bool first = !(o.area > 0.0);
    o.low = first ? b.pressure : std::min(o.low, b.pressure);
    o.high = first ? b.pressure : std::max(o.high, b.pressure);
    o.area = first ? area : std::min(o.area, area);
  }
  return o;
}

}  // namespace

EstimatedSpeed estimated_speed(const Case& c, const Surface& s) {
  const double rho = c.air.density, force = largest_body_force(c);
  const Openings ends = openings(c, s);
  const double apart = ends.high - ends.low;
  double start = 0.0, gradient = force;
  if (c.air.initial == InitialField::file)
    for (const Vec3& u : read_point_rows(c.air.initial_file).values) start = std::max(start, u.norm());
  if (apart > 0.0) gradient += apart * ends.area / s.volume;

  double driven = 0.0;
  if (gradient > 0.0) {
    double walls = 0.0;
    for (const std::string& patch : s.patches.names)
      if (is_resting_wall(c.air, patch)) walls += s.area_of(patch);
    driven = force > 0.0 ? gradient * c.stop.time / rho : std::sqrt(2.0 * apart / rho);
    if (walls > 0.0) {
      const double diameter = 4.0 * s.volume / walls;
      driven = std::min({driven, gradient * diameter * diameter / (32.0 * c.air.viscosity),
                         std::sqrt(2.0 * gradient * diameter / (0.03 * rho))});
    }
  }

  EstimatedSpeed speed{std::max(start, driven), {}};
  if (!(speed.value > 0.0)) return speed;
  char text[240];
  std::snprintf(text, sizeof text,
                "no boundary gives the speed of the air; %.3g m/s is taken as reference_speed, from %s: set "
                "numerics.reference_speed if that is far from it",
                speed.value,
                start >= driven ? "the file it starts with"
                : force > 0.0   ? "the body force"
                                : "the pressures at the openings");
  speed.warning = text;
  return speed;
}

}  // namespace puffin::cases
