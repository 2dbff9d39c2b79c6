#pragma once
// Walls that take what drifts into them.

#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

/// The sinks of `fluxes` take over `steps` air steps the part 1 - exp(-rate steps) of every given scalar in their
/// cells: exact while a cell's rate stays, never more than is there, whatever the step. Booked in absorbed_at, as the
/// difference of the rounded amounts. The sinks' slots must differ.
void take_at_walls(const FaceFluxes& fluxes, double steps, const std::vector<int>& scalars, ScalarFields& fields,
                   ScalarBudget& budget);

}  // namespace puffin::lbm
