#pragma once
// On which side of a thin wall a cell lies, where live bands behind walls (markers.hpp) could meet inside it.
//
// Each cell near a wall knows its nearest wall: the point and the normal out of the fluid. Two cells, or a cell and a
// marker, are parted by a thin wall if their walls face away from each other: normals opposed, and the second wall
// ahead along the first one's normal. So a wall is divided at its medial surface. A narrow gap of fluid has opposed
// normals too, but there the second wall lies behind.

#include <cstdint>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"
#include "lbm/links.hpp"
#include "lbm/rows.hpp"

namespace puffin::lbm {

struct WallPlace {
  geometry::Vec3 point = geometry::Vec3::Zero();   // nearest point of the wall [m]
  geometry::Vec3 normal = geometry::Vec3::Zero();  // out of the fluid
  double distance = 0.0;                           // [m] from the cell's centre
  int triangle = -1;                               // of the surface
};

class WallSides {
 public:
  /// Walls within `reach` cells of the computed cells.
  WallSides(const Rows& rows, const LinkGeometry& surface, double reach);

  const WallPlace* of(std::ptrdiff_t slot) const {
    const std::int32_t n = index_[slot];
    return n < 0 ? nullptr : &places_[n];
  }
  /// A thin wall lies between a cell (or marker) whose wall is `a` and one whose wall is `b`.
  bool parted(const WallPlace& a, const WallPlace& b) const;
  /// From the wall point of `a` to that of `b`, the short way across periodic faces [m].
  geometry::Vec3 apart(const WallPlace& a, const WallPlace& b) const;

 private:
  std::vector<std::int32_t> index_;  // by slot
  std::vector<WallPlace> places_;
  geometry::Vec3 period_ = geometry::Vec3::Zero();  // [m], 0: not periodic
};

}  // namespace puffin::lbm
