#pragma once
// What is taken for a facet without area.

#include <algorithm>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

inline bool has_equal_corners(const std::array<int, 3>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Equal corners, or a height that is rounding: 1e-9 of the longest side.
inline bool has_no_area(const TriangleMesh& mesh, int triangle) {
  if (has_equal_corners(mesh.triangles[triangle])) return true;
  double longest = 0.0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, (mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).squaredNorm());
  return mesh.area_vector(triangle).norm() <= 1e-9 * longest;
}

}  // namespace puffin::lbm::geometry
