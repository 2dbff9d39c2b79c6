#include "dem/normal_force.hpp"

#include <algorithm>
#include <cmath>

#include "dem/friction.hpp"

namespace puffin::dem {
namespace {

constexpr double knee_capacity = 8.0;  // K = 8 m* (v/D)^2 takes the energy m* v^2/2 within s = 1/2 (0.068 K D^2)

/// The spring of a bond in tension: breaks at F0.
void stretch_bond(double overlap, const Touch& touch, NormalForce& n) {
  n.spring = touch.pair.pull_stiffness * overlap;
  n.tangent = touch.pair.pull_stiffness;
  n.eta = touch.eta_pull;
  n.broken = -n.spring >= touch.pair.pull_off;
}

}  // namespace

NormalForce linear_force(double overlap, double closing, double allowed, const SurfaceLaw& law, Touch& touch) {
  Contact& c = touch.memory;
  const bool bonded = c.phase == ContactPhase::bonded;
  NormalForce n;
  n.eta = touch.eta, n.tangent = c.stiffness;
  n.lean = bonded ? touch.pair.pull_off : 0.0;
  if (overlap <= 0.0) {
    if (bonded) stretch_bond(overlap, touch, n);
    return n;
  }
  n.spring = c.stiffness * overlap;
  if (overlap <= allowed) {
    c.knee_stiffness = 0.0;
    return n;
  }
  if (c.knee_stiffness == 0.0) {
    const double v = std::max(0.0, closing) / allowed;
    c.knee_stiffness = std::max(c.stiffness, knee_capacity * touch.pair.mass * v * v);
  }
  const double s = std::min(0.99, (overlap - allowed) / allowed), rest = 1.0 - s;
  n.spring += c.knee_stiffness * allowed * s * s / rest;
  n.tangent += c.knee_stiffness * (2.0 - s) * s / (rest * rest);
  n.eta = 2.0 * law.zeta * std::sqrt(touch.pair.mass * n.tangent);
  return n;
}

NormalForce elastic_force(double overlap, const Rules& rules, const SurfaceLaw& law, Touch& touch) {
  Contact& c = touch.memory;
  const PairLaw& pair = touch.pair;
  const bool bonded = c.phase == ContactPhase::bonded;
  NormalForce n;
  const bool jkr = law.attraction == Attraction::jkr;
  const double a = jkr ? pair.jkr.contact_radius(overlap) : hertz_radius(pair.radius, overlap);
  n.tangent = hertz_stiffness(law.moduli.normal, a);
  n.eta = 2.0 * law.zeta * std::sqrt(pair.mass * n.tangent);
  if (jkr) {
    n.spring = pair.jkr.force(a);
    n.least = std::min(n.spring, -pair.jkr.pull_off);
    n.lean = 2.0 * pair.jkr.pull_off;
  } else if (bonded && overlap <= 0.0) {
    stretch_bond(overlap, touch, n);
    n.lean = pair.pull_off;
  } else {
    n.spring = hertz_force(law.moduli.normal, a, std::max(0.0, overlap)) - pair.constant_pull;
    if (!bonded) n.least = -pair.constant_pull;
    n.lean = pair.constant_pull + (bonded ? pair.pull_off : 0.0);
  }
  // A contact in tension by a bond has no radius; it holds sideways as it holds along the normal.
  const double slip_stiffness = law.tangential_ratio * (bonded ? std::max(n.tangent, pair.pull_stiffness) : n.tangent);
  if (slip_stiffness > c.slip_stiffness && c.slip_stiffness > 0.0) c.slip *= c.slip_stiffness / slip_stiffness;
  c.slip_stiffness = slip_stiffness;
  touch.eta_slip = slip_dashpot(law, rules.rotation, pair.mass, slip_stiffness);
  return n;
}

}  // namespace puffin::dem
