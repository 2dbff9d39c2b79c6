#include "cases/inlet.hpp"

#include <algorithm>
#include <map>

#include "lbm/geometry/surface_check.hpp"

namespace puffin::cases {

namespace {

namespace geometry = lbm::geometry;

constexpr double one_way = 0.9999;  // cosine of the angle between normals of faces that look the same way

/// A file's velocities are laid onto one plane.
void refuse_file_on_several(const Boundary& b, const std::vector<geometry::PatchPart>& parts) {
  for (std::size_t p = 1; p < parts.size(); ++p)
    if (parts[p].normal.dot(parts[0].normal) < one_way)
      throw geometry::GeometryError("a profile from a file is laid onto one plane, but " + part_name(b, parts, 0) +
                                    " and " + part_name(b, parts, p) +
                                    " look different ways: give each a patch of its own ([[geometry.patch]] select = "
                                    "\"near:[x, y, z]\") with its own profile");
}

}  // namespace

std::vector<geometry::PatchPart> inlet_parts(const Surface& surface, const Boundary& b) {
  return geometry::parts_of(surface.mesh, surface.patches.of_triangle, surface.patches.find(b.patch));
}

std::string part_name(const Boundary& b, const std::vector<geometry::PatchPart>& parts, std::size_t part) {
  if (parts.size() == 1) return "the patch '" + b.patch + "'";
  return "the part of '" + b.patch + "' around " + geometry::place_text(parts[part].centroid);
}

Inlet inlet_of(const Case& c, const Surface& surface, const Boundary& b) {
  const std::vector<geometry::PatchPart> parts = inlet_parts(surface, b);
  const auto* vector = std::get_if<Velocity>(&b.flow);
  Inlet inlet;
  if (b.profile == Profile::file || parts.size() < 2) {
    refuse_file_on_several(b, parts);
    inlet.openings.push_back(opening_of(c, surface, surface.patches.find(b.patch)));
    inlet.area = inlet.openings.front().area;
    if (vector) inlet.across = std::abs(vector->value.normalized().dot(inlet.openings.front().normal));
    return inlet;
  }
  std::vector<Vec3> normal;
  std::vector<double> area, share(parts.size(), 1.0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    inlet.openings.push_back(opening_of(c, surface, parts[p], part_name(b, parts, p)));
    normal.push_back(parts[p].normal);
    area.push_back(parts[p].area);
    inlet.area += parts[p].area;
    if (vector) share[p] = -vector->value.normalized().dot(parts[p].normal);
  }
  if (vector) {
    double through = 0.0;
    for (std::size_t p = 0; p < parts.size(); ++p) through += share[p] * area[p];
    inlet.across = through / inlet.area;
    for (double& s : share) s /= inlet.across;
  }
  inlet.parts = std::make_shared<const lbm::InletParts>(lbm::InletParts{
      geometry::NearestPart(surface.mesh, parts), std::move(normal), std::move(area), std::move(share)});
  return inlet;
}

AreaOf inlet_areas(const Air& air, const Surface& surface) {
  std::map<std::string, double> areas;
  for (const Boundary& b : air.boundaries) {
    if (b.type != BoundaryType::velocity_inlet || surface.patches.find(b.patch) < 0) continue;
    double& sum = areas[b.patch];
    for (const geometry::PatchPart& part : inlet_parts(surface, b)) sum += part.area;
  }
  return [areas](const std::string& patch) {
    const auto found = areas.find(patch);
    return found == areas.end() ? 0.0 : found->second;
  };
}

}  // namespace puffin::cases
