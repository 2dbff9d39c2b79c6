#pragma once
// One force evaluation of one touch: the state machine of a contact. See contact_step.cpp.

#include "dem/cluster.hpp"

namespace puffin::dem {

/// Evaluates touch `index` at the bodies' positions and end velocities (v + kick), after a sub-step h [s] that ended at
/// `time`: adds its forces to the bodies, moves its springs, and makes it begin, bond or end.
/// h = 0: the forces of the present state.
/// Returns the largest next sub-step [s] that this touch allows, infinity if it does not care. `horizon` [s]: times
/// beyond it need not be told apart. `live` becomes true if the touch carries forces.
double evaluate(std::size_t index, double h, double time, double horizon, const Rules& rules, Cluster& cluster,
                bool& live);

/// Keeps the largest overlap of the touch in the cluster's record.
void note_overlap(const Touch& touch, Cluster& cluster);

/// Ends a live contact at `time` and logs it.
void end_contact(double time, Cluster& cluster, Touch& touch);

}  // namespace puffin::dem
