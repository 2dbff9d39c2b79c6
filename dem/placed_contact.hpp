#pragma once
// Contacts that a case places: surfaces that touch at the start, at rest, and hold against a pull.

#include <cmath>

#include "dem/meeting.hpp"

namespace puffin::dem {

constexpr double placed_gap = 4e-10;  // [m] adhesion is at its full force so near, and no case places carriers better

/// Two surfaces no farther apart than placed_gap, at rest against each other, pulled apart by nothing or by less than
/// their pull-off force: placed so, for nothing that has moved comes to rest to the last bit.
/// in: speed of parting [m/s], acceleration apart [m/s^2].
inline bool hangs_at_rest(double parting, double pulled, const PairLaw& pair) {
  return parting == 0.0 && pulled >= 0.0 && pulled * pair.mass < pair.largest_pull();
}

/// Overlap [m] at which a contact pulls back with `force` [N], 0 < force < pull-off. A bond: its stretched spring. DMT:
/// Hertz under F0 - force. JKR: the stable branch of -F/F_c = 4 (s^3 - s^6), delta/delta_c = 6^(1/3) (2 s^4 - 4/3 s).
inline double hanging_overlap(double force, const SurfaceLaw& law, const PairLaw& pair) {
  if (law.attraction == Attraction::jkr) {
    const double s = std::cbrt(0.5 * (1.0 + std::sqrt(1.0 - force / pair.jkr.pull_off)));
    return pair.jkr.stretch * std::cbrt(6.0) * (2.0 * s * s * s * s - 4.0 / 3.0 * s);
  }
  if (law.attraction == Attraction::dmt)
    return hertz_overlap(law.moduli.normal, pair.radius, pair.constant_pull - force);
  return -force / pair.pull_stiffness;
}

/// Makes a contact that has just begun carry its load from the start: nothing swings. Of a bond, takes back the fall
/// into the well, sqrt(2 U/m*).
inline void hang(const Meeting& m, double pulled, const SurfaceLaw& law, const PairLaw& pair, Contact& contact, Body& a,
                 Body* b) {
  if (pair.well > 0.0) contact.phase = ContactPhase::bonded;
  contact.offset = m.overlap - hanging_overlap(pulled * pair.mass, law, pair);
  push(m.normal * std::sqrt(2.0 * pair.well * pair.mass), a, b);
}

}  // namespace puffin::dem
