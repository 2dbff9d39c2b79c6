#include "lbm/geometry/tree_build.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace puffin::lbm::geometry {

TriangleTree::Builder::Builder(const TriangleMesh& mesh, const Vec3& centre, double widen)
    : centre_(centre), widen_(widen) {
  const int n = static_cast<int>(mesh.triangles.size());
  order.resize(n);
  boxes_.resize(n);
  mids_.resize(n);
  std::iota(order.begin(), order.end(), 0);
  tbb::parallel_for(tbb::blocked_range<int>(0, n, 4096), [&](const tbb::blocked_range<int>& r) {
    for (int t = r.begin(); t < r.end(); ++t) {
      for (int k = 0; k < 3; ++k) boxes_[t].add(mesh.corner(t, k));
      mids_[t] = 0.5 * (boxes_[t].low + boxes_[t].high);
    }
  });
  Range all{0, n, 0, bounds(0, n)};
  nodes = build(all);
  boxes_ = {};
  mids_ = {};
  number_leaves();
}

// Until here a leaf is named by its first triangle.
void TriangleTree::Builder::number_leaves() {
  std::vector<std::int32_t> by_slot;
  by_slot.reserve(order.size() + order.size() / 4 + lanes);
  for (TreeNode& node : nodes)
    for (int c = 0; c < lanes; ++c) {
      if (node.count[c] == 0 || node.child[c] >= 0) continue;
      const auto first = order.begin() + ~node.child[c];
      node.child[c] = ~static_cast<std::int32_t>(by_slot.size() / lanes);
      by_slot.insert(by_slot.end(), first, first + node.count[c]);
      by_slot.insert(by_slot.end(), static_cast<std::size_t>(lanes - node.count[c]), -1);
    }
  order = std::move(by_slot);
}

TriangleTree::Builder::Box TriangleTree::Builder::bounds(int begin, int end) const {
  Box box;
  for (int i = begin; i < end; ++i) box.add(boxes_[order[i]]);
  return box;
}

// Two parts of a range with more than leaf_size triangles, neither empty.
std::array<TriangleTree::Builder::Range, 2> TriangleTree::Builder::split(const Range& range) {
  Box mids;
  for (int i = range.begin; i < range.end; ++i) mids.add(mids_[order[i]]);
  const Vec3 extent = mids.high - mids.low;

  double best_cost = std::numeric_limits<double>::infinity();
  int best_axis = -1, best_bin = 0;
  auto bin_of = [&](int axis, int triangle) {
    const int b = static_cast<int>(bins * ((mids_[triangle][axis] - mids.low[axis]) / extent[axis]));
    return std::clamp(b, 0, bins - 1);
  };
  for (int axis = 0; axis < 3 && range.depth < deepest_by_area; ++axis) {
    if (!(extent[axis] > 0.0)) continue;
    std::array<Box, bins> box;
    std::array<int, bins> count{};
    for (int i = range.begin; i < range.end; ++i) {
      const int b = bin_of(axis, order[i]);
      ++count[b];
      box[b].add(boxes_[order[i]]);
    }
    std::array<double, bins> left_cost{};
    Box sum;
    int n = 0;
    for (int b = 0; b < bins - 1; ++b) {
      sum.add(box[b]);
      n += count[b];
      left_cost[b] = n ? n * sum.half_area() : std::numeric_limits<double>::infinity();
    }
    sum = Box();
    n = 0;
    for (int b = bins - 1; b > 0; --b) {
      sum.add(box[b]);
      n += count[b];
      const double cost = n ? left_cost[b - 1] + n * sum.half_area() : std::numeric_limits<double>::infinity();
      if (cost < best_cost) {
        best_cost = cost;
        best_axis = axis;
        best_bin = b;
      }
    }
  }

  int middle = range.begin + range.size() / 2;
  const auto split_at_middle = [&](int axis) {
    std::nth_element(order.begin() + range.begin, order.begin() + middle, order.begin() + range.end, [&](int a, int b) {
      return mids_[a][axis] != mids_[b][axis] ? mids_[a][axis] < mids_[b][axis] : a < b;
    });
  };
  if (best_axis >= 0 && range.size() < whole_leaves_below) {
    const auto left = std::count_if(order.begin() + range.begin, order.begin() + range.end,
                                    [&](int t) { return bin_of(best_axis, t) < best_bin; });
    const int most = (range.size() - 1) / leaf_size;  // full leaves that leave something for the other part
    const int full = std::clamp((static_cast<int>(left) + leaf_size / 2) / leaf_size, 1, most);
    middle = range.begin + full * leaf_size;
    split_at_middle(best_axis);
  } else if (best_axis >= 0) {
    const auto m = std::partition(order.begin() + range.begin, order.begin() + range.end,
                                  [&](int t) { return bin_of(best_axis, t) < best_bin; });
    middle = static_cast<int>(m - order.begin());
  } else {  // too deep or all in one point: halves
    int axis = 0;
    extent.maxCoeff(&axis);
    split_at_middle(axis);
  }
  return {Range{range.begin, middle, range.depth + 1, bounds(range.begin, middle)},
          Range{middle, range.end, range.depth + 1, bounds(middle, range.end)}};
}

TreeNode TriangleTree::Builder::empty_node() {
  TreeNode node;
  for (int d = 0; d < 3; ++d) {
    std::fill_n(node.low[d], lanes, std::numeric_limits<float>::infinity());
    std::fill_n(node.high[d], lanes, -std::numeric_limits<float>::infinity());
  }
  std::fill_n(node.child, lanes, 0);
  std::fill_n(node.count, lanes, 0);
  return node;
}

void TriangleTree::Builder::set_child(TreeNode& node, int c, const Box& box) const {
  for (int d = 0; d < 3; ++d) {
    node.low[d][c] = static_cast<float>(box.low[d] - centre_[d] - widen_);
    node.high[d][c] = static_cast<float>(box.high[d] - centre_[d] + widen_);
  }
}

std::vector<TreeNode> TriangleTree::Builder::build(const Range& range) {
  // Split the largest part until there are eight or all are leaves.
  std::vector<Range> parts{range};
  while (parts.size() < lanes) {
    auto largest = parts.end();
    for (auto p = parts.begin(); p != parts.end(); ++p) {
      if (p->size() <= leaf_size) continue;
      if (largest == parts.end() || p->box.half_area() > largest->box.half_area()) largest = p;
    }
    if (largest == parts.end()) break;
    const auto halves = split(*largest);
    *largest = halves[0];
    parts.insert(largest + 1, halves[1]);
  }

  std::vector<TreeNode> result{empty_node()};
  std::array<std::vector<TreeNode>, lanes> subtrees;
  const int n = static_cast<int>(parts.size());
  auto subtree = [&](int c) {
    if (parts[c].size() > leaf_size) subtrees[c] = build(parts[c]);
  };
  if (range.size() > serial_below) {
    tbb::parallel_for(0, n, subtree);
  } else {
    for (int c = 0; c < n; ++c) subtree(c);
  }
  for (int c = 0; c < n; ++c) {
    TreeNode& root = result[0];
    set_child(root, c, parts[c].box);
    root.count[c] = parts[c].size();
    if (subtrees[c].empty()) {
      root.child[c] = ~parts[c].begin;
      continue;
    }
    const auto offset = static_cast<std::int32_t>(result.size());
    root.child[c] = offset;
    for (TreeNode node : subtrees[c]) {
      for (int k = 0; k < lanes; ++k) {
        if (node.count[k] > 0 && node.child[k] >= 0) node.child[k] += offset;
      }
      result.push_back(node);
    }
  }
  return result;
}

}  // namespace puffin::lbm::geometry
