#pragma once
// Make corners that coincide share one vertex.

#include <cstddef>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Merges vertices nearer than `tolerance` [m] to an earlier vertex (which keeps its place) and drops unused ones.
/// Vertices are visited in the order of their first use, so the result does not depend on threads. Triangles are never
/// removed; those with two equal corners become degenerate. Returns the number of vertices merged away.
std::size_t weld(TriangleMesh& mesh, double tolerance);

}  // namespace puffin::lbm::geometry
