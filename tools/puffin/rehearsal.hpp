#pragma once
// A few seconds of the very run, to know what the whole will take on this machine.

#include <cstdint>
#include <string>

#include "cases/case.hpp"

namespace puffin::tools {

/// Cost of the parts of a run, measured [s]. Where no lattice computes the air a step of the carriers stands for an air
/// step, and without carriers the whole rehearsal.
struct Rehearsal {
  double set_up = 0.0;      // until the first step
  double air = 0.0;         // an air step: collision, streaming, walls
  double carriers = 0.0;    // an air step's share of exchange and motion, carriers awake
  double transport = 0.0;   // an air step's share of transport, fines everywhere in the air
  double rest = 0.0;        // an air step's share of everything else but outputs
  double outputs = 0.0;     // tables and frames of the whole run, by what those of the rehearsal took
  double finish = 0.0;      // after the last step: events.h5, wall maps
  double at_rest = 0.0;     // part of the air steps before the carriers fly: until a third of the largest flow
  double time = 0.0;        // simulated [s]
  double memory = 0.0;      // peak of this process [byte]
  std::int64_t active = 0;  // cells that are computed, those of an immersed boundary's band too
  double dx = 0.0;          // of the cells [m]; 0: there are none
  double dt = 0.0;          // the last step [s]
  std::int64_t steps = 0;   // that were rehearsed
  double units = 0.0;       // the same, but 1 where frozen air carries fines alone: all that was rehearsed
  int threads = 0;
  bool ended = false;        // the rehearsal came to the run's own end: `run_seconds` is what the run takes
  std::string failure;       // why it could not go on, as a run would say; empty: it could
  int failure_code = 0;      // with which the run would end
  double step_factor = 1.0;  // of the time step: below 1 after retreats
  double run_seconds = 0.0;
};

/// Builds the case and runs it for about `seconds` with all its outputs, in a folder of its own that is removed, to the
/// files of its end; fines
/// are put into the air everywhere, so that their transport is paid for from the start (which a real run does only
/// after the first release). Carriers of a fresh dose are awake. Throws as `build` and a run do.
Rehearsal rehearse(const cases::Case& c, double seconds);

/// What the run will take to stop.time [s], and between what: if everything leaves before (stop.when_empty) and the
/// machine is a quarter faster; with carriers and fines at work from the first step on and a quarter slower.
/// Checkpoints are not counted. Of a rehearsal that came to the run's end it is what that took, a quarter up and down.
struct Forecast {
  double seconds = 0.0, low = 0.0, high = 0.0;
};
/// `steps`: air steps, or `units`, to stop.time; the flow and with it the steps follow the case's ramp.
Forecast forecast(const cases::Case& c, const Rehearsal& rehearsal, double steps);

}  // namespace puffin::tools
