#pragma once
// Winding numbers of a surface that is not closed, by way of one that is. Used by voxelize only.

#include <memory>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Triangles that close a surface: every edge that is run through more often in one direction than in the other, joined
/// to the middle of the rim it belongs to. Winding numbers add up over triangles, so the generalised winding number of
/// the given surface is w = n - w_caps, with the integer n of the closed surface, which counting crossings gives.
class ClosingCaps {
 public:
  ClosingCaps(const TriangleMesh& mesh, const Adjacency& adjacency);

  bool empty() const { return !caps_; }
  /// The given mesh, with its caps if there are any. Lives as long as both this and the given mesh.
  const TriangleMesh& closed() const { return closed_ ? *closed_ : mesh_; }
  /// |n - w_caps(p)| > 1/2 where n is the winding number of the closed surface at p.
  bool inside(int n, const Vec3& p) const;

 private:
  const TriangleMesh& mesh_;
  std::unique_ptr<TriangleMesh> closed_;
  std::unique_ptr<TriangleTree> caps_;
  double reach_ = 0.0;  // farther from every cap than this, |w_caps| < 1/2
};

}  // namespace puffin::lbm::geometry
