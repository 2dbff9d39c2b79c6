#pragma once
// How long carriers and air may go without each other.

#include "coupling/state.hpp"

namespace puffin::coupling {

/// Whether no carrier is awake.
bool all_asleep(const dem::Carriers& carriers);

/// Air steps that the next exchange interval may have: no more than leave drag its size (drag_limit.hpp). Carriers at
/// rest wait longer, where that is half as much.
int most_steps(const Models& models, const State& s);

}  // namespace puffin::coupling
