#pragma once
// The air that passes a plane between two layers of cells in one step.

#include <cstdint>

#include "lbm/air.hpp"

namespace puffin::lbm {

/// Mass that the links carried in the last step from layer `index` of cells along `axis` (0, 1, 2) to layer index + 1,
/// less what they carried back [reference density dx^3]. Links that a wall at rest cuts carry nothing across; a moving
/// wall takes 6 w c.u_wall from the cell behind the plane and gives as much to the one before it. Density changes by
/// what links bring and take alone, so steady flow between walls at rest passes every plane equally, to rounding: which
/// the sum of rho u over the cells of a layer does not, where walls lie off the faces of cells (0.3 % at 20 cells
/// across).
struct PlaneFlux {
  double mass = 0.0;
  std::int64_t links = 0;  // across; 0 where one of the layers has no cells
};
/// wall_speed: of the walls that move, in lattice units. index: from -1, the last layer, whose
/// links to the first cross a periodic face; none beyond.
PlaneFlux plane_flux(const Air& air, double wall_speed, int axis, int index);

}  // namespace puffin::lbm
