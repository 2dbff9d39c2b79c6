#pragma once
// How much of the space around a carrier is solid, for the drag laws of beds and for volume_fraction = "drag".

#include <span>

#include "coupling/transfer.hpp"

namespace puffin::coupling {

/// The air keeps at least 0.35 of every cell: random close packing of equal spheres leaves 0.36, and the kernel does
/// not see the packing's gaps.
inline constexpr double largest_solid_fraction = 0.65;

/// Solid fraction at the carriers: phi_j = min(sum_p w_pj V_p / dx^3, 0.65) in the cells, phi_p = sum_j w_pj phi_j.
/// It contains the carrier itself. Returns the largest sum in a cell, before the limit. in: `solid_volume` [m^3] by
/// carrier index (of all carriers of a parcel); the cell's edge dx [m]. out: `fraction` by carrier index. Cells cut by
/// walls count as whole cells.
double solid_fraction(const Stencils& stencils, std::span<const double> solid_volume, double dx, Spreader& spreader,
                      std::span<double> fraction);

}  // namespace puffin::coupling
