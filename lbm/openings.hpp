#pragma once
// What comes back along the links that an inlet or an outlet cuts.

#include <cstdint>
#include <vector>

#include "lbm/air.hpp"
#include "lbm/link_schedule.hpp"

namespace puffin::lbm {

/// Velocity bounce-back at the inlet links [first, end): f_in = f_out - 6 w c.u; mass flux exactly as asked.
/// Source: Ladd, J. Fluid Mech. 271, 285 (1994). `last`: the collision that has just been done.
template <class T>
void apply_inlets(const Air& air, const Drive& drive, Parity last, std::size_t first, std::size_t end,
                  Populations<T>& p);

/// Number of the first link of a cell in a list sorted by slot, -1 if it has none.
std::int32_t first_outlet_link(const std::vector<OpeningLink>& outlets, std::ptrdiff_t slot);

/// Per outlet link. An outlet is straight if all faces of fluid cells that it closes look along one axis and it ends
/// where the fluid does: no cell beside one before it is closed on the same side by something else, as around a hole in
/// a wall. fluid: by slot; empty: every active cell is. At a cell the outlet lies across the axis along which it closes
/// a face of the cell; of several, or of none, the one along which it closes most faces of cells.
std::vector<OutletSource> find_outlet_sources(const Rows& rows, const std::vector<OpeningLink>& outlets,
                                              const std::vector<std::uint8_t>& fluid = {});

/// The air of a cell before an outlet as its last collision left it.
struct OutletAir {
  double density_excess = 0.0;
  geometry::Vec3 velocity{0, 0, 0};
};

/// That of the cells of the outlet links [first, end), at the first link of each; before walls act on them.
template <class T>
void find_outlet_air(const Air& air, Parity last, std::size_t first, std::size_t end, const Populations<T>& p,
                     std::vector<OutletAir>& state);

/// Per boundary: the dynamic pressure, as an excess of density, that air may bring in through an outlet that air enters
/// by as a whole, where nothing but a force or walls move it: no velocity inlet, one pressure at all outlets. It is the
/// largest that leaves through the others, so that no passage gains by it (in one of equal ends it is what enters).
/// Elsewhere 0.
std::vector<double> entering_heads(const Air& air, const Drive& drive, const std::vector<OutletAir>& state);

/// Outlet links [first, end), which divide no cell; `state` of every cell is known. Where the air leaves through a
/// straight outlet, what comes back is what the cells before the outlet hold, as if the flow went on beyond it with the
/// slope that its momentum rho u has over the last two cells, but for its pressure:
///   f_in(x) = f_in(x + t) + 3 w (c.n) c_in.(rho u(x + t) - rho u(x + t - n)) + 2 w (rho_out - rho(x + t)),
/// n one step out, c.n 1 but along the risers of a staircase, f_in(x + t) having left the cell beside (OutletSource),
/// so that the outlet lies half-way with rho_out. Exact for parallel shear flow at any tau;
/// docs/decisions/0026-what-comes-back-at-outlets.md.
/// Elsewhere, anti-bounce-back (Ginzburg, Verhaeghe & d'Humieres, Commun. Comput. Phys. 3, 427 (2008)):
///   f_in = -f_out + 2 w rho_out (1 + 9/2 (c.u)^2 - 3/2 u^2),
/// u that of the cell; where the air enters, shortened until its dynamic pressure is at most what this outlet lies
/// above the lowest one, which is all that air at rest could have gained, or that of `heads` (entering_heads). So air
/// enters at the static pressure asked where pressures, a force or a sliding wall drive it in, and all other
/// back-flow at the lowest (or only) outlet is cut: u = 0. Returns the number of cells whose u was shortened.
template <class T>
std::int64_t apply_outlets(const Air& air, const Drive& drive, const std::vector<OutletAir>& state,
                           const std::vector<double>& heads, Parity last, std::size_t first, std::size_t end,
                           Populations<T>& p);

}  // namespace puffin::lbm
