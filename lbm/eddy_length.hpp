#pragma once
// The mixing length of the eddy viscosity, cell by cell: damped at walls, raised before outlets.

#include <vector>

#include "lbm/air.hpp"

namespace puffin::lbm {

/// 18 sqrt2 L^2 with L = min(C_s, d/14), d the wall distance in cells (at least 1/2), and C_s raised up to threefold in
/// the sponge. d/14: the cell beside a wall (y+ of 20 to 60 at device scale) then carries the stress of the log law,
/// tau_w = rho (L u/d)^2 = rho (u/u+)^2 with u+ = 14. With kappa d instead (0.2 at d = 1/2, so C_s) the friction of a
/// channel 6 cells high came out five times too large: docs/decisions/0002-mixing-length-at-walls.md.
/// Vreman's viscosity needs no help at walls, so there L = C_s but for the sponge; returned is c L^2, c = 2.5.
std::vector<float> eddy_lengths(const Rows& rows, const LinkGeometry& surface, const AirOptions& options);

}  // namespace puffin::lbm
