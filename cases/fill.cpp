#include "cases/fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cases/check_boundaries.hpp"
#include "cases/size_distribution.hpp"

namespace puffin::cases {

namespace {

/// The lowest part of a patch that faces down (with the carriers' weight): its centre, and the diameter of the circle
/// of its area, or, where that sticks out of its sides, of the largest around the centre that does not.
struct Floor {
  Vec3 centre = Vec3::Zero();
  double diameter = 0.0;
};

/// Distance of a point from the nearest edge that only one of the triangles has.
double distance_to_border(const lbm::geometry::TriangleMesh& mesh, const std::vector<int>& triangles, const Vec3& x) {
  std::map<std::pair<int, int>, int> sides;
  for (const int t : triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      ++sides[{std::min(a, b), std::max(a, b)}];
    }
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [edge, count] : sides) {
    if (count != 1) continue;
    const Vec3 from = mesh.vertices[edge.first], along = mesh.vertices[edge.second] - from;
    const double part = std::clamp(along.dot(x - from) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (from + part * along - x).norm());
  }
  return nearest;
}

/// Is a point of their plane on one of the triangles?
bool covers(const lbm::geometry::TriangleMesh& mesh, const std::vector<int>& triangles, const Vec3& x) {
  return std::any_of(triangles.begin(), triangles.end(), [&](int t) {
    const Vec3 normal = mesh.area_vector(t);
    for (int k = 0; k < 3; ++k) {
      const Vec3 from = mesh.corner(t, k), along = mesh.corner(t, (k + 1) % 3) - from;
      if (along.cross(x - from).dot(normal) < -1e-9 * normal.squaredNorm()) return false;
    }
    return true;
  });
}

Floor floor_of(const Surface& surface, const std::string& patch, const Vec3& gravity) {
  const Vec3 down = gravity.norm() > 0.0 ? Vec3(gravity.normalized()) : Vec3(-Vec3::UnitZ());
  const int wanted = surface.patches.find(patch);
  const auto faces_down = [&](int t) { return surface.mesh.area_vector(t).normalized().dot(down) > 0.99; };
  const auto depth = [&](int t) {
    return down.dot(surface.mesh.corner(t, 0) + surface.mesh.corner(t, 1) + surface.mesh.corner(t, 2)) / 3.0;
  };
  double lowest = -1e300;
  for (int t = 0; t < static_cast<int>(surface.mesh.triangles.size()); ++t)
    if (surface.patches.of_triangle[t] == wanted && faces_down(t)) lowest = std::max(lowest, depth(t));
  if (lowest == -1e300)
    throw std::invalid_argument("the patch '" + patch +
                                "' has no face that carriers can lie on; give a point [x, y, z] instead");
  Floor floor;
  double area = 0.0;
  std::vector<int> of_floor;
  const double tolerance = 1e-6 + 1e-3 * std::abs(lowest);
  for (int t = 0; t < static_cast<int>(surface.mesh.triangles.size()); ++t) {
    if (surface.patches.of_triangle[t] != wanted || !faces_down(t) || depth(t) < lowest - tolerance) continue;
    const double a = surface.mesh.area(t);
    of_floor.push_back(t);
    area += a;
    floor.centre += a / 3.0 * (surface.mesh.corner(t, 0) + surface.mesh.corner(t, 1) + surface.mesh.corner(t, 2));
  }
  floor.centre /= area;
  floor.diameter = 2.0 * std::sqrt(area / std::numbers::pi);
  if (!covers(surface.mesh, of_floor, floor.centre))
    throw std::invalid_argument("the middle of the patch '" + patch +
                                "' is not on it (a ring, an angle); give a point [x, y, z] instead");
  // A polygon of 10 sides or more counts as round: its inner circle has 0.983 of the diameter of that of its area.
  const double inner = 2.0 * distance_to_border(surface.mesh, of_floor, floor.centre);
  if (inner < 0.98 * floor.diameter) floor.diameter = inner;
  return floor;
}

}  // namespace

Dose dose_of(const Case& described, const Surface& surface, const lbm::geometry::TriangleTree& tree) {
  const Carriers& c = *described.carriers;
  DoseSpec spec;
  spec.shape = c.fill->shape == FillShape::cube   ? DoseShape::cube
               : c.fill->shape == FillShape::file ? DoseShape::file
                                                  : DoseShape::cylinder;
  spec.carriers = c.count;
  spec.parcel = c.parcel;
  spec.diameter = c.diameter;
  if (c.sizes) {
    spec.sizes = draw_diameters(size_table(*c.sizes), c.count / c.parcel, described.numerics.seed);
    spec.diameter = *std::max_element(spec.sizes.begin(), spec.sizes.end());
  }
  spec.density = c.density;
  spec.gap = c.fill->gap;
  // A bed that settles must not fall as the columns of a lattice: the stack above it is shaken as far as its gaps
  // allow.
  spec.jitter = c.fill->shape == FillShape::settled ? 0.5 * spec.gap : c.fill->jitter;
  spec.seed = described.numerics.seed;
  spec.extent_of = c.fill->extent_of;
  spec.file = c.fill->file;
  if (c.fill->shape == FillShape::file) {
    spec.floor_diameter = 0.0;
  } else if (const auto* patch = std::get_if<std::string>(&c.fill->at)) {
    const Floor floor = from_file(described, "carriers.fill.at", [&] { return floor_of(surface, *patch, c.gravity); });
    spec.floor = floor.centre;
    spec.floor_diameter = floor.diameter;
  } else {
    spec.floor = std::get<Vec3>(c.fill->at);
    // A cylinder as high as it is wide, if nothing bounds it.
    const double pitch = (1.0 + spec.gap) * parcel_diameter(spec.diameter, c.parcel);
    spec.floor_diameter = pitch * std::cbrt(4.0 / std::numbers::pi * static_cast<double>(c.count) / c.parcel) * 1.1;
  }
  return from_file(described, "carriers.fill", [&] {
    return place_dose(
        spec, [&](const Vec3& x) { return tree.inside(x); }, [&](const Vec3& x) { return tree.closest(x).distance; });
  });
}

}  // namespace puffin::cases
