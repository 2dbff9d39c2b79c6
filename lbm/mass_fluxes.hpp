#pragma once
// From the lattice's link exchange to mass fluxes through cell faces: what the scalars ride on.
//
// In one step the density of a cell changes by exactly what its links brought less what they took. An axis link is a
// flux through its face; a diagonal link goes half through each of its two corner routes (all through one if the cell
// of the other is solid), so the six faces balance the density to round-off of the populations.

#include "lbm/air.hpp"
#include "lbm/scalars/face_fluxes.hpp"

namespace puffin::lbm {

/// Marks which faces are open; call once. Sizes all arrays of `fluxes`.
void open_faces(const Air& air, FaceFluxes& fluxes);

/// Fluxes of the last step and the density after it. Faces stay as open_faces set them.
void find_mass_fluxes(const Air& air, FaceFluxes& fluxes);

}  // namespace puffin::lbm
