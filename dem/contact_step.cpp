// The contact law as a small state machine, free of the softened stiffness where adhesion is concerned.
//
// Compression: linear spring k and dashpot eta (thesis eq. 2.3). k belongs to the contact: just stiff enough for its
// own impact. What squeezes it further later meets a second spring beyond the allowed overlap D,
//   F2 = K D s^2/(1-s),  s = (overlap - D)/D,   K from the closing speed at overlap = D,
// which is a function of the overlap alone (no energy is made), starts smoothly, and bounds the overlap by 2 D.
//
// Adhesion acts over d0 = 0.4 nm: no sub-step can sample that well, and a constant attraction during a soft contact
// would store F0^2/(2k) instead of U. So the well is booked, not sampled:
//   first touch : v^2 -> v^2 + 2U/m*      (the pair falls into the well)
//   separation  : v^2 -> v^2 - 2U/m*      if the kinetic energy of separation exceeds U,
//                 else the contact is bonded;
//   bonded      : in tension a spring k_p = F0^2/(2U) = F0/(2 d0), which breaks at the pull-off force F0 having stored
//                 just U. So a slow pull ends at F0, a blow at U, whatever k is.
// A rebound that turns back before it separates is bonded too. Friction holds up to mu (F_spring + F0) when bonded, and
// mu F_spring in an impact; the linear spring's impulse equals the whole normal impulse (the dashpot's integral over a
// closed contact is zero), so sliding impacts follow e_t = 1 - mu (1+e) cot(theta) for every e.
//
// Hertz contacts (normal_force.hpp) go through the same states with their own spring. DMT and JKR on them need no
// booking: their force is followed, the JKR contact to a negative overlap.

#include "dem/contact_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/first_touch.hpp"
#include "dem/friction.hpp"
#include "dem/linear_contact.hpp"
#include "dem/meeting.hpp"
#include "dem/normal_force.hpp"
#include "dem/open_contacts.hpp"
#include "dem/placed_contact.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double touching = 1e-9;  // of the radius: a gap below this is rounding of the positions
constexpr double bend_way = 0.05;  // of the overlap over which adhesion bends the curve, in one sub-step

double knee(const Rules& rules, const Touch& touch) {
  const SurfaceLaw& law = touch.b >= 0 ? rules.carrier : rules.wall;
  return law.stiffness > 0.0 ? 5.0 * touch.pair.allowed : touch.pair.allowed;  // a given stiffness is left alone longer
}

/// Largest sub-step for an oscillation of stiffness k: a part of the contact time of an impact that ends at it.
double allowed_step(const Rules& rules, const SurfaceLaw& law, const Touch& touch, double k) {
  // the tangential spring with its smaller effective mass (2/7 m*) may be the faster one
  double fastest = std::max(1.0, rules.rotation ? 3.5 * law.tangential_ratio : law.tangential_ratio);
  if (law.hertz) fastest *= (1.0 + 2.0 * law.zeta) * (1.0 + 2.0 * law.zeta);  // its dashpot sets in as overlap^(1/4)
  return std::min(std::numbers::pi * std::sqrt(touch.pair.mass / (k * fastest)) / rules.integration.steps_per_contact,
                  touch.pair.longest_step);
}

/// Keeps the largest force and overlap. Near the turning point the overlap still to come, m* v^2/(2 F) from here (and
/// where it comes from, past the point), is known to second order; the dashpot is silent there.
void note_extremes(double overlap, double closing, double spring, double tangent, Touch& touch) {
  Contact& c = touch.memory;
  c.max_force = std::max(c.max_force, c.normal_force);
  c.max_overlap = std::max(c.max_overlap, overlap);
  if (!(spring > 0.0) || !(overlap > 0.0)) return;
  const double way = 0.5 * touch.pair.mass * closing * closing / spring;
  if (way > 0.02 * overlap) return;
  c.max_overlap = std::max(c.max_overlap, overlap + way);
  c.max_force = std::max(c.max_force, spring + tangent * way);
}

