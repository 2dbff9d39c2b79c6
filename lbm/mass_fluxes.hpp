#pragma once
// From the lattice's link exchange to mass fluxes through cell faces: what the scalars ride on.
//
// In one step the density of a cell changes by exactly what its links brought less what they took. An axis link is a
// flux through its face; a diagonal link goes half through each of its two corner routes (all through one if the cell
// of the other is solid). So the fluxes of the six faces balance the change of density to round-off.

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/air.hpp"
#include "lbm/band_fluxes.hpp"
#include "lbm/scalars/face_fluxes.hpp"

namespace puffin::lbm {

/// How the links of one air map onto faces; built once.
struct FluxRoutes {
  std::array<std::vector<std::uint16_t>, 3> shares;  // per face: halves (0, 1, 2) of eight diagonal links, 2 bits each
  struct Opening {
    std::ptrdiff_t slot;  // active cell
    std::int32_t run;
    std::int16_t direction;  // link that is cut by the opening
    std::int8_t axis, sign;  // face that takes its flux: +-axis of the cell
    std::ptrdiff_t face;     // slot that holds this face
  };
  std::vector<Opening> openings;
  /// What slides along a slip wall from one cell to the next.
  struct Slip {
    std::ptrdiff_t source;  // the cell that it leaves in `direction`
    std::int32_t run;
    std::int16_t direction;
    std::int8_t axis, sign;  // through the face +-axis of the source
    std::ptrdiff_t face;     // slot that holds this face
  };
  std::vector<Slip> slips;
  struct Copy {
    std::ptrdiff_t ghost, active;
  };
  std::vector<Copy> images;  // periodic ghosts repeat the faces of the cells they mirror
  BandFluxes band;           // of a wall with markers
};

/// Finds the routes and marks which faces are open, and which are passed over; sizes all arrays of `fluxes`.
FluxRoutes find_routes(const Air& air, FaceFluxes& fluxes);

/// Fluxes of the last step and the density after it. wall_speed: of the walls that moved in it [lattice units].
void find_mass_fluxes(const Air& air, const FluxRoutes& routes, double wall_speed, FaceFluxes& fluxes);

}  // namespace puffin::lbm
