#include "lbm/geometry/patch_parts.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace puffin::lbm::geometry {

namespace {

/// The triangles of the parts alone; `part` gets the part of each.
TriangleMesh mesh_of(const TriangleMesh& mesh, const std::vector<PatchPart>& parts, std::vector<int>& part) {
  TriangleMesh own;
  own.vertices = mesh.vertices;
  own.solids = {"parts"};
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const int t : parts[p].triangles) {
      own.triangles.push_back(mesh.triangles[t]);
      own.solid.push_back(0);
      part.push_back(static_cast<int>(p));
    }
  return own;
}

}  // namespace

PatchPart part_of(const TriangleMesh& mesh, std::vector<int> triangles) {
  constexpr double plane = 1e-6, no_way = 1e-9;  // of the area
  PatchPart part;
  part.triangles = std::move(triangles);
  Vec3 twice = Vec3::Zero();
  for (const int t : part.triangles) {
    const double area = mesh.area(t);
    part.surface += area;
    twice += mesh.area_vector(t);
    part.centroid += area / 3.0 * (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2));
  }
  if (!(part.surface > 0.0)) return part;
  part.centroid /= part.surface;
  if (!(twice.norm() > no_way * part.surface)) return part;
  const double across = 0.5 * twice.norm();
  part.area = across < (1.0 - plane) * part.surface ? across : part.surface;
  part.normal = twice.normalized();
  return part;
}

std::vector<PatchPart> parts_of(const TriangleMesh& mesh, const std::vector<int>& patch_of_triangle, int patch) {
  std::vector<int> own;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    if (patch_of_triangle[t] == patch) own.push_back(t);
  std::vector<int> lowest(own.size());  // of the part, by place in `own`
  std::iota(lowest.begin(), lowest.end(), 0);
  const auto root = [&](int n) {
    while (lowest[n] != n) n = lowest[n] = lowest[lowest[n]];
    return n;
  };
  std::vector<std::array<int, 3>> sides;  // lower and higher vertex, place in `own`
  for (int n = 0; n < static_cast<int>(own.size()); ++n)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[own[n]][k], b = mesh.triangles[own[n]][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), n});
    }
  std::sort(sides.begin(), sides.end());
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s][0] != sides[s - 1][0] || sides[s][1] != sides[s - 1][1]) continue;
    const int a = root(sides[s][2]), b = root(sides[s - 1][2]);
    lowest[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::vector<int>> groups(own.size());
  for (int n = 0; n < static_cast<int>(own.size()); ++n) groups[root(n)].push_back(own[n]);
  std::vector<PatchPart> parts;
  for (auto& group : groups) {
    if (group.empty()) continue;
    PatchPart part = part_of(mesh, std::move(group));
    if (part.surface > 0.0) parts.push_back(std::move(part));
  }
  return parts;
}

NearestPart::NearestPart(const TriangleMesh& mesh, const std::vector<PatchPart>& parts)
    : tree_(mesh_of(mesh, parts, part_)) {}

}  // namespace puffin::lbm::geometry
