#pragma once
// Do the fluxes fit the rows and the openings?

#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

/// Throws std::invalid_argument naming the first face or cell that breaks what advance_scalars.hpp asks of FaceFluxes.
void check_fluxes(const Rows& rows, const FaceFluxes& fluxes, const ScalarWork& work);

}  // namespace puffin::lbm
