#pragma once
// When a run is over.

#include "cases/build.hpp"

namespace puffin::tools {

inline bool at_stop_time(const cases::Simulation& s) { return s.state.time >= s.description.stop.time * (1.0 - 1e-12); }

/// At its stop time; or, with stop.when_empty, when every carrier has left and less than a millionth of the fines is
/// still airborne (without air, what is in it stays for ever: then the carriers alone count).
inline bool finished(const cases::Simulation& s) {
  const coupling::State& state = s.state;
  if (at_stop_time(s)) return true;
  if (!s.description.stop.when_empty || !s.description.carriers || state.carriers.carriers.size() > 0) return false;
  if (state.scalars.scalars() == 0 || !state.air) return true;
  const auto ledger = coupling::ledger(state.fines, state.scalars, state.budget, 0);
  return ledger.in_air < 1e-6 * ledger.loaded;
}

}  // namespace puffin::tools
