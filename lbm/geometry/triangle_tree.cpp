#include "lbm/geometry/triangle_tree.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lbm/geometry/node_bounds.hpp"
#include "lbm/geometry/tree_build.hpp"
#include "lbm/geometry/triangle_distance.hpp"

namespace puffin::lbm::geometry {

namespace {

// Room for the deepest tree the builder makes: at most 40 splits by area and 31 by halving, two a level, three siblings
// left behind a level.
constexpr int stack_size = 256;

// Single precision arithmetic on boxes may be off by this fraction; bounds are slackened by it.
constexpr float slack = 1e-6f;

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
  corners_.reserve(order_.size());
  for (const int t : order_) corners_.push_back({mesh_->corner(t, 0), mesh_->corner(t, 1), mesh_->corner(t, 2)});
  set_dipoles();
}

Closest TriangleTree::closest(const Vec3& p, double limit) const {
  const Vec3 q = p - centre_;
  const auto point4 = four_times(static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()));
  double best = limit * limit;
  Closest result;

  struct Entry {
    std::int32_t child, count;
    float bound;  // of the squared distance
  };
  std::array<Entry, stack_size> stack;
  int top = 0;
  stack[top++] = {0, 1, 0.0f};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.bound > best) continue;
    if (entry.child < 0) {
      const int begin = ~entry.child;
      for (int i = begin; i < begin + entry.count; ++i) {
        const auto& [a, b, c] = corners_[i];
        const Vec3 point = nearest_on_triangle(p, a, b, c).point;
        const double d2 = (point - p).squaredNorm();
        if (d2 <= best && (d2 < best || result.triangle < 0)) {
          best = d2;
          result.point = point;
          result.triangle = order_[i];
        }
      }
      continue;
    }
    const Node& node = nodes_[entry.child];
    const Lanes bound = squared_distances(node, point4) * (1.0f - slack);
    const int first = top;
    for (int c = 0; c < 4; ++c) {
      if (node.count[c] == 0 || bound[c] > best) continue;
      int at = top++;
      for (; at > first && stack[at - 1].bound < bound[c]; --at) stack[at] = stack[at - 1];
      stack[at] = {node.child[c], node.count[c], bound[c]};
    }
  }
  if (result.triangle >= 0) result.distance = std::sqrt(best);
  return result;
}

void TriangleTree::overlapping(const Vec3& low, const Vec3& high, std::vector<int>& out) const {
  std::array<std::int32_t, stack_size> stack;
  int top = 0;
  stack[top++] = 0;
  const Vec3 l = low - centre_, h = high - centre_;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    for (int c = 0; c < 4; ++c) {
      if (node.count[c] == 0) continue;
      bool meets = true;
      for (int d = 0; d < 3; ++d) meets = meets && node.low[d][c] <= h[d] && node.high[d][c] >= l[d];
      if (!meets) continue;
      if (node.child[c] >= 0) {
        stack[top++] = node.child[c];
        continue;
      }
      for (int i = ~node.child[c]; i < ~node.child[c] + node.count[c]; ++i) {
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
