#pragma once
// Triangles that cross other triangles.

#include <vector>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

struct Intersection {
  int a = -1, b = -1;  // the two triangles, a < b
  Vec3 where = Vec3::Zero();
};

/// Pairs of triangles of which an edge of one passes through the interior of the other, or through an edge of it and
/// there through the surface (the diagonal of a square), or that lie in one plane, face
/// the same way and overlap by more than a millionth of the smaller; sorted by (a, b). Pairs that share a vertex are
/// tested with the edges that do not touch it. Pairs that only touch do not count, nor do faces that lie on each other
/// back to back (the common face of two bodies), nor copies of one triangle (a duplicate facet).
std::vector<Intersection> find_self_intersections(const TriangleMesh& mesh);
std::vector<Intersection> find_self_intersections(const TriangleTree& tree);

}  // namespace puffin::lbm::geometry
