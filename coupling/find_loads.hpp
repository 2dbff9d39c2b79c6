#pragma once
// What the air does to the carriers during one exchange interval.

#include "coupling/state.hpp"

namespace puffin::coupling {

/// Sets State::loads: velocity of the air and drag coefficient at every carrier, and the further forces of
/// field_forces.hpp, for `interval` [s]. Wants the stencils and the moments of the air's last step.
void find_loads(const Models& models, double interval, State& s);

}  // namespace puffin::coupling
