#pragma once
// Building the hierarchy of a TriangleTree. Used by triangle_tree.cpp only.

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Sorts the triangles of a mesh into nodes with eight children, split by the surface area heuristic in bins (Wald,
/// IEEE Symp. Interactive Ray Tracing 33 (2007)). Leaves are full where they can be: small ranges are split
/// after a whole number of leaves. Ranges above `serial_below` triangles are split in parallel; where to split never
/// depends on threads.
class TriangleTree::Builder {
 public:
  Builder(const TriangleMesh& mesh, const Vec3& centre, double widen);

  std::vector<std::int32_t> order;  // leaf * lanes + lane -> triangle, -1 where a leaf is not full
  std::vector<TreeNode> nodes;      // root first, children after their parent

 private:
  static constexpr int bins = 16, leaf_size = lanes, serial_below = 8192, deepest_by_area = 40,
                       whole_leaves_below = 1024;

  struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
    void add(const Vec3& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    void add(const Box& b) {
      low = low.cwiseMin(b.low);
      high = high.cwiseMax(b.high);
    }
    double half_area() const {
      const Vec3 e = (high - low).cwiseMax(0.0);
      return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
    }
  };
  struct Range {
    int begin = 0, end = 0, depth = 0;
    Box box;
    int size() const { return end - begin; }
  };

  Box bounds(int begin, int end) const;
  std::array<Range, 2> split(const Range& range);
  std::vector<TreeNode> build(const Range& range);  // the subtree, its root first
  void number_leaves();
  static TreeNode empty_node();
  void set_child(TreeNode& node, int c, const Box& box) const;

  Vec3 centre_;
  double widen_;
  std::vector<Box> boxes_;  // per triangle
  std::vector<Vec3> mids_;  // per triangle: centre of its box
};

}  // namespace puffin::lbm::geometry
