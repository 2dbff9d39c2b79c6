#include "cases/fill.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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

// Cosines of the angle between a face's outward normal and the weight of what lies on it: 8 degrees, within which a
// floor is level, and 45, within which it is one (less rounding).
constexpr double level = 0.99, steepest = 0.7071;
// Angles [rad]: a floor nearer to level than `upright` is built upon upright, as a stack of 2 mm is then wrong by 0.2
// um at its rim; faces nearer to each other than `one_way` face one way.
constexpr double upright = 1e-4, one_way = 1e-2;

/// The lowest part of a patch that faces down (with the carriers' weight): its centre, the diameter of the circle of
/// its area, or, where that sticks out of its sides, of the largest around the centre that does not, and where a stack
/// on it leads.
struct Floor {
  Vec3 centre = Vec3::Zero();
  double diameter = 0.0;
  Vec3 up = Vec3::UnitZ();
};

/// The triangles of a patch, seen by what falls along `down`.
class Faces {
 public:
  Faces(const Surface& surface, const std::string& patch, const Vec3& down) : mesh_(surface.mesh), down_(down) {
    const int wanted = surface.patches.find(patch);
    double area = 0.0;
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      if (surface.patches.of_triangle[t] != wanted) continue;
      all_.push_back(t);
      area += mesh_.area(t);
    }
    tolerance_ = 1e-3 * std::sqrt(area);
  }
  Vec3 outward(int t) const { return mesh_.area_vector(t).normalized(); }
  /// The lowest of those with a cosine above `cosine` to the weight; -1: none.
  int lowest(double cosine) const {
    int found = -1;
    for (const int t : all_)
      if (outward(t).dot(down_) > cosine && (found < 0 || depth(t) > depth(found))) found = t;
    return found;
  }
  /// The level ones as deep as `lowest`.
  std::vector<int> as_deep_as(int lowest) const {
    const double least = depth(lowest) - tolerance_;
    return those([&](int t) { return outward(t).dot(down_) > level && !(depth(t) < least); });
  }
  /// Those in the plane of `lowest`.
  std::vector<int> in_plane_of(int lowest) const {
    const Vec3 normal = outward(lowest);
    return those([&](int t) {
      return outward(t).dot(normal) > level && std::abs(normal.dot(corners(t) - corners(lowest))) / 3.0 <= tolerance_;
    });
  }

 private:
  Vec3 corners(int t) const { return mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2); }
  double depth(int t) const { return down_.dot(corners(t)) / 3.0; }
  std::vector<int> those(const auto& wanted) const {
    std::vector<int> found;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(found), wanted);
    return found;
  }

  const lbm::geometry::TriangleMesh& mesh_;
  Vec3 down_;
  std::vector<int> all_;
  double tolerance_ = 0.0;  // [m] of depths that count as one: of the patch's size, wherever its origin lies
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

/// Against the weight; without one, up is the z-axis.
Vec3 against(const Vec3& gravity) { return gravity.norm() > 0.0 ? Vec3(-gravity.normalized()) : Vec3(Vec3::UnitZ()); }

/// The mean outward normal of triangles.
Vec3 mean_normal(const lbm::geometry::TriangleMesh& mesh, const std::vector<int>& triangles) {
  Vec3 sum = Vec3::Zero();
  for (const int t : triangles) sum += mesh.area_vector(t);
  return sum.normalized();
}

/// Level faces come first, whatever slopes there are: those as deep as the lowest, on which a stack stands upright,
/// also where a round bottom is made of them. If they all slope one way, or there are none, the floor is a plane on
/// which the stack stands square. Nothing slopes without weight.
Floor floor_of(const Surface& surface, const std::string& patch, const Vec3& gravity) {
  Floor floor;
  floor.up = against(gravity);
  const Vec3 down = -floor.up;
  const Faces faces(surface, patch, down);
  std::vector<int> of_floor;
  int lowest = faces.lowest(level);
  bool slopes = lowest < 0;
  if (lowest >= 0) {
    of_floor = faces.as_deep_as(lowest);
    const Vec3 normal = mean_normal(surface.mesh, of_floor);
    slopes = normal.cross(down).norm() > upright && std::all_of(of_floor.begin(), of_floor.end(), [&](int t) {
               return faces.outward(t).cross(normal).norm() < one_way;
             });
  }
  if (slopes && gravity.norm() > 0.0) {
    if (lowest < 0) lowest = faces.lowest(steepest);
    if (lowest >= 0) of_floor = faces.in_plane_of(lowest);
    floor.up = -mean_normal(surface.mesh, of_floor);
  }
  if (of_floor.empty())
    throw std::invalid_argument("the patch '" + patch +
                                "' has no face that carriers can lie on; give a point [x, y, z] instead");
  double area = 0.0;
  for (const int t : of_floor) {
    const double a = surface.mesh.area(t);
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
  spec.axes = axes_on_floor(against(c.gravity));
  if (c.fill->shape == FillShape::file) {
    spec.floor_diameter = 0.0;
  } else if (const auto* patch = std::get_if<std::string>(&c.fill->at)) {
    const Floor floor = from_file(described, "carriers.fill.at", [&] { return floor_of(surface, *patch, c.gravity); });
    spec.floor = floor.centre;
    spec.floor_diameter = floor.diameter;
    spec.axes = axes_on_floor(floor.up);
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
