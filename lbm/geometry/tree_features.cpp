// Where a sphere touches the triangles of a TriangleTree.

#include <algorithm>
#include <cmath>

#include "lbm/geometry/triangle_distance.hpp"
#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

namespace {

// Two squared distances that differ by less than this fraction are equal: then a foot on a shared edge may be claimed
// by both triangles, at points less than sqrt(2 * same_distance) of the distance apart ...
constexpr double same_distance = 1e-12;
// ... and such doubles, nearer to each other than this fraction of the reach, are one contact.
constexpr double same_place = 1e-5;

// The contact places around one centre. First every triangle within reach is met, then each is looked at.
class Gatherer {
 public:
  Gatherer(const TriangleTree& tree, const Vec3& centre, double reach, const std::vector<char>* skip, Side side,
           std::vector<Feature>& out)
      : tree_(tree), centre_(centre), reach_(reach), skip_(skip), side_(side), out_(out), first_(out.size()) {
    scratch_.seen_edges.clear();
    scratch_.seen_vertices.clear();
    scratch_.met.clear();
    scratch_.distances.clear();
  }

  void meet(int triangle, const Vec3& a, const Vec3& b, const Vec3& c) {
    const NearestOnTriangle nearest = nearest_on_triangle(centre_, a, b, c);
    const double d2 = (nearest.point - centre_).squaredNorm();
    if (d2 > reach_ * reach_ || skipped(triangle)) return;
    scratch_.met.push_back(triangle);
    scratch_.distances.push_back({nearest, d2});
  }

  void list(std::vector<NearTriangle>& triangles) const {
    for (std::size_t n = 0; n < scratch_.met.size(); ++n)
      triangles.push_back(
          {scratch_.distances[n].nearest.point, std::sqrt(scratch_.distances[n].squared), scratch_.met[n]});
  }

  void gather() {
    for (std::size_t n = 0; n < scratch_.met.size(); ++n) {
      const auto& [nearest, d2] = scratch_.distances[n];
      const int region = static_cast<int>(nearest.region), triangle = scratch_.met[n];
      if (nearest.region == Region::face) {
        if (faces(tree_.mesh().area_vector(triangle), nearest.point)) emit(triangle, nearest.point, d2);
      } else if (tree_.adjacency().edge(triangle, 0) < 0) {
        continue;  // two equal corners: its neighbours are met
      } else if (region >= 3) {
        visit_edge(triangle, tree_.adjacency().edge(triangle, region - 3), nearest.point, d2);
      } else {
        visit_vertex(triangle, tree_.mesh().triangles[triangle][region], nearest.point, d2);
      }
    }
  }

 private:
  bool skipped(int triangle) const { return skip_ && (*skip_)[triangle]; }

  bool faces(const Vec3& outward, const Vec3& point) const {
    return side_ == Side::both || (centre_ - point).dot(outward) <= 0.0;
  }

  // Does a triangle come nearer to the centre than d2? One that was not met is beyond reach.
  bool nearer(int triangle, double d2) const {
    const auto& met = scratch_.met;
    const auto at = std::find(met.begin(), met.end(), triangle);
    return at != met.end() && scratch_.distances[at - met.begin()].squared < d2 * (1.0 - same_distance);
  }

  bool first_time(std::vector<std::int32_t>& seen, std::int32_t id) {
    if (std::find(seen.begin(), seen.end(), id) != seen.end()) return false;
    seen.push_back(id);
    return true;
  }

  void visit_edge(int triangle, std::int32_t edge, const Vec3& point, double d2) {
    if (!first_time(scratch_.seen_edges, edge)) return;
    const auto uses = tree_.adjacency().uses(edge);
    for (const auto& use : uses)
      if (use.triangle != triangle && nearer(use.triangle, d2)) return;
    Vec3 outward = Vec3::Zero();
    for (const auto& use : uses) {
      if (skipped(use.triangle)) continue;
      triangle = std::min(triangle, use.triangle);
      outward += tree_.mesh().area_vector(use.triangle).stableNormalized();
    }
    if (faces(outward, point)) emit(triangle, point, d2);
  }

  // The outward direction at a vertex: normals weighted by the angle of the corner, Baerentzen & Aanaes, IEEE TVCG
  // 11(3), 243 (2005): its sign against the distance vector tells the sides apart.
  void visit_vertex(int triangle, std::int32_t vertex, const Vec3& point, double d2) {
    if (!first_time(scratch_.seen_vertices, vertex)) return;
    const TriangleMesh& m = tree_.mesh();
    const auto around = tree_.adjacency().around(vertex);
    for (const std::int32_t t : around)
      if (t != triangle && nearer(t, d2)) return;
    Vec3 outward = Vec3::Zero();
    for (const std::int32_t t : around) {
      if (skipped(t)) continue;
      triangle = std::min(triangle, t);
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
  struct Distance {
    NearestOnTriangle nearest;
    double squared;
  };
  struct Scratch {
    std::vector<std::int32_t> seen_edges, seen_vertices, met;
    std::vector<Distance> distances;  // of met
  };
  static Scratch& scratch() {  // kept to save allocations
    static thread_local Scratch own;
    return own;
  }
  Scratch& scratch_ = scratch();
};

}  // namespace

void TriangleTree::near_features(const Vec3& centre, double reach, const std::vector<char>* skip_triangle,
                                 std::vector<Feature>& out, Side side, std::vector<NearTriangle>* triangles) const {
  struct Query {
    const TriangleTree& tree;
    Gatherer gatherer;
  };
  Query query{*this, Gatherer(*this, centre, reach, skip_triangle, side, out)};
  TreeSearch s = search(centre, reach);
  s.context = &query;
  s.found = [](void* context, int slot, float limit) {
    Query& q = *static_cast<Query*>(context);
    const auto& [a, b, c] = q.tree.corners_[slot];
    q.gatherer.meet(q.tree.order_[slot], a, b, c);
    return limit;
  };
  tree_searches().all(s);
  query.gatherer.gather();
  if (triangles != nullptr) query.gatherer.list(*triangles);
}

}  // namespace puffin::lbm::geometry
