// Touches that go on as they are: live contacts, and candidates that are still apart.

#include "dem/contact_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/contact_law.hpp"
#include "dem/contact_pack.hpp"
#include "dem/friction.hpp"
#include "dem/meeting.hpp"
#include "dem/normal_force.hpp"
#include "dem/placed_contact.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double bend_way = 0.05;  // of the overlap over which adhesion bends the curve, in one sub-step

single::Spring<double> load(const Springs& s, int l, const PairConstants& pair) {
  single::Spring<double> c{};
  c.phase = s.phase[l], c.inverse_mass = pair.inverse_mass, c.knee = pair.knee;
  c.pull_off = pair.pull_off, c.pull_stiffness = pair.pull_stiffness, c.well = pair.well;
  c.eta_pull = pair.eta_pull, c.pull_step = pair.pull_step;
  c.stiffness = s.stiffness[l], c.eta = s.eta[l], c.push_step = s.push_step[l];
  c.slip_stiffness = s.slip_stiffness[l], c.eta_slip = s.eta_slip[l], c.knee_stiffness = s.knee_stiffness[l];
  for (int d = 0; d < 3; ++d) c.slip[d] = s.slip[d][l];
  c.spring = s.spring[l], c.dashpot = s.dashpot[l];
  c.max_force = s.max_force[l], c.max_overlap = s.max_overlap[l];
  return c;
}

void store(const single::Spring<double>& c, Springs& s, int l) {
  s.phase[l] = c.phase, s.knee_stiffness[l] = c.knee_stiffness;
  s.slip_stiffness[l] = c.slip_stiffness, s.eta_slip[l] = c.eta_slip;
  for (int d = 0; d < 3; ++d) s.slip[d][l] = c.slip[d];
  s.spring[l] = c.spring, s.dashpot[l] = c.dashpot;
  s.max_force[l] = c.max_force, s.max_overlap[l] = c.max_overlap;
}

single::Encounter<double> encounter(const Meeting& m, double offset, const Body& a, const Body* b) {
  single::Encounter<double> e;
  const Vector3d centre = centre_velocity(a, b);
  const Vector3d half = surface_velocity(m, a, b, false), end = surface_velocity(m, a, b, true);
  for (int d = 0; d < 3; ++d) e.normal[d] = m.normal[d], e.half[d] = half[d], e.end[d] = end[d];
  e.overlap = m.overlap - offset;
  e.closing = -m.normal.dot(centre);
  return e;
}

/// As single::next_step, of a Hertz contact.
double hertz_step(const SpringLaw& springs, const PairLaw& pair, const single::Normal<double>& n,
                  const single::Encounter<double>& e, const single::Spring<double>& c) {
  const double coarse = single::quiet_factor(springs, e.overlap, e.closing, n.spring, c);
  double step = (c.phase == lane::bonded ? coarse : 1.0) * n.step;
  const double energy = pair.mass * e.closing * e.closing;
  if (e.overlap < 2.0 * pair.bend && energy < 100.0 * pair.largest_pull() * pair.bend)
    step = std::min(step, bend_way * pair.bend / std::max(std::abs(e.closing), 1e-300));
  if (c.phase != lane::bonded) step = single::stop_at_separation(e.overlap + pair.jkr.stretch, e.closing, c, step);
  return single::mind_the_bond(e.overlap, e.closing, coarse * std::min(n.step, c.pull_step), c, step);
}

/// How far a candidate is.
struct Look {
  bool event = false;
  double step = never;                      // the largest next sub-step that it allows [s]
  double idle_until = 0.0, latest = never;  // it need not be looked at before, but must be by then [s]
};

/// A candidate that is apart: how long may the next sub-step be, so as not to run far into the contact?
Look look_at(std::size_t index, const Substep& substep, const Rules& rules, const Cluster& cluster) {
  const Touch& touch = cluster.touches[index];
  const Body& a = cluster.bodies[touch.a];
  const Body* b = touch.b >= 0 ? &cluster.bodies[touch.b] : nullptr;
  const Meeting m = meet(touch, cluster.constants[touch.pair], a, b);
  const PairLaw& pair = cluster.pairs[touch.pair].law;
  Look look;
  if (m.overlap >= -placed_gap) {
    const double parting = m.normal.dot(centre_velocity(a, b));
    Vector3d apart = cluster.records[touch.a].acceleration;
    if (b != nullptr) apart -= cluster.records[touch.b].acceleration;
    const double pulled = parting == 0.0 ? m.normal.dot(apart) : 0.0;
    const bool meet = surfaces_meet(m.overlap, a.radius);
    const bool pressed = parting < 0.0 || (parting == 0.0 && pulled < 0.0);
    look.event = (meet && pressed) || hangs_at_rest(parting, pulled, pair);
    if (look.event || meet) return look;
  }
  // Even two of the fastest of the cluster need this long: if that is many sub-steps, leave it alone for half of it.
  // Where all are at rest nothing is said by that: they may fall.
  const double soonest = cluster.fastest > 0.0 ? -m.overlap / (2.0 * cluster.fastest) : 0.0;
  if (soonest > 4.0 * substep.horizon) {
    look.idle_until = substep.time + 0.5 * soonest;
    look.latest = substep.time + soonest;
    return look;
  }
  const Vector3d approach = centre_velocity(a, b);
  const double closing = -m.normal.dot(approach);
  if (closing <= 0.0 || -m.overlap > closing * substep.horizon) return look;
  const double allowed = b == nullptr
                             ? pair.allowed
                             : glancing_overlap(pair, cluster.constants[touch.pair].reach, closing, approach.norm());
  const double k = first_stiffness(rules.law(b == nullptr), pair, closing, cluster.records[touch.a].load_size, allowed);
  look.step = -m.overlap / closing + 0.5 * allowed_step(rules.springs(b == nullptr), pair, k);
  return look;
}

}  // namespace

