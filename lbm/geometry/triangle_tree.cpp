#include "lbm/geometry/triangle_tree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lbm/geometry/tree_build.hpp"
#include "lbm/geometry/triangle_distance.hpp"

namespace puffin::lbm::geometry {

namespace {

// A triangle in its own frame, for lane c of a leaf.
void set_lane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& centre, int lane, LeafTriangles& leaf) {
  const Vec3 ab = b - a, ac = c - a;
  Vec3 x = ab.norm() > 0.0 ? ab.stableNormalized() : ac.stableNormalized();
  if (!(x.squaredNorm() > 0.5)) x = Vec3::UnitX();
  Vec3 y = (ac - ac.dot(x) * x).stableNormalized();
  y = (y - y.dot(x) * x).stableNormalized();  // a needle leaves mere rounding to build on
  if (!(y.squaredNorm() > 0.5)) y = x.unitOrthogonal();
  const Vec3 z = x.cross(y);
  for (int d = 0; d < 3; ++d) {
    leaf.corner[d][lane] = static_cast<float>(a[d] - centre[d]);
    leaf.x[d][lane] = static_cast<float>(x[d]);
    leaf.y[d][lane] = static_cast<float>(y[d]);
    leaf.z[d][lane] = static_cast<float>(z[d]);
  }
  const auto inverse = [](double squared) { return squared > 1e-36 ? static_cast<float>(1.0 / squared) : 0.0F; };
  leaf.b[lane] = static_cast<float>(ab.dot(x));
  leaf.c[0][lane] = static_cast<float>(ac.dot(x));
  leaf.c[1][lane] = static_cast<float>(std::max(ac.dot(y), 0.0));
  leaf.inverse_bc[lane] = inverse((c - b).squaredNorm());
  leaf.inverse_ca[lane] = inverse(ac.squaredNorm());
}

}  // namespace

TriangleTree::TriangleTree(TriangleMesh mesh) : TriangleTree(std::make_shared<const TriangleMesh>(std::move(mesh))) {}

TriangleTree::TriangleTree(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {
  if (!mesh_ || mesh_->triangles.empty()) throw std::invalid_argument("TriangleTree: the mesh has no triangles");
  const int vertices = static_cast<int>(mesh_->vertices.size());
  min_.setConstant(std::numeric_limits<double>::infinity());
  max_.setConstant(-std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < mesh_->triangles.size(); ++t) {
    for (const int v : mesh_->triangles[t]) {
      if (v < 0 || v >= vertices || !mesh_->vertices[v].allFinite()) {
        throw std::invalid_argument("TriangleTree: triangle " + std::to_string(t) + " has no finite corner " +
                                    std::to_string(v));
      }
      min_ = min_.cwiseMin(mesh_->vertices[v]);
      max_ = max_.cwiseMax(mesh_->vertices[v]);
    }
  }
  centre_ = 0.5 * (min_ + max_);

  // Widening by 1e-6 of the box covers the rounding of boxes and query points to single precision (6e-8 each).
  std::unique_ptr<Builder> builder;
  tbb::parallel_invoke(
      [&] { builder = std::make_unique<Builder>(*mesh_, centre_, 1e-6 * (max_ - min_).maxCoeff() + 1e-30); },
      [&] { adjacency_ = Adjacency(*mesh_); });
  nodes_ = std::move(builder->nodes);
  order_ = std::move(builder->order);
  set_leaves();
  set_dipoles();
}

void TriangleTree::set_leaves() {
  corners_.resize(order_.size());
  leaves_.resize(order_.size() / lanes);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves_.size(), 1024), [&](const auto& r) {
    for (std::size_t leaf = r.begin(); leaf < r.end(); ++leaf)
      for (int lane = 0; lane < lanes; ++lane) {
        const std::size_t slot = leaf * lanes + lane;
        const int t = order_[slot];
        if (t < 0) continue;
        corners_[slot] = {mesh_->corner(t, 0), mesh_->corner(t, 1), mesh_->corner(t, 2)};
        set_lane(corners_[slot].a, corners_[slot].b, corners_[slot].c, centre_, lane, leaves_[leaf]);
      }
  });
}

// Distances of the search. Its coordinates, frames and sums are rounded to 2^-24 each; the sum of all is below
// 1.5e-6 of the way from the point over the centre to any corner.
TreeSearch TriangleTree::search(const Vec3& p, double limit) const {
  const Vec3 q = p - centre_;
  TreeSearch s;
  s.nodes = nodes_.data();
  s.leaves = leaves_.data();
  for (int d = 0; d < 3; ++d) s.point[d] = static_cast<float>(q[d]);
  s.tolerance = static_cast<float>(4e-6 * (q.lpNorm<1>() + 0.5 * (max_ - min_).sum()));
  s.limit = squared_limit(limit, s.tolerance);
  return s;
}

float TriangleTree::squared_limit(double distance, float tolerance) {
  const double d = distance + tolerance;
  return static_cast<float>(std::min(1.00001 * d * d, 1e38));
}

Closest TriangleTree::closest(const Vec3& p, double limit) const {
  struct Nearest {
    const TriangleTree& tree;
    const Vec3& p;
    float tolerance;
    double best;  // squared
    Closest result{};
    int slot = -1;
  };
  TreeSearch s = search(p, limit);
  Nearest nearest{*this, p, s.tolerance, limit * limit};
  s.context = &nearest;
  s.found = [](void* context, int slot, float so_far) {
    Nearest& n = *static_cast<Nearest*>(context);
    const auto& [a, b, c] = n.tree.corners_[slot];
    const Vec3 point = nearest_on_triangle(n.p, a, b, c).point;
    const double d2 = (point - n.p).squaredNorm();
    const int triangle = n.tree.order_[slot];
    if (d2 > n.best || (d2 == n.best && n.result.triangle >= 0 && triangle > n.result.triangle)) return so_far;
    n.best = d2;
    n.result.point = point;
    n.result.triangle = triangle;
    n.slot = slot;
    return squared_limit(std::sqrt(d2), n.tolerance);
  };
  tree_searches().nearest_first(s);
  if (nearest.slot >= 0) {
    const auto& [a, b, c] = corners_[nearest.slot];
    nearest.result.distance = std::sqrt(nearest.best);
    nearest.result.outward = (b - a).cross(c - a);
  }
  return nearest.result;
}

void TriangleTree::overlapping(const Vec3& low, const Vec3& high, std::vector<int>& out) const {
  std::array<std::int32_t, 512> stack;
  int top = 0;
  stack[top++] = 0;
  const Vec3 l = low - centre_, h = high - centre_;
  while (top > 0) {
    const TreeNode& node = nodes_[stack[--top]];
    for (int c = 0; c < lanes; ++c) {
      if (node.count[c] == 0) continue;
      bool meets = true;
      for (int d = 0; d < 3; ++d) meets = meets && node.low[d][c] <= h[d] && node.high[d][c] >= l[d];
      if (!meets) continue;
      if (node.child[c] >= 0) {
        stack[top++] = node.child[c];
        continue;
      }
      for (int i = ~node.child[c] * lanes; i < ~node.child[c] * lanes + node.count[c]; ++i) {
        const auto& [a, b, e] = corners_[i];
        if ((a.cwiseMin(b).cwiseMin(e).array() <= high.array()).all() &&
            (a.cwiseMax(b).cwiseMax(e).array() >= low.array()).all()) {
          out.push_back(order_[i]);
        }
      }
    }
  }
}

}  // namespace puffin::lbm::geometry
