#pragma once
// Contacts that a case places: surfaces that touch at the start, at rest, and hold against a pull.

#include <cmath>

#include "dem/meeting.hpp"

namespace puffin::dem {

/// Two surfaces that touch, at rest against each other, pulled apart by less than their pull-off force: placed so, for
/// nothing that has moved comes to rest to the last bit.
/// in: speed of parting [m/s], acceleration apart [m/s^2].
inline bool hangs_at_rest(double parting, double pulled, const Touch& touch) {
  return parting == 0.0 && pulled > 0.0 && touch.pair.well > 0.0 && pulled * touch.pair.mass < touch.pair.pull_off;
}

/// Makes a contact that has just begun a bond that carries its load from the start: nothing swings. Takes back the fall
/// into the well, sqrt(2 U/m*).
inline void hang(const Meeting& m, double pulled, Touch& touch, Body& a, Body* b) {
  Contact& c = touch.memory;
  c.phase = ContactPhase::bonded;
  c.offset = m.overlap + pulled * touch.pair.mass / touch.pair.pull_stiffness;
  push(m.normal * std::sqrt(2.0 * touch.pair.well * touch.pair.mass), a, b);
}

}  // namespace puffin::dem
