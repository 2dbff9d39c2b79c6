#pragma once
// Closing holes with new triangles. Used by repair only.

#include <cstddef>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

struct FilledHoles {
  std::size_t holes = 0, triangles = 0;
  std::vector<Vec3> where;  // [m] middle of each rim
};

/// Closes every hole whose rim is not longer than `longest_rim` [m] and has at most 300 corners (`fill_single_facets`:
/// also those of three corners, which have one flat filling only), by the triangulation
/// of least area over the rim's corners (Barequet & Sharir, Comput. Aided Geom. Des. 12, 207 (1995)). New triangles go
/// to the solid "filled-hole" and agree with their neighbours' orientation; no vertex is added.
FilledHoles fill_holes(TriangleMesh& mesh, double longest_rim, bool fill_single_facets = false);

}  // namespace puffin::lbm::geometry
