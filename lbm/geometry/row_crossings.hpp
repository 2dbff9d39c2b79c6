#pragma once
// Where the rows of a voxel box cross the triangles. Used by what classifies cells and links.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"
#include "lbm/geometry/voxels.hpp"

namespace puffin::lbm::geometry {

/// From cell `i` of a row onwards the winding number is larger by `step`.
struct Crossing {
  std::int32_t i = 0, step = 0;
};

/// Crossings of every row (j, k), in no special order within a row: those of row j + size[1] k are
/// crossings[first[row] .. first[row + 1]).
struct RowCrossings {
  std::vector<std::size_t> first;
  std::vector<Crossing> crossings;
};

/// Coordinates of an STL carry 2^-24 of the largest: a centre nearer than this to a triangle counts as on it, and so as
/// on its +x, +y, +z side: what is asked of a centre is asked this far along +x, +y and +z of it.
inline double on_surface(const Vec3& low, const Vec3& high, double dx) {
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  return std::min(1e-3 * dx, std::ldexp(largest, -22));
}

/// See voxelize.hpp for the method. The tested points are the centres moved by `shift` along +x, +y and +z.
RowCrossings row_crossings(const TriangleMesh& mesh, const Voxels& box, double shift);

}  // namespace puffin::lbm::geometry
