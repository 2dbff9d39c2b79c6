#pragma once
// What comes back along the links that an inlet or an outlet cuts.

#include <cstdint>

#include "lbm/air.hpp"

namespace puffin::lbm {

/// Velocity bounce-back at the inlet links [first, end): f_in = f_out - 6 w c.u; mass flux exactly as asked.
/// Source: Ladd, J. Fluid Mech. 271, 285 (1994). `last`: the collision that has just been done.
template <class T>
void apply_inlets(const Air& air, const Drive& drive, Parity last, std::size_t first, std::size_t end,
                  Populations<T>& p);

/// Anti-bounce-back at the outlet links [first, end), which divide no cell:
///   f_in = -f_out + 2 w rho (1 + 9/2 (c.u)^2 - 3/2 u^2),
/// u that of the cell. Where it points into the domain the term would feed itself: u is shortened until its dynamic
/// pressure is at most what this outlet lies above the lowest one, which is all that air at rest could have gained. So
/// air enters at the static pressure asked where pressures drive the flow, and back-flow at the lowest (or only) outlet
/// is cut: u = 0. Returns the number of cells whose u was shortened. Source: Ginzburg, Verhaeghe & d'Humieres, Commun.
/// Comput. Phys. 3, 427 (2008).
template <class T>
std::int64_t apply_outlets(const Air& air, const Drive& drive, Parity last, std::size_t first, std::size_t end,
                           Populations<T>& p);

}  // namespace puffin::lbm
