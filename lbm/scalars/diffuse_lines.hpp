#pragma once
// Implicit diffusion along lines of cells, for diffusivities whose explicit step would be short.

#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

/// Backward Euler along every line of direction d:
///   theta_i (Y_i' - Y_i) = sum over open faces of exchange (Y_j' - Y_i'),
/// solved by elimination; then the amounts are moved by the fluxes of the solution, so that what leaves one cell enters
/// the next to the bit. Unconditionally monotone (the matrix has a positive inverse with row sums 1). Absorbing walls
/// and openings with a fixed value exchange 2 `exchange`, as half a cell lies between; their turnover is booked.
/// exchange = steps * Gamma [lattice mass]. Updates the concentrations of the slots as well.
void diffuse_lines(const Rows& rows, const FaceFluxes& fluxes, int d, int scalar, const ScalarLaw& law, double exchange,
                   ScalarFields& fields, ScalarBudget& budget);

}  // namespace puffin::lbm
