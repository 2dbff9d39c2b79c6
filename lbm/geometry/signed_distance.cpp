#include "lbm/geometry/signed_distance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "lbm/geometry/self_intersection.hpp"
#include "lbm/geometry/shells.hpp"
#include "lbm/geometry/triangle_distance.hpp"

namespace puffin::lbm::geometry {

namespace {

bool closed(const Adjacency& adjacency) {
  for (std::size_t e = 0; e < adjacency.edges(); ++e) {
    int balance = 0;
    for (const auto& use : adjacency.uses(e)) balance += use.forward ? 1 : -1;
    if (balance != 0) return false;
  }
  return true;
}

// One turn inside and none outside, seen from a triangle of each part: without crossings that holds for the whole part.
bool turns_once(const TriangleTree& tree) {
  const TriangleMesh& mesh = tree.mesh();
  const Shells shells = find_shells(mesh, tree.adjacency());
  std::vector<int> largest(shells.count, -1);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (tree.adjacency().edge(t, 0) < 0) continue;
    int& best = largest[shells.of_triangle[t]];
    if (best < 0 || mesh.area(t) > mesh.area(best)) best = t;
  }
  for (const int t : largest) {
    if (t < 0) continue;
    const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    const Vec3 off = 1e-3 * std::sqrt(mesh.area(t)) * mesh.area_vector(t).stableNormalized();
    if (std::lround(tree.winding_number(middle - off)) != 1 || std::lround(tree.winding_number(middle + off)) != 0)
      return false;
  }
  return true;
}

// Outward normal at the nearest point, of any length.
Vec3 normal_at(const TriangleTree& tree, int triangle, Region region) {
  const TriangleMesh& mesh = tree.mesh();
  const int r = static_cast<int>(region);
  if (region == Region::face) return mesh.area_vector(triangle);
  Vec3 sum = Vec3::Zero();
  if (r >= 3) {
    for (const auto& use : tree.adjacency().uses(static_cast<std::size_t>(tree.adjacency().edge(triangle, r - 3))))
      sum += mesh.area_vector(use.triangle).stableNormalized();
    return sum;
  }
  const int vertex = mesh.triangles[triangle][r];
  for (const std::int32_t t : tree.adjacency().around(vertex)) {
    const auto& corners = mesh.triangles[t];
    const int k = corners[0] == vertex ? 0 : (corners[1] == vertex ? 1 : 2);
    const Vec3 u = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k), v = mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k);
    sum += std::atan2(u.cross(v).norm(), u.dot(v)) * mesh.area_vector(t).stableNormalized();
  }
  return sum;
}

}  // namespace

SignedDistance::SignedDistance(std::shared_ptr<const TriangleTree> tree) : tree_(std::move(tree)) {
  if (!tree_) throw std::invalid_argument("SignedDistance: no tree");
  simple_ = closed(tree_->adjacency()) && turns_once(*tree_) && find_self_intersections(*tree_).empty();
}

double SignedDistance::operator()(const Vec3& p, double limit) const {
  const Closest nearest = tree_->closest(p, limit);
  const double distance = nearest.triangle < 0 ? limit : nearest.distance;
  if (simple_ && nearest.triangle >= 0 && tree_->adjacency().edge(nearest.triangle, 0) >= 0) {
    const TriangleMesh& m = tree_->mesh();
    const auto on = nearest_on_triangle(p, m.corner(nearest.triangle, 0), m.corner(nearest.triangle, 1),
                                        m.corner(nearest.triangle, 2));
    const Vec3 normal = normal_at(*tree_, nearest.triangle, on.region);
    // The cosine is +-1 over a face and keeps away from 0 over edges and vertices, unless they are nearly folded.
    const double along = normal.dot(p - on.point), least = 1e-3 * normal.norm() * distance;
    if (along < -least) return distance;
    if (along > least) return -distance;
  }
  return tree_->inside(p) ? distance : -distance;
}

}  // namespace puffin::lbm::geometry
