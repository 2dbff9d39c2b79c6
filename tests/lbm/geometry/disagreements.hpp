#pragma once
// Cells beside the surface that they are made from.

#include <cstddef>

#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxels.hpp"

namespace puffin::lbm::geometry {

/// What voxelize promises, cell by cell, from the winding number alone; cells nearer than `near` to the surface may be
/// either.
inline std::size_t disagreements(const TriangleTree& tree, const Voxels& v, double near) {
  std::size_t wrong = 0;
  for (int k = 0; k < v.size[2]; ++k) {
    for (int j = 0; j < v.size[1]; ++j) {
      for (int i = 0; i < v.size[0]; ++i) {
        const Vec3 c = v.centre(i, j, k);
        if (v.is_fluid(i, j, k) != tree.inside(c) && tree.closest(c).distance > near) ++wrong;
      }
    }
  }
  return wrong;
}

}  // namespace puffin::lbm::geometry
