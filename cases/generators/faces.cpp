#include "cases/generators/faces.hpp"
#include "cases/generators/outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace puffin::cases::generators {
namespace {

/// The different coordinates, ascending; what differs by rounding is one.
std::vector<double> grid_lines(std::vector<double> coordinates) {
  std::sort(coordinates.begin(), coordinates.end());
  const double rounding = 1e-9 * (coordinates.back() - coordinates.front());
  coordinates.erase(
      std::unique(coordinates.begin(), coordinates.end(), [rounding](double a, double b) { return b - a <= rounding; }),
      coordinates.end());
  return coordinates;
}

}  // namespace

void add_parallelogram(std::string_view solid, const Vec3& corner, const Vec3& u, const Vec3& v, Surface& surface) {
  surface.add(solid, {corner, corner + u, corner + u + v, corner + v});
}

void add_sides(const SideNames& names, double x0, double x1, const Section& section, Surface& surface) {
  const Vec3 x(x1 - x0, 0, 0), y(0, section.y1 - section.y0, 0), z(0, 0, section.z1 - section.z0);
  const Vec3 low(x0, section.y0, section.z0);
  add_parallelogram(names.y_min, low, x, z, surface);
  add_parallelogram(names.y_max, low + y, z, x, surface);
  add_parallelogram(names.z_min, low, y, x, surface);
  add_parallelogram(names.z_max, low + z, x, y, surface);
}

void add_end(std::string_view solid, double x, const Section& section, bool outside_at_plus_x, Surface& surface) {
  const Vec3 corner(x, section.y0, section.z0);
  const Vec3 y(0, section.y1 - section.y0, 0), z(0, 0, section.z1 - section.z0);
  if (outside_at_plus_x)
    add_parallelogram(solid, corner, y, z, surface);
  else
    add_parallelogram(solid, corner, z, y, surface);
}

void add_section_change(std::string_view solid, double x, const Section& before, const Section& after,
                        Surface& surface) {
  const auto holds = [](const Section& s, const Vec3& p) {
    return p.y() > s.y0 && p.y() < s.y1 && p.z() > s.z0 && p.z() < s.z1;
  };
  const std::vector<double> ys = grid_lines({before.y0, before.y1, after.y0, after.y1});
  const std::vector<double> zs = grid_lines({before.z0, before.z1, after.z0, after.z1});
  for (std::size_t j = 0; j + 1 < ys.size(); ++j)
    for (std::size_t k = 0; k + 1 < zs.size(); ++k) {
      const Section cell{ys[j], ys[j + 1], zs[k], zs[k + 1]};
      const bool fluid_before = holds(before, cell.centre(x)), fluid_after = holds(after, cell.centre(x));
      if (fluid_before != fluid_after) add_end(solid, x, cell, fluid_before, surface);
    }
}

Loop ring(const Vec3& centre, const Vec3& e1, const Vec3& e2, double radius, int corners) {
  Loop loop;
  for (int k = 0; k < corners; ++k) {
    const double a = 2.0 * std::numbers::pi * k / corners;
    loop.push_back(centre + radius * (std::cos(a) * e1 + std::sin(a) * e2));
  }
  return loop;
}

void add_band(std::string_view solid, const Loop& from, const Loop& to, Surface& surface) {
  double chord = 0.0, length = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    chord = std::max(chord, (from[(k + 1) % from.size()] - from[k]).norm());
    length = std::max(length, (to[k] - from[k]).norm());
  }
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / (3.0 * chord))));
  Loop low = from;
  for (int piece = 1; piece <= pieces; ++piece) {
    Loop high = to;
    for (std::size_t k = 0; k < from.size() && piece < pieces; ++k)
      high[k] = from[k] + (to[k] - from[k]) * piece / pieces;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const std::size_t next = (k + 1) % from.size();
      surface.add(solid, {low[k], low[next], high[next], high[k]});
    }
    low = high;
  }
}

Loop reversed(const Loop& loop) { return {loop.rbegin(), loop.rend()}; }

int ring_corners(double radius, double facet_size, int at_least) {
  const double corners = std::ceil(2.0 * std::numbers::pi * radius / facet_size);
  refuse_too_many_corners(corners);
  return std::max(at_least, static_cast<int>(corners));
}

}  // namespace puffin::cases::generators
