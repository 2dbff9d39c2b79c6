#pragma once
// Where the rows of a voxel box cross the triangles. Used by voxelize only.

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

/// See voxelize.hpp for the method. The tested points are the centres moved by `shift` along +x, +y and +z.
RowCrossings row_crossings(const TriangleMesh& mesh, const Voxels& box, double shift);

}  // namespace puffin::lbm::geometry