/// First touch: logs it, lets adhesion pull, chooses the stiffness.
void begin_contact(const Meeting& m, double h, double time, const Rules& rules, Cluster& cluster, Touch& touch, Body& a,
                   Body* b) {
  const SurfaceLaw& law = b != nullptr ? rules.carrier : rules.wall;
  const Vector3d velocity = centre_velocity(a, b, true);
  const double speed = std::max(0.0, -m.normal.dot(velocity));
  const double tangential = (velocity + speed * m.normal).norm();
  const double pulled = std::sqrt(speed * speed + 2.0 * touch.pair.well / touch.pair.mass);
  const double since = pulled > 0.0 ? std::min(h, std::max(0.0, m.overlap) / pulled) : 0.0;

  touch.memory = Contact{};
  Contact& c = touch.memory;
  c.phase = ContactPhase::impact;
  c.a = a.carrier, c.b = b != nullptr ? b->carrier : -1;
  c.triangle = b != nullptr ? -1 : touch.plane.triangle;
  c.normal = m.normal;
  c.time_start = time - since;
  // Overlap that no motion explains (placed so, or a wall that bends under it) is taken as the shape, without force.
  c.offset = std::max(0.0, m.overlap - 2.0 * h * pulled);
  c.normal_speed = speed, c.tangential_speed = tangential;
  double load = a.load_size;
  if (b != nullptr) load = std::max(load, b->load_size);
  c.stiffness = first_stiffness(law, touch.pair, pulled, load);
  set_dashpots(rules, touch);
  push(-m.normal * ((pulled - speed) * touch.pair.mass), a, b);

  ContactBegun begun;
  begun.a = a.id, begun.b = b != nullptr ? b->id : -1;
  begun.triangle = c.triangle;
  begun.point = b != nullptr ? Vector3d(a.x - m.arm_a * m.normal) : touch.plane.point;
  begun.normal = m.normal;
  begun.normal_speed = speed, begun.tangential_speed = tangential;
  begun.angle = std::atan2(tangential, speed);
  begun.time = c.time_start;
  cluster.begun.push_back(begun);
}

/// True if the contact ends now: it left its first impact with more than the energy of the well. Otherwise it is
/// bonded; DMT and JKR contacts have no well, they end. Gives back what the last half kick pushed too much, since the
/// contact carried forces only up to `since` ago.
bool separates(const Meeting& m, double h, double since, Touch& touch, Body& a, Body* b) {
  push_at_contact(m.normal * (-0.5 * since * touch.spring_force + (0.5 * h - since) * touch.dashpot_force) -
                      0.5 * since * touch.slip_force,
                  m, a, b);
  const double speed = m.normal.dot(centre_velocity(a, b, true));
  const double left = speed * speed - 2.0 * touch.pair.well / touch.pair.mass;
  if (speed <= 0.0 || left <= 0.0) return touch.pair.well == 0.0;
  push(m.normal * ((std::sqrt(left) - speed) * touch.pair.mass), a, b);
  return true;
}

/// The touch is not live: how long may the next sub-step be, so as not to run far into the contact?
double time_to_touch(const Meeting& m, double horizon, const Rules& rules, const Touch& touch, const Body& a,
                     const Body* b) {
  const double closing = -m.normal.dot(centre_velocity(a, b, true));
  if (closing <= 0.0 || -m.overlap > closing * horizon) return never;
  const SurfaceLaw& law = b != nullptr ? rules.carrier : rules.wall;
  const double k = first_stiffness(law, touch.pair, closing, a.load_size);
  return std::max(0.0, -m.overlap) / closing + 0.5 * allowed_step(rules, law, touch, k);
}

}  // namespace

void note_overlap(const Touch& touch, Cluster& cluster) {
  const double a = cluster.bodies[touch.a].radius;
  const double smaller = touch.b >= 0 ? std::min(a, cluster.bodies[touch.b].radius) : a;
  cluster.largest_overlap = std::max(cluster.largest_overlap, touch.memory.max_overlap / (2.0 * smaller));
}

