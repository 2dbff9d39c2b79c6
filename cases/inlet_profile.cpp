#include "cases/inlet_profile.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "cases/check_boundaries.hpp"
#include "cases/point_field.hpp"

namespace puffin::cases {

namespace {

using lbm::geometry::GeometryError;

/// One direction of the rectangle as half of a channel: distance from the fastest place over the half width.
struct Across {
  bool walls = false;
  double half = 0.0;    // [m] from the fastest place to the wall
  double offset = 0.0;  // [m] of the fastest place
};

Across across(const Opening& o, int d) {
  if (o.wall[d][0] && o.wall[d][1]) return {true, o.half[d], 0.0};
  if (o.wall[d][0]) return {true, 2.0 * o.half[d], o.half[d]};
  if (o.wall[d][1]) return {true, 2.0 * o.half[d], -o.half[d]};
  return {};
}

double parabola(double s, double half) { return std::max(0.0, 1.0 - (s / half) * (s / half)); }

std::function<double(const Vec3&)> rectangle_shape(const Boundary& b, const Opening& o) {
  const Across sides[2] = {across(o, 0), across(o, 1)};
  if (!sides[0].walls && !sides[1].walls) return [](const Vec3&) { return 1.0; };
  if (b.profile == Profile::parabolic || !sides[0].walls || !sides[1].walls) {
    const int d = sides[1].walls ? 1 : 0;
    return [o, d, side = sides[d]](const Vec3& x) { return parabola(o.coordinates(x)[d] - side.offset, side.half); };
  }
  const int narrow = sides[0].half < sides[1].half ? 0 : 1, wide = 1 - narrow;
  return [o, narrow, wide, n = sides[narrow], w = sides[wide]](const Vec3& x) {
    const auto at = o.coordinates(x);
    return duct_series(at[narrow] - n.offset, at[wide] - w.offset, n.half, w.half);
  };
}

std::function<double(const Vec3&)> shape_of(const Boundary& b, const Opening& o) {
  const auto refuse = [&](const std::string& form, double part) {
    if (part < (form == "circle" ? 0.90 : 0.98))
      throw GeometryError("profile \"" +
                          std::string(b.profile == Profile::pipe   ? "pipe"
                                      : b.profile == Profile::duct ? "duct"
                                                                   : "parabolic") +
                          "\" needs a " + form + ": " + o.name + " fills only " +
                          std::to_string(std::lround(100.0 * part)) + " % of the smallest around it; give " +
                          "profile = { file = ... } or \"plug\"");
  };
  switch (b.profile) {
    case Profile::duct:
    case Profile::parabolic:
      refuse("rectangle", o.area / (4.0 * o.half[0] * o.half[1]));
      return rectangle_shape(b, o);
    case Profile::pipe:
      refuse("circle", o.area / (std::numbers::pi * o.radius * o.radius));
      return [o](const Vec3& x) {
        const Vec3 from = x - o.centroid;
        return std::max(0.0, 1.0 - (from - from.dot(o.normal) * o.normal).squaredNorm() / (o.radius * o.radius));
      };
    default:
      return [](const Vec3&) { return 1.0; };
  }
}

/// The file's velocities over the patch; points and places are taken in the plane of the patch.
std::function<Vec3(const Vec3&)> velocity_from_file(const std::string& file, const Opening& o) {
  const PointRows rows = read_point_rows(file);
  std::vector<Vec3> flat;
  for (const Vec3& p : rows.points) flat.emplace_back(o.coordinates(p)[0], o.coordinates(p)[1], 0.0);
  try {
    const auto field = std::make_shared<const PointField>(std::move(flat), rows.values);
    return [field, o](const Vec3& x) { return field->at(Vec3(o.coordinates(x)[0], o.coordinates(x)[1], 0.0)); };
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(file + ", in the plane of the patch: " + e.what());
  }
}

}  // namespace

double duct_series(double y, double z, double a, double b) {
  if (std::abs(y) >= a || std::abs(z) >= b) return 0.0;
  constexpr double pi = std::numbers::pi;
  double sum = 0.0, sign = 1.0;
  for (int n = 1; n < 400; n += 2, sign = -sign) {
    const double k = n * pi / (2.0 * a);
    // cosh(kz)/cosh(kb) without overflow
    const double ratio =
        std::exp(k * (std::abs(z) - b)) * (1.0 + std::exp(-2.0 * k * std::abs(z))) / (1.0 + std::exp(-2.0 * k * b));
    if (ratio < 1e-14) break;
    sum += sign / (static_cast<double>(n) * n * n) * ratio * std::cos(k * y);
  }
  return std::max(0.0, 1.0 - (y / a) * (y / a) - 32.0 / (pi * pi * pi) * sum);
}

InletProfile profile_of(const Boundary& b, const Surface& surface, const Opening& o) {
  const double finest = o.half[1] / 8.0;
  InletProfile profile;
  std::function<Vec3(const Vec3&)> given;
  if (b.profile == Profile::file) {
    given = velocity_from_file(b.profile_file, o);
  } else {
    Vec3 direction = -o.normal;
    if (const auto* v = std::get_if<Velocity>(&b.flow)) direction = v->value / -v->value.dot(o.normal);
    if (b.profile == Profile::plug) {
      profile.shape = [direction](const Vec3&) { return direction; };
      return profile;
    }
    given = [direction, f = shape_of(b, o)](const Vec3& x) -> Vec3 { return f(x) * direction; };
  }
  const double mean =
      integral_over(surface, o, finest, [&](const Vec3& x) { return -given(x).dot(o.normal); }) / o.area;
  if (!(mean > 0.0))
    throw std::invalid_argument(b.profile_file + ": the mean flow of the profile over " + o.name +
                                " does not point into the fluid");
  if (b.profile == Profile::file) profile.mean = mean;
  profile.shape = [given, mean](const Vec3& x) -> Vec3 { return given(x) / mean; };
  return profile;
}

InletProfile profile_of(const Boundary& b, const Surface& surface, const Inlet& inlet) {
  if (!inlet.parts) return profile_of(b, surface, inlet.openings.front());
  InletProfile all;
  std::vector<std::function<Vec3(const Vec3&)>> shapes;
  for (const Opening& o : inlet.openings) shapes.push_back(profile_of(b, surface, o).shape);
  all.shape = [shapes, parts = inlet.parts](const Vec3& x) -> Vec3 {
    const int p = parts->nearest(x);
    return parts->share[p] * shapes[p](x);
  };
  return all;
}

void complete_file_profiles(const Surface& surface, Case& c) {
  for (std::size_t i = 0; i < c.air.boundaries.size(); ++i) {
    Boundary& b = c.air.boundaries[i];
    if (b.type != BoundaryType::velocity_inlet || b.profile != Profile::file || b.flow.index() != 0) continue;
    if (surface.patches.find(b.patch) < 0) continue;
    b.flow = MeanSpeed{from_file(c, "air.boundary[" + std::to_string(i) + "].profile", [&] {
                         return profile_of(b, surface, inlet_of(c, surface, b));
                       }).mean};
  }
}

}  // namespace puffin::cases
