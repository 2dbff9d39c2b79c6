#include "cases/fill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "cases/check_boundaries.hpp"
#include "cases/size_distribution.hpp"

namespace puffin::cases {

namespace {

/// Centre and equivalent diameter of the lowest part of a patch that faces down (against the carriers' weight).
struct Floor {
  Vec3 centre = Vec3::Zero();
  double diameter = 0.0;
};

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
  const double tolerance = 1e-6 + 1e-3 * std::abs(lowest);
  for (int t = 0; t < static_cast<int>(surface.mesh.triangles.size()); ++t) {
    if (surface.patches.of_triangle[t] != wanted || !faces_down(t) || depth(t) < lowest - tolerance) continue;
    const double a = surface.mesh.area(t);
    area += a;
    floor.centre += a / 3.0 * (surface.mesh.corner(t, 0) + surface.mesh.corner(t, 1) + surface.mesh.corner(t, 2));
  }
  floor.centre /= area;
  floor.diameter = 2.0 * std::sqrt(area / std::numbers::pi);
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
