#pragma once
// The first moments of the very case, timed: what its steps cost on this machine now.

#include <optional>

#include "cases/case.hpp"

namespace puffin::tools {

struct Rehearsal {
  double set_up = 0.0;               // [s]
  double seconds_a_step = 0.0;       // air, walls and openings; of one air step
  double seconds_an_exchange = 0.0;  // interpolation and reaction, with every carrier awake
  double carriers_a_second = 0.0;    // wall-clock of the carriers a simulated second, awake
  double steps_an_exchange = 1.0;
  double memory = 0.0;  // [byte] of this process at its largest
  int threads = 0;
};

/// Builds the case and advances it for about `seconds` of wall-clock, the first quarter untimed; writes nothing.
/// Throws as cases::build.
Rehearsal rehearse(const cases::Case& c, double seconds);

/// Wall-clock of a whole run [s].
struct RunTime {
  double expected = 0.0, low = 0.0, high = 0.0;
};

/// `steps`: air steps until stop.time. What a rehearsal cannot see is taken from measured runs of L-Base (see the
/// .cpp).
RunTime run_time(const cases::Case& c, double steps, const Rehearsal& r);

}  // namespace puffin::tools
