#include "lbm/geometry/signed_distance.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
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

// Every third bit, from the ten lowest.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x3FF;
  v = (v | (v << 16)) & 0x030000FF;
  v = (v | (v << 8)) & 0x0300F00F;
  v = (v | (v << 4)) & 0x030C30C3;
  return (v | (v << 2)) & 0x09249249;
}

// Indices of the points along a Morton curve through the 1024^3 parts of their bounding box.
std::vector<std::uint32_t> along_curve(std::span<const Vec3> points) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double scale = 1023.0 / std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<std::uint64_t> keys(points.size());  // place on the curve, then the index
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    const Vec3 s = scale * (points[n] - low);
    keys[n] = (spread(static_cast<std::uint64_t>(s.x())) | spread(static_cast<std::uint64_t>(s.y())) << 1 |
               spread(static_cast<std::uint64_t>(s.z())) << 2)
                  << 32 |
              n;
  });
  tbb::parallel_sort(keys);
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t n = 0; n < keys.size(); ++n) order[n] = static_cast<std::uint32_t>(keys[n]);
  return order;
}

}  // namespace

SignedDistance::SignedDistance(std::shared_ptr<const TriangleTree> tree) : tree_(std::move(tree)) {
  if (!tree_) throw std::invalid_argument("SignedDistance: no tree");
  simple_ = closed(tree_->adjacency()) && turns_once(*tree_) && find_self_intersections(*tree_).empty();
}

double SignedDistance::sign(const Vec3& p, const Closest& nearest) const {
  if (simple_ && nearest.triangle >= 0) {
    // Most points lie straight before or behind a face, and then its normal is enough.
    const Vec3 &face = nearest.outward, away = p - nearest.point;
    const double straight = face.dot(away);
    if (straight * straight > (1.0 - 1e-12) * face.squaredNorm() * away.squaredNorm())
      return straight < 0.0 ? 1.0 : -1.0;
    if (tree_->adjacency().edge(nearest.triangle, 0) < 0) return tree_->inside(p) ? 1.0 : -1.0;
    const TriangleMesh& m = tree_->mesh();
    const auto on = nearest_on_triangle(p, m.corner(nearest.triangle, 0), m.corner(nearest.triangle, 1),
                                        m.corner(nearest.triangle, 2));
    const Vec3 normal = normal_at(*tree_, nearest.triangle, on.region);
    // The cosine is +-1 over a face and keeps away from 0 over edges and vertices, unless they are nearly folded.
    const double along = normal.dot(p - on.point), least = 1e-3 * normal.norm() * nearest.distance;
    if (along < -least) return 1.0;
    if (along > least) return -1.0;
  }
  return tree_->inside(p) ? 1.0 : -1.0;
}

double SignedDistance::operator()(const Vec3& p, double limit) const {
  const Closest nearest = tree_->closest(p, limit);
  return sign(p, nearest) * (nearest.triangle < 0 ? limit : nearest.distance);
}

std::vector<double> SignedDistance::at(std::span<const Vec3> points, double limit) const {
  const std::vector<std::uint32_t> order = along_curve(points);
  std::vector<double> result(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 2048), [&](const auto& r) {
    Closest last;
    constexpr std::size_t ahead = 8;
    for (std::size_t n = r.begin(); n < r.end(); ++n) {
      const Vec3& p = points[order[n]];
      if (n + ahead < r.end()) __builtin_prefetch(&points[order[n + ahead]]);
      // The last nearest point lies on the surface; a little more, so that its own triangle is found again.
      const double bound = last.triangle < 0 ? limit : std::min(limit, (p - last.point).norm() * (1.0 + 1e-9));
      const Closest nearest = tree_->closest(p, bound);
      result[order[n]] = sign(p, nearest) * (nearest.triangle < 0 ? limit : nearest.distance);
      if (nearest.triangle >= 0) last = nearest;
    }
  });
  return result;
}

}  // namespace puffin::lbm::geometry
