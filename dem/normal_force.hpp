#pragma once
// The normal force of one live touch, law by law.

#include <limits>

#include "dem/meeting.hpp"

namespace puffin::dem {

/// What a law says at one overlap and closing speed.
struct NormalForce {
  double spring = 0.0;                                      // the elastic and adhesive part, > 0 pushes [N]
  double tangent = 0.0;                                     // its slope, for the sub-step [N/m]
  double eta = 0.0;                                         // dashpot [kg/s]
  double least = -std::numeric_limits<double>::infinity();  // of spring and dashpot together [N]
  double lean = 0.0;    // what adhesion adds to the force that friction and rolling lean on [N]
  bool broken = false;  // the bond broke: the contact is over
};

/// Linear spring with its knee, or the breaking spring of a bond (contact_step.cpp).
/// in: overlap [m], closing speed [m/s], knee: overlap at which the second spring begins [m]
NormalForce linear_force(double overlap, double closing, double knee, const SurfaceLaw& law, Touch& touch);

/// Hertz, DMT or JKR (hertz.hpp, dmt.hpp, jkr.hpp); bonded by a well: Hertz, and the breaking spring in tension.
/// Without adhesion the force never pulls; with it, dashpot included, by no more than the pull-off force.
/// Sets the stiffness and dashpot of sliding, and keeps the tangential spring's force when the contact grows, its
/// stretch when the contact shrinks, so that a changing k_t makes no energy (Thornton et al. 2013, section 4).
/// Friction leans on F_n + F0 (DMT: the Hertz part of the force; bonds alike), on F_n + 2 F_c for JKR (Thornton & Yin,
/// Powder Technol. 65, 153 (1991)).
NormalForce elastic_force(double overlap, const Rules& rules, const SurfaceLaw& law, Touch& touch);

}  // namespace puffin::dem
