#pragma once
// The air's part of one exchange interval.

#include <span>
#include <vector>

#include "coupling/advance_together.hpp"
#include "coupling/state.hpp"

namespace puffin::coupling {

/// Whether the lattice computes the air. A frozen field may have cells too: the fines need them.
inline bool computes_air(const Models& models, const State& s) { return s.air && !models.frozen_air; }

/// The step in whose units the cells hold velocities and fluxes [s]: of a frozen field that it was laid out with, even
/// if a retreat has shortened the steps since.
inline double step_of_cells(const Models& models, const State& s) {
  return computes_air(models, s) || !s.air ? s.scale.dt : models.time_step.reference_dt;
}

/// What the carriers give the air [N s] by place in `stencils`: the impulse that they owe, and for `interval` [s] the
/// force of those that rest.
std::vector<Vec3> impulse_for(double interval, const State& s);

/// The carriers' reaction of the last interval becomes a force in the cells during `interval` [s].
void give_reaction(double interval, State& s);

/// `steps` steps of the air; `rescale`: dt/dt_before, applied with the first. `beside`: further states whose carriers
/// will ask for the air's velocity. Throws Diverged.
void step_air(const Models& models, int steps, double rescale, std::span<const Companion> beside, State& s);

}  // namespace puffin::coupling
