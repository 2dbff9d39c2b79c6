#pragma once
// Which cells of a uniform grid have their centre inside a closed surface.

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// A box of cubic cells. Cell (i,j,k) has its centre at origin + dx (i,j,k); x runs fastest in `fluid`.
struct Voxels {
  Vec3 origin = Vec3::Zero();  // centre of cell (0,0,0)
  double dx = 0.0;             // edge of a cell
  std::array<int, 3> size{0, 0, 0};
  std::vector<std::uint8_t> fluid;  // size[0]*size[1]*size[2]; 1: the centre is inside the surface

  std::int64_t index(int i, int j, int k) const {
    return i + static_cast<std::int64_t>(size[0]) * (j + static_cast<std::int64_t>(size[1]) * k);
  }
  bool inside_box(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  bool is_fluid(int i, int j, int k) const { return inside_box(i, j, k) && fluid[index(i, j, k)] != 0; }
  Vec3 centre(int i, int j, int k) const { return origin + dx * Vec3(i, j, k); }
};

}  // namespace puffin::lbm::geometry
