#pragma once
// Implicit diffusion along lines of cells, for diffusivities whose explicit step would be short.

#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

/// Along every line of direction d, between the old concentrations Y and the new ones Y':
///   theta_i (Y_i' - Y_i) = sum over open faces of exchange (Z_j - Z_i),   Z = e Y + (1 - e) Y',
/// exchange = steps * diffusivity [lattice mass], e = 1/2 (Crank & Nicolson 1947, second order in time) or as much as
/// lets nothing change sign, 2 e exchange (number of faces) <= theta; for long steps close to backward Euler. Where the
/// scalars drift (FaceFluxes::drift), the drift is part of the same exchange, so that both can balance to rounding.
/// Solved by elimination; then the amounts are moved by the fluxes of the solution, so that what leaves one cell enters
/// the next to the bit. Unconditionally monotone: the explicit part takes no more than half of what a cell holds, the
/// matrix has a positive inverse. Absorbing walls, and walls and openings with a fixed value, exchange 2 `exchange`, as
/// half a cell lies between; their turnover is booked. Always in double; the concentrations of the sweeps are left as
/// they were.
void diffuse_lines(const Rows& rows, const FaceFluxes& fluxes, int d, int scalar, const ScalarLaw& law, double steps,
                   ScalarFields& fields, ScalarBudget& budget);

}  // namespace puffin::lbm
