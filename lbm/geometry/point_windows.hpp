#pragma once
// Which of many points lie in a box.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Points sorted along each axis. Not a tree: long thin boxes, such as those of edges along a pipe, have few points on
/// one axis at least, and that one is taken.
class PointWindows {
 public:
  /// Of the points those named by `which`; the points must outlive this.
  PointWindows(const std::vector<Vec3>& points, const std::vector<int>& which) : points_(points) {
    for (int d = 0; d < 3; ++d) {
      sorted_[d] = which;
      std::sort(sorted_[d].begin(), sorted_[d].end(),
                [&](int a, int b) { return points[a][d] != points[b][d] ? points[a][d] < points[b][d] : a < b; });
      sorted_[d].erase(std::unique(sorted_[d].begin(), sorted_[d].end()), sorted_[d].end());
    }
  }

  /// All that lie in the box, and others that lie in it along one axis: ask them again.
  std::span<const int> candidates(const Vec3& low, const Vec3& high) const {
    std::span<const int> fewest;
    for (int d = 0; d < 3; ++d) {
      const auto& s = sorted_[d];
      const auto begin = std::partition_point(s.begin(), s.end(), [&](int p) { return points_[p][d] < low[d]; });
      const auto end = std::partition_point(begin, s.end(), [&](int p) { return points_[p][d] <= high[d]; });
      const std::span<const int> found(begin, end);
      if (d == 0 || found.size() < fewest.size()) fewest = found;
    }
    return fewest;
  }

 private:
  const std::vector<Vec3>& points_;
  std::array<std::vector<int>, 3> sorted_;
};

}  // namespace puffin::lbm::geometry
