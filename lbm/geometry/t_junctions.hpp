#pragma once
// Corners that lie on an edge of a triangle without being one of its ends: where meshes of different fineness meet.

#include <cstddef>
#include <vector>

#include "lbm/geometry/adjacency.hpp"

namespace puffin::lbm::geometry {

/// A corner off the ends of an edge is on it if it is nearer than this fraction of the bounding box's diagonal: ten
/// times what the single precision of an STL resolves.
constexpr double on_edge_fraction = 1e-6;

struct TJunction {
  int triangle = -1, edge = 0;  // edge k runs from corner k to corner (k + 1) % 3
  int vertex = -1;
  double at = 0.0;  // share of the edge, from corner k
};

/// All corners of edges with one triangle that lie inside other edges with one triangle; sorted by triangle, edge and
/// place. The mesh must be welded.
std::vector<TJunction> find_t_junctions(const TriangleMesh& mesh, const Adjacency& adjacency);

/// Splits triangles at the corners that lie on their edges, so that both sides share them. No vertex moves. Returns the
/// places of the corners, one for each split.
std::vector<Vec3> split_at_t_junctions(TriangleMesh& mesh);

}  // namespace puffin::lbm::geometry
