#pragma once
// Air that shares its cells with something solid: the volume-averaged equations of Anderson & Jackson (Ind. Eng. Chem.
// Fundam. 6, 527 (1967)), in which alpha is the part of a cell that is air,
//   d_t(alpha rho) + div(alpha rho u) = 0,
//   d_t(alpha rho u) + div(alpha rho u u) = -alpha grad p + alpha div(tau) - F,
// F being what the solid takes. Divided by alpha they are those of the plain lattice with the sources
//   S = -rho (d_t alpha + u . grad alpha)/alpha  of mass,   u S  of momentum,   and the force -F/alpha.
// (The stress stands outside of its divergence: tau . grad alpha is left out, beside a drag of 18 mu phi u/d^2 smaller
// by (d/L)^2/18 where alpha changes over the length L; L is at least 1.5 d for the kernel that spreads carriers.)
//
// S is taken link by link, so that the air's mass, the sum of alpha rho, is kept to rounding. Through the link from x
// to y passes what departed from y less what departed from x; it should count (alpha_x + alpha_y)/2 and has counted 1:
//   alpha_x S_x = sum over links of (alpha_y - alpha_x)/2 (departed_y - departed_x),
// and a changing alpha rescales the density, rho alpha = constant. Links that a wall or an opening cuts count alpha_x.
// Everything in lattice units. Checked by: tests/lbm/test_pore_space.cpp

#include <cstdint>
#include <vector>

#include "lbm/air.hpp"
#include "lbm/mass_fluxes.hpp"

namespace puffin::lbm {

struct PoreSpace {
  std::vector<double> share;        // alpha by slot, 1 outside of `cells`; empty: no cell is shared
  std::vector<std::int32_t> cells;  // slots that are shared, or beside such, ascending
  std::vector<double> rate;         // change of alpha in one step, by place in `cells`
  std::vector<double> excess;       // scratch: S alpha of the step
  std::vector<std::int32_t> home;   // by slot: itself if active, the active cell that a periodic ghost mirrors, else -1
};

/// All of the air's own: alpha = 1 everywhere.
PoreSpace make_pore_space(const Air& air);

/// The shared cells become `slots`, and their neighbours along links; in these alpha will change by `change` in each of
/// the coming steps. Cells that are left out must have alpha = 1. in: one change a slot, each slot once.
void set_shared(const std::vector<std::int32_t>& slots, const std::vector<double>& change, const Air& air,
                PoreSpace& pores);

/// Between collide_and_stream and apply_links: notes what passes through the links of the shared cells.
void measure_exchange(const Air& air, PoreSpace& pores);

/// After apply_links: takes or gives the mass S with the velocity of the cell, and moves alpha by one step.
void apply_exchange(Air& air, PoreSpace& pores);

/// The fluxes that carry scalars in the volume-averaged sense: density times alpha, mass through a face times the mean
/// alpha of its two sides. `fluxes` must be those of find_mass_fluxes.
void share_fluxes(const Air& air, const PoreSpace& pores, const FluxRoutes& routes, FaceFluxes& fluxes);

}  // namespace puffin::lbm
