// Where a sphere touches the triangles of a TriangleTree.

#include <algorithm>
#include <cmath>

#include "lbm/geometry/node_bounds.hpp"
#include "lbm/geometry/triangle_distance.hpp"
#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

namespace {

// Two squared distances that differ by less than this fraction are equal: then a foot on a shared edge may be claimed
// by both triangles, at points less than sqrt(2 * same_distance) of the distance apart ...
constexpr double same_distance = 1e-12;
// ... and such doubles, nearer to each other than this fraction of the reach, are one contact.
constexpr double same_place = 1e-5;

// The contact places around one centre.
class Gatherer {
 public:
  Gatherer(const TriangleTree& tree, const Vec3& centre, double reach, const std::vector<char>* skip, Side side,
           std::vector<Feature>& out)
      : tree_(tree), centre_(centre), reach_(reach), skip_(skip), side_(side), out_(out), first_(out.size()) {
    seen_edges_.clear();
    seen_vertices_.clear();
  }

  void visit(int triangle, const NearestOnTriangle& nearest) {
    if (skipped(triangle) || tree_.adjacency().edge(triangle, 0) < 0) return;
    const double d2 = (centre_ - nearest.point).squaredNorm();
    const int region = static_cast<int>(nearest.region);
    if (nearest.region == Region::face) {
      if (faces(tree_.mesh().area_vector(triangle), nearest.point)) emit(triangle, nearest.point, d2);
    } else if (region >= 3) {
      visit_edge(triangle, tree_.adjacency().edge(triangle, region - 3), nearest.point, d2);
    } else {
      visit_vertex(triangle, tree_.mesh().triangles[triangle][region], nearest.point, d2);
    }
  }

 private:
  bool skipped(int triangle) const { return skip_ && (*skip_)[triangle]; }

  bool faces(const Vec3& outward, const Vec3& point) const {
    return side_ == Side::both || (centre_ - point).dot(outward) <= 0.0;
  }

  // Does a triangle come nearer to the centre than d2?
  bool nearer(int triangle, double d2) const {
    const TriangleMesh& m = tree_.mesh();
    const Vec3 p =
        nearest_on_triangle(centre_, m.corner(triangle, 0), m.corner(triangle, 1), m.corner(triangle, 2)).point;
    return (centre_ - p).squaredNorm() < d2 * (1.0 - same_distance);
  }

  bool first_time(std::vector<std::int32_t>& seen, std::int32_t id) {
    if (std::find(seen.begin(), seen.end(), id) != seen.end()) return false;
    seen.push_back(id);
    return true;
  }

  void visit_edge(int triangle, std::int32_t edge, const Vec3& point, double d2) {
    if (!first_time(seen_edges_, edge)) return;
    Vec3 outward = Vec3::Zero();
    for (const auto& use : tree_.adjacency().uses(edge)) {
      if (skipped(use.triangle)) continue;
      if (use.triangle != triangle && nearer(use.triangle, d2)) return;
      outward += tree_.mesh().area_vector(use.triangle).stableNormalized();
    }
    if (faces(outward, point)) emit(triangle, point, d2);
  }

  // The outward direction at a vertex: normals weighted by the angle of the corner, Baerentzen & Aanaes, IEEE TVCG
  // 11(3), 243 (2005): its sign against the distance vector tells the sides apart.
  void visit_vertex(int triangle, std::int32_t vertex, const Vec3& point, double d2) {
    if (!first_time(seen_vertices_, vertex)) return;
    const TriangleMesh& m = tree_.mesh();
    Vec3 outward = Vec3::Zero();
    for (const std::int32_t t : tree_.adjacency().around(vertex)) {
      if (skipped(t)) continue;
      if (t != triangle && nearer(t, d2)) return;
      const int k = m.triangles[t][0] == vertex ? 0 : (m.triangles[t][1] == vertex ? 1 : 2);
      const Vec3 u = (m.corner(t, (k + 1) % 3) - m.corner(t, k)).stableNormalized();
      const Vec3 v = (m.corner(t, (k + 2) % 3) - m.corner(t, k)).stableNormalized();
      outward += std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * m.area_vector(t).stableNormalized();
    }
    if (faces(outward, point)) emit(triangle, point, d2);
  }

  void emit(int triangle, const Vec3& point, double d2) {
    const double same = same_place * reach_;
    for (std::size_t i = first_; i < out_.size(); ++i) {
      if ((out_[i].point - point).squaredNorm() <= same * same) return;
    }
    out_.push_back({point, std::sqrt(d2), triangle});
  }

  const TriangleTree& tree_;
  const Vec3& centre_;
  double reach_;
  const std::vector<char>* skip_;
  Side side_;
  std::vector<Feature>& out_;
  std::size_t first_;
  inline static thread_local std::vector<std::int32_t> seen_edges_, seen_vertices_;  // kept to save allocations
};

}  // namespace

void TriangleTree::near_features(const Vec3& centre, double reach, const std::vector<char>* skip_triangle,
                                 std::vector<Feature>& out, Side side) const {
  Gatherer gatherer(*this, centre, reach, skip_triangle, side, out);
  const Vec3 q = centre - centre_;
  const auto point4 = four_times(static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()));
  const double reach2 = reach * reach;
  std::array<std::int32_t, 256> stack;
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    const Lanes bound = squared_distances(node, point4);
    for (int c = 0; c < 4; ++c) {
      if (node.count[c] == 0 || bound[c] * (1.0f - 1e-6f) > reach2) continue;
      if (node.child[c] >= 0) {
        stack[top++] = node.child[c];
        continue;
      }
      for (int i = ~node.child[c]; i < ~node.child[c] + node.count[c]; ++i) {
        const NearestOnTriangle nearest = nearest_on_triangle(centre, corners_[i].a, corners_[i].b, corners_[i].c);
        if ((nearest.point - centre).squaredNorm() <= reach2) gatherer.visit(order_[i], nearest);
      }
    }
  }
}

}  // namespace puffin::lbm::geometry