void end_contact(double time, Cluster& cluster, Touch& touch) {
  const Body& a = cluster.bodies[touch.a];
  const Body* b = touch.b >= 0 ? &cluster.bodies[touch.b] : nullptr;
  const Contact& c = touch.memory;
  note_overlap(touch, cluster);
  ContactEnded ended;
  ended.time_start = c.time_start, ended.time_end = time;
  ended.a = a.id, ended.b = b != nullptr ? b->id : -1;
  ended.triangle = c.triangle;
  ended.normal_speed = c.normal_speed, ended.tangential_speed = c.tangential_speed;
  const double mass = b != nullptr ? 0.5 * (a.single_mass + b->single_mass) : a.single_mass;
  ended.energy = impact_energy(c, mass);
  ended.max_force = c.max_force, ended.max_overlap = c.max_overlap;
  cluster.ended.push_back(ended);
  touch.memory = Contact{};
  touch.spring_force = touch.dashpot_force = 0.0;
  touch.slip_force = Vector3d::Zero();
}

double evaluate(std::size_t index, double h, double time, double horizon, const Rules& rules, Cluster& cluster,
                bool& live) {
  Touch& touch = cluster.touches[index];
  Body& a = cluster.bodies[touch.a];
  Body* b = touch.b >= 0 ? &cluster.bodies[touch.b] : nullptr;
  Contact& c = touch.memory;
  if (c.phase == ContactPhase::free) {
    if (touch.lost) return never;
    if (time < touch.idle_until) return touch.latest - time;
  }
  Meeting m = meet(touch, a, b);
  const SurfaceLaw& law = b != nullptr ? rules.carrier : rules.wall;
  double share = h;  // the part of the last sub-step during which the present force acted

  if (c.phase == ContactPhase::free) {
    if (m.overlap < -touching * a.radius) {
      // Even two of the fastest of the cluster need this long: if that is many sub-steps, leave it alone for half of
      // it.
      const double soonest = -m.overlap / (2.0 * cluster.fastest);
      if (soonest > 4.0 * horizon) {
        touch.latest = time + soonest;
        touch.idle_until = time + 0.5 * soonest;
        return never;
      }
      return time_to_touch(m, horizon, rules, touch, a, b);
    }
    const double parting = m.normal.dot(centre_velocity(a, b, true));
    const double pulled = parting == 0.0 ? m.normal.dot(acceleration(a, b)) : 0.0;
    const bool hangs = hangs_at_rest(parting, pulled, touch);
    if (parting > 0.0 || (parting == 0.0 && pulled >= 0.0 && !hangs)) return never;
    if (b != nullptr && b->sleeper) b->disturbed = cluster.disturbed = true;
    begin_contact(m, h, time, rules, cluster, touch, a, b);
    if (hangs) hang(m, pulled, law, touch, a, b);
    share = time - c.time_start;
    if (b == nullptr && rules.on_wall == OnWall::stick) {
      a.stuck = a.fixed = true;
      a.inverse_mass = a.inverse_inertia = 0.0;
      a.v = a.w = a.kick = a.twist = Vector3d::Zero();
      end_contact(time, cluster, touch);
      return never;
    }
  }

  m.overlap -= c.offset;
  double closing = -m.normal.dot(centre_velocity(a, b, true));
  const double stretch = touch.pair.jkr.stretch;  // how far the surfaces may part before the contact is over
  if (c.phase == ContactPhase::impact && closing < 0.0) c.phase = ContactPhase::leaving;
  if (c.phase == ContactPhase::leaving && closing > 0.0 && m.overlap > 0.0)
    c.phase = touch.pair.pull_off > 0.0 ? ContactPhase::bonded : ContactPhase::impact;
  if (c.phase != ContactPhase::bonded && m.overlap <= -stretch && closing < 0.0) {
    const double since = std::min(h, (m.overlap + stretch) / closing);
    if (separates(m, h, since, touch, a, b)) {
      end_contact(time - since, cluster, touch);
      return never;
    }
    c.phase = ContactPhase::bonded;
    share = since;
    closing = -m.normal.dot(centre_velocity(a, b, true));
  }

  const bool bonded = c.phase == ContactPhase::bonded;
  const double allowed = knee(rules, touch);
  const NormalForce normal =
      law.hertz ? elastic_force(m.overlap, rules, law, touch) : linear_force(m.overlap, closing, allowed, law, touch);
  if (normal.broken) {
    end_contact(time, cluster, touch);
    return never;
  }
  const double spring = normal.spring, tangent = normal.tangent, eta = normal.eta;
  // The dashpot acts on the speed at the end of the sub-step. The predicted one carries the old force of this contact;
  // to put its new force there instead, dashpot included, is second order with a small constant (e right within 0.1 %).
  const double response = 0.5 * h / touch.pair.mass;
  const double dashpot =
      std::max(normal.least - spring, eta * (closing + response * (touch.spring_force + touch.dashpot_force - spring)) /
                                          (1.0 + response * eta));

  // Friction and rolling, held by what presses the surfaces together. The linear dashpot's integral over a contact is
  // zero; that of a Hertz contact, which never pulls, is not.
  const double pressing = std::max(0.0, (law.hertz ? spring + dashpot : spring) + normal.lean);
  const Vector3d tangential = slip_force(m, share, pressing, law, touch, a, b);
  const double pull = touch.pair.largest_pull();
  if (pull > 0.0 && (bonded || law.attraction != Attraction::well)) {
    c.use = std::max(c.use, std::max(0.0, -spring) / pull);
    c.hold = std::min(c.hold, pull);
  } else {
    c.hold = std::min(c.hold, spring);
  }
  const Vector3d force = m.normal * (spring + dashpot) + tangential;
  Vector3d torque_a = -m.arm_a * m.normal.cross(tangential), torque_b = -m.arm_b * m.normal.cross(tangential);
  if (law.rolling > 0.0 && rules.rotation) {
    const Vector3d moment = rolling_moment(m, share, pressing, law, touch, a, b);
    torque_a += moment;
    torque_b -= moment;
  }
  a.force += force;
  a.torque += torque_a;
  if (b != nullptr) b->force -= force, b->torque += torque_b;
  if (share < h)  // a contact younger than the sub-step: take back the excess of the half kick to come
    push_at_contact(
        m.normal * (0.5 * (share - h) * spring + (share - 0.5 * h) * dashpot) + 0.5 * (share - h) * tangential, m, a,
        b);

  touch.spring_force = spring, touch.dashpot_force = dashpot, touch.slip_force = tangential;
  c.normal = m.normal;
  c.force = force;
  c.normal_force = spring + dashpot;
  note_extremes(m.overlap, closing, spring, tangent, touch);
  live = true;

  // The next sub-step.
  // A quiet bond (little energy against the well, little of its strength in use) needs only stability: t_c/8.
  const double energy = touch.pair.mass * closing * closing;
  const bool quiet =
      bonded && energy < 0.1 * touch.pair.well && m.overlap < 0.5 * allowed && -spring < 0.5 * touch.pair.pull_off;
  const double coarse = quiet ? rules.integration.steps_per_contact / 8.0 : 1.0;
  double step = coarse * allowed_step(rules, law, touch, law.hertz ? std::max(tangent, c.stiffness) : tangent);
  if (m.overlap < 2.0 * touch.pair.bend && energy < 100.0 * pull * touch.pair.bend)
    step = std::min(step, bend_way * touch.pair.bend / std::max(std::abs(closing), 1e-300));
  if (closing > 0.0 && !law.hertz) {
    if (m.overlap > allowed)
      step = std::min(step, 0.1 * std::max(2.0 * allowed - m.overlap, 0.01 * allowed) / closing);
    else if (closing * step > allowed - m.overlap)
      step = std::min(step, (allowed - m.overlap + 0.05 * allowed) / closing);
  }
  // Leaving: end the sub-step where the overlap is gone, if that is not much less than a sub-step away.
  if (closing < 0.0 && m.overlap + stretch > 0.0) {
    const double fall = first_zero(m.overlap + stretch, closing, (spring + dashpot) / -touch.pair.mass, step);
    if (fall < step) step = std::max(fall, 0.25 * step);
  }
  // Near separation, slow enough to bond: the stiffer spring of tension is about to take over.
  if (touch.pair.well > 0.0 && m.overlap > 0.0 && (bonded || energy < 8.0 * touch.pair.well)) {
    const double pull_step = coarse * allowed_step(rules, law, touch, std::max(tangent, touch.pair.pull_stiffness));
    const double fall = m.overlap / std::max(std::abs(closing), 1e-300);
    if (closing < 0.0)
      step = std::min(step, std::max(pull_step, 0.5 * fall));
    else if (m.overlap < 2.0 * step * closing || closing == 0.0)
      step = std::min(step, pull_step);
  }
  return step;
}

}  // namespace puffin::dem
