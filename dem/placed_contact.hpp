#pragma once
// Contacts that a case places: surfaces that touch at the start, at rest, and hold against a pull.

#include <cmath>

#include "dem/meeting.hpp"

namespace puffin::dem {

/// Two surfaces that touch, at rest against each other, pulled apart by less than their pull-off force: placed so, for
/// nothing that has moved comes to rest to the last bit.
/// in: speed of parting [m/s], acceleration apart [m/s^2].
inline bool hangs_at_rest(double parting, double pulled, const PairLaw& pair) {
  return parting == 0.0 && pulled > 0.0 && pair.well > 0.0 && pulled * pair.mass < pair.pull_off;
}

/// Makes a contact that has just begun a bond that carries its load from the start: nothing swings. Takes back the fall
/// into the well, sqrt(2 U/m*).
inline void hang(const Meeting& m, double pulled, const PairLaw& pair, Contact& contact, Body& a, Body* b) {
  contact.phase = ContactPhase::bonded;
  contact.offset = m.overlap + pulled * pair.mass / pair.pull_stiffness;
  push(m.normal * std::sqrt(2.0 * pair.well * pair.mass), a, b);
}

}  // namespace puffin::dem
