#pragma once
// The normal force of one live Hertz touch, law by law. The linear one: contact_law.inc.hpp.

#include "dem/contact_law.hpp"
#include "dem/meeting.hpp"

namespace puffin::dem {

/// Hertz, DMT or JKR (hertz.hpp, dmt.hpp, jkr.hpp); bonded by a well: Hertz, and the breaking spring in tension.
/// Without adhesion the force never pulls; with it, dashpot included, by no more than the pull-off force.
/// Sets the stiffness and dashpot of sliding, and keeps the tangential spring's force when the contact grows, its
/// stretch when the contact shrinks, so that a changing k_t makes no energy (Thornton et al. 2013, section 4).
/// Friction leans on F_n + F0 (DMT: the Hertz part of the force; bonds alike), on F_n + 2 F_c for JKR (Thornton & Yin,
/// Powder Technol. 65, 153 (1991)).
single::Normal<double> elastic_force(double overlap, bool rotation, const SurfaceLaw& law, const SpringLaw& springs,
                                     const PairLaw& pair, double eta_pull, single::Spring<double>& c);

}  // namespace puffin::dem
