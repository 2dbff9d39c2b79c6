#pragma once
// Triangles that cross other triangles.

#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

struct Intersection {
  int a = -1, b = -1;  // the two triangles, a < b
  Vec3 where = Vec3::Zero();
};

/// Pairs of triangles of which an edge of one passes through the interior of the other, sorted by (a, b). Pairs that
/// share a vertex are tested with the edges that do not touch it. Exactly touching or coplanar pairs do not count.
std::vector<Intersection> find_self_intersections(const TriangleMesh& mesh);

}  // namespace puffin::lbm::geometry
