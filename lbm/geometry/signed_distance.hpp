#pragma once
// How far a point lies from a surface, and on which side.

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Distance [m] to the surface, positive inside the enclosed volume (the fluid), negative outside; exact to rounding.
///
/// The side. Where the surface is closed, points outwards and neither crosses nor overlaps itself (found out once, at
/// construction), by the normal at the nearest point: of the face, the sum of both faces' at an edge, weighted by the
/// angles at a vertex (Baerentzen & Aanaes, IEEE TVCG 11(3), 243 (2005)). Else, and where that normal is undecided, by
/// the generalised winding number, which small holes, overlaps and turned facets do not mislead.
///
/// Immutable and safe to ask from any thread. Checked by: tests/lbm/geometry/test_signed_distance.cpp
class SignedDistance {
 public:
  /// Searches for self-intersections unless the caller knows the answer: about as long as building the tree.
  explicit SignedDistance(std::shared_ptr<const TriangleTree> tree);

  /// Signed distance within `limit` [m]; +limit or -limit by the winding number if the surface is farther.
  double operator()(const Vec3& p, double limit = std::numeric_limits<double>::infinity()) const;

  /// The same for many points at once, in parallel: several times faster than one by one, with equal answers. Points
  /// are visited along a Morton curve, so that the nearest point of one bounds the search of the next and what it
  /// touches is still in the cache.
  std::vector<double> at(std::span<const Vec3> points, double limit = std::numeric_limits<double>::infinity()) const;

  /// Do normals decide the side?
  bool simple() const { return simple_; }

 private:
  double sign(const Vec3& p, const Closest& nearest) const;

  std::shared_ptr<const TriangleTree> tree_;
  bool simple_ = false;
};

}  // namespace puffin::lbm::geometry
