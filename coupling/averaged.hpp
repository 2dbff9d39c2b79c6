#pragma once
// volume_fraction = "averaged": the carriers' volume stands in the equations of the air and of the fines (thesis
// eq. 2.1 and 2.12, the dense discrete phase model). What the lattice does with it: lbm/pore_space.hpp.
//
// alpha is 1 less the solid volume that the carriers' kernel spreads, at least 0.35. Carriers that hop from one
// exchange to the next would make a sound each time they arrive: alpha follows its target over `ramp_steps` air steps.
// The air takes -alpha grad p, so carriers take -V grad p (models.pressure_gradient need not be set), and that part has
// no reaction of its own: the sum of both is -grad p.

#include <span>

#include "coupling/state.hpp"

namespace puffin::coupling {

inline constexpr int ramp_steps = 20;

/// Sets how alpha will change in the next `steps` air steps, from the carriers' stencils of this exchange. At the very
/// first call alpha is at its target at once.
void follow_volume(const Models& models, int steps, State& state);

/// The force that was spread is one per volume of cell; per volume of air it is larger by 1/alpha.
void share_force(const lbm::PoreSpace& pores, lbm::BodyForce& force);

/// Least alpha of all cells.
double least_share(const lbm::PoreSpace& pores);

}  // namespace puffin::coupling
