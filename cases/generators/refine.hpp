#pragma once
// Subdivides a closed triangle surface until no edge is longer than asked, without changing its shape.

#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::cases::generators {

/// Halves the longest edge again and again (Rivara 1984: both triangles at the edge are cut, so the surface stays
/// conforming), and after each cut swaps diagonals inside planar faces to the Delaunay triangulation (Lawson 1977).
/// Edges between faces come before those inside, so that a narrow strip becomes a ladder and not a heap of slivers.
/// in : closed surface; face[t] = the planar face of triangle t: diagonals are swapped inside one face only
/// out: the same surface with all edges <= longest_edge; deterministic.
void refine(double longest_edge, lbm::geometry::TriangleMesh& mesh, std::vector<int>& face);

}  // namespace puffin::cases::generators
