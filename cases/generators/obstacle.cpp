// A duct with a sphere, a cylinder or a cube in it. One corner of the duct lies in the origin.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cases/generators/faces.hpp"
#include "cases/generators/kinds.hpp"

namespace puffin::cases::generators {
namespace {

using enum Provenance;
using enum Range;
constexpr double mm = 1e-3;

Vec3 duct_size(const Values& v) { return {v.number("length"), v.number("width"), v.number("height")}; }
Vec3 centre_of(const Values& v) { return Vec3(v.numbers("center").data()); }

/// Surface of a sphere, outside towards its centre: the faces of an icosahedron, each divided into n x n triangles and
/// thrown onto the sphere.
void add_sphere(const Vec3& centre, double radius, int n, Surface& surface) {
  const double g = std::numbers::phi;
  const std::array<Vec3, 12> v = {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0),
                                  Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g), Vec3(0, 1, -g),
                                  Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)};
  constexpr int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (const auto& f : faces) {
    const auto point = [&](int i, int j) -> Vec3 {
      const Vec3 p = v[f[0]] + (v[f[1]] - v[f[0]]) * i / n + (v[f[2]] - v[f[0]]) * j / n;
      return centre + radius * p.normalized();
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        surface.add("obstacle", {point(i, j), point(i, j + 1), point(i + 1, j)});
        if (i + j + 1 < n) surface.add("obstacle", {point(i + 1, j), point(i, j + 1), point(i + 1, j + 1)});
      }
  }
}

void add_cube(const Vec3& centre, double edge, Surface& surface) {
  const Vec3 low = centre.array() - 0.5 * edge, high = centre.array() + 0.5 * edge;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 u = edge * Vec3::Unit((axis + 1) % 3), w = edge * Vec3::Unit((axis + 2) % 3);
    add_parallelogram("obstacle", low, u, w, surface);     // u x w along +axis: into the cube
    add_parallelogram("obstacle", high, -w, -u, surface);  // along -axis
  }
}

void add_obstacle_duct(const Values& v, Surface& surface) {
  const Vec3 size = duct_size(v), centre = centre_of(v);
  const double diameter = v.number("diameter");
  const bool named = v.flag("periodic");
  const Section section{0.0, size.y(), 0.0, size.z()};
  surface.declare({"inlet", "outlet", "wall", "x-min", "x-max", "y-min", "y-max", "z-min", "z-max", "obstacle"});
  add_end(named ? "x-min" : "inlet", 0.0, section, false, surface);
  add_end(named ? "x-max" : "outlet", size.x(), section, true, surface);
  std::vector<Loop> floor_hole, ceiling_hole;
  if (v.word("shape") == "cylinder") {
    const int n = ring_corners(0.5 * diameter, v.number("facet_size"), 96);
    const Loop low = ring({centre.x(), centre.y(), 0.0}, Vec3::UnitX(), Vec3::UnitY(), 0.5 * diameter, n);
    const Loop high = ring({centre.x(), centre.y(), size.z()}, Vec3::UnitX(), Vec3::UnitY(), 0.5 * diameter, n);
    add_band("obstacle", reversed(low), reversed(high), surface);
    floor_hole.push_back(low);
    ceiling_hole.push_back(high);
  } else if (v.word("shape") == "sphere") {
    add_sphere(centre, 0.5 * diameter, ring_corners(0.5 * diameter, v.number("facet_size"), 96) / 6, surface);
  } else {
    add_cube(centre, diameter, surface);
  }
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z()), o = Vec3::Zero();
  add_parallelogram(named ? "y-min" : "wall", o, x, z, surface);
  add_parallelogram(named ? "y-max" : "wall", y, z, x, surface);
  surface.add(named ? "z-min" : "wall", {o, y, x + y, x}, floor_hole);
  surface.add(named ? "z-max" : "wall", {z, z + x, z + x + y, z + y}, ceiling_hole);
}

void complete_obstacle(Values& v, Problems& problems) {
  const Vec3 size = duct_size(v);
  if (v.numbers("center").empty()) v.set("center", std::vector<double>{size.x() / 3.0, size.y() / 2.0, size.z() / 2.0});
  if (v.numbers("center").size() != 3) {
    problems.push_back({"center", "has " + std::to_string(v.numbers("center").size()) + " numbers; it needs x, y, z"});
    return;
  }
  choose_facet_size(v, std::max(0.25 * std::min(size.minCoeff(), v.number("diameter")), 0.01 * size.norm()));
  const Vec3 centre = centre_of(v);
  const int across = v.word("shape") == "cylinder" ? 2 : 3;  // a cylinder stands from floor to ceiling
  for (int axis = 0; axis < across; ++axis) {
    const double gap = std::min(centre[axis], size[axis] - centre[axis]) - 0.5 * v.number("diameter");
    if (gap <= 1e-6 * size[axis])
      problems.push_back({"diameter", std::string("makes the obstacle touch or cross the ") + "xyz"[axis] +
                                          "-faces of the duct (it reaches " + millimetres(std::max(0.0, -gap)) +
                                          " beyond); lower diameter or move center"});
  }
}

}  // namespace

Kind obstacle_kind() {
  return {
      "obstacle",
      "a duct with a sphere, a cylinder (upright, from floor to ceiling) or a cube in it; a corner in the origin",
      {{"length", 40.0 * mm, "m", "length (x) of the duct", assumed, positive},
       {"width", 10.0 * mm, "m", "width (y) of the duct", assumed, positive},
       {"height", 10.0 * mm, "m", "height (z) of the duct", assumed, positive},
       {"shape", std::string("sphere"), "", "sphere, cylinder or cube", assumed, any, {"sphere", "cylinder", "cube"}},
       {"diameter", 2.0 * mm, "m", "diameter; the edge of a cube", assumed, positive},
       {"center", std::vector<double>{}, "m", "centre; empty: mid-section, a third of the length from the inlet",
        assumed, any},
       {"periodic", false, "", "name the six outer faces x-min ... z-max, as a box has them", assumed},
       facet_size_info(0.0)},
      complete_obstacle,
      add_obstacle_duct,
      [](const Values& v) {
        const Vec3 size = duct_size(v);
        KeyPoints points;
        points.inlet = Vec3(0.0, 0.5 * size.y(), 0.5 * size.z());
        points.outlet = Vec3(size.x(), 0.5 * size.y(), 0.5 * size.z());
        points.path_length = size.x();
        return points;
      }};
}

}  // namespace puffin::cases::generators
