#include "cases/room.hpp"

#include <cmath>
#include <cstdio>

#include "cases/derived.hpp"
#include "cases/units.hpp"

namespace puffin::cases {
namespace {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

bool has_lattice(const Case& c) { return c.air.model == AirModel::lbm || c.numerics.dx || c.numerics.cells; }

}  // namespace

double cells_in_box(const Surface& s, double dx) {
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  for (const Vec3& v : s.mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return s.mesh.vertices.empty() ? 0.0 : ((high - low) / dx).array().max(1.0).prod();
}

double least_memory(const Case& c, const Surface& s) {
  constexpr double parcel = 200.0;  // position, velocity, spin, size, fines and their copies [byte]
  double bytes =
      c.carriers ? parcel * static_cast<double>(c.carriers->count) / static_cast<double>(c.carriers->parcel) : 0.0;
  if (!has_lattice(c)) return bytes;
  const double dx = cell_size(c.numerics, s.volume);
  const double populations = 19.0 * (c.numerics.precision == Precision::float64 ? 8.0 : 4.0);
  return bytes + cells_in_box(s, dx) / 8.0 + populations * s.volume / (dx * dx * dx);
}

void require_room(const Case& c, const Surface& s, double available) {
  if (has_lattice(c)) {
    const double dx = cell_size(c.numerics, s.volume), cells = cells_in_box(s, dx);
    if (!(cells < most_cells))
      throw TooLarge("a dx of " + format_quantity(dx, unit::length) + " makes " + digits(cells) +
                     " cells in the box around the device, more than " + digits(most_cells) +
                     "; take a larger dx, or check the unit of the geometry");
  }
  const double memory = least_memory(c, s);
  if (!(memory < available))
    throw TooLarge("the run needs at least " + digits(memory / 1e9) + " GB of memory, " + digits(available / 1e9) +
                   " GB are available; take a larger dx, fewer carriers or larger parcels");
}

}  // namespace puffin::cases