Followed follow(std::size_t index, double h, double share, const Rules& rules, Cluster& cluster) {
  Touch& touch = cluster.touches[index];
  Springs& s = cluster.block(index);
  const int l = static_cast<int>(index) % Springs::lanes;
  const bool wall = touch.b < 0;
  const Body& a = cluster.bodies[touch.a];
  const Body* b = wall ? nullptr : &cluster.bodies[touch.b];
  const SurfaceLaw& law = rules.law(wall);
  const SpringLaw& springs = rules.springs(wall);
  const PairNumbers& pair = cluster.pairs[touch.pair];

  const Meeting m = meet(touch, cluster.constants[touch.pair], a, b);
  single::Encounter<double> e = encounter(m, s.offset[l], a, b);
  single::Spring<double> c = load(s, l, cluster.constants[touch.pair]);
  single::turn_phase(e.overlap, e.closing, c);
  Followed result;
  const bool bonded = c.phase == lane::bonded;
  if (!bonded && e.overlap <= -pair.law.jkr.stretch && e.closing < 0.0)
    return {true, never, 0.0, 0.0, Vector3d::Zero()};
  const single::Normal<double> n = law.hertz ? elastic_force(e.overlap, rules.rotation, law, springs, pair.law,
                                                             cluster.constants[touch.pair].eta_pull, c)
                                             : single::linear_normal(springs, e.overlap, e.closing, c);
  if (bonded && e.overlap <= 0.0 && -n.spring >= c.pull_off) return {true, never, 0.0, 0.0, Vector3d::Zero()};
  const single::Answer<double> answer = single::contact_force(springs, h, share, n, e, c);
  if (law.rolling > 0.0 && rules.rotation)
    roll(m.normal, share, answer.pressing, c.slip_stiffness, pair.law.radius, law, a, b, touch);
  store(c, s, l);
  s.limit[l] = answer.limit;
  for (int d = 0; d < 3; ++d) {
    cluster.pulls[index].force[d] = answer.force[d];
    if (rules.rotation) cluster.pulls[index].moment[d] = (m.arm_a + m.arm_b) * answer.moment[d];
    result.tangential[d] = answer.tangential[d];
  }
  result.spring = c.spring, result.dashpot = c.dashpot;
  result.step = law.hertz ? hertz_step(springs, pair.law, n, e, c) : single::next_step(springs, n, e, c);
  return result;
}

Wish follow_block(std::size_t block, const Substep& substep, const Rules& rules, Cluster& cluster) {
  static PairContacts* const pair_contacts_here = pair_contacts();
  Springs& s = cluster.springs[block];
  const std::size_t first = block * Springs::lanes;
  const bool in_packs = !rules.carrier.hertz && !(rules.carrier.rolling > 0.0 && rules.rotation);
  std::uint32_t events = 0, single_ones = 0, candidates = 0, pairs = 0;
  for (int l = 0; l < Springs::lanes; ++l) {
    const std::uint32_t bit = 1u << l;
    if (s.phase[l] == lane::free) candidates |= bit;
    if (s.phase[l] > lane::free) (in_packs && s.b[l] >= 0 ? pairs : single_ones) |= bit;
  }
  Wish wish{never, (pairs | single_ones) != 0};
  if (pairs)
    wish.step = pair_contacts_here(rules.carrier_springs, substep.h, cluster.bodies.data(), cluster.constants.data(), s,
                                   cluster.pulls.data() + first, events);
  for (int l = 0; single_ones >> l; ++l) {
    if (!(single_ones >> l & 1)) continue;
    const Followed followed = follow(first + l, substep.h, substep.h, rules, cluster);
    if (followed.event) events |= 1u << l;
    wish.step = std::min(wish.step, followed.step);
  }
  if (candidates && substep.time < s.idle_until) {
    wish.step = std::min(wish.step, s.latest - substep.time);
  } else if (candidates) {
    s.idle_until = s.latest = never;
    for (int l = 0; candidates >> l; ++l) {
      if (!(candidates >> l & 1)) continue;
      const Look look = look_at(first + l, substep, rules, cluster);
      if (look.event) events |= 1u << l;
      wish.step = std::min(wish.step, look.step);
      s.idle_until = std::min(s.idle_until, look.idle_until);
      s.latest = std::min(s.latest, look.latest);
    }
  }
  cluster.events[block] = static_cast<std::uint8_t>(events);
  return wish;
}

}  // namespace puffin::dem
