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
/// u that of the cell, and zero where it points into the domain: with back-flow the term would feed itself. Returns the
/// number of cells with back-flow. Source: Ginzburg, Verhaeghe & d'Humieres, Commun. Comput. Phys. 3, 427 (2008).
template <class T>
std::int64_t apply_outlets(const Air& air, const Drive& drive, Parity last, std::size_t first, std::size_t end,
                           Populations<T>& p);

}  // namespace puffin::lbm
