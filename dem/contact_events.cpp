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

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/contact_step.hpp"
#include "dem/meeting.hpp"
#include "dem/open_contacts.hpp"
#include "dem/placed_contact.hpp"

namespace puffin::dem {
namespace {

using Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();

/// A touch with everything that belongs to it.
struct Whole {
  Whole(std::size_t index, const Rules& rules, Cluster& cluster)
      : touch(cluster.touches[index]),
        s(cluster.block(index)),
        l(static_cast<int>(index) % Springs::lanes),
        a(cluster.bodies[touch.a]),
        b(touch.b >= 0 ? &cluster.bodies[touch.b] : nullptr),
        record_a(cluster.records[touch.a]),
        record_b(touch.b >= 0 ? &cluster.records[touch.b] : nullptr),
        law(rules.law(touch.b < 0)),
        pair(cluster.pairs[touch.pair].law),
        constants(cluster.constants[touch.pair]),
        pull(cluster.pulls[index]) {}
  Meeting meeting() const { return meet(touch, constants, a, b); }

  Touch& touch;
  Springs& s;
  const int l;
  Body& a;
  Body* const b;
  BodyRecord& record_a;
  BodyRecord* const record_b;
  const SurfaceLaw& law;
  const PairLaw& pair;
  const PairConstants& constants;
  const Pull& pull;
};

/// First touch: logs it, lets adhesion pull, chooses the stiffness.
void begin_contact(const Meeting& m, std::size_t index, const Substep& substep, const Rules& rules, Cluster& cluster) {
  const Whole w(index, rules, cluster);
  const Vector3d velocity = centre_velocity(w.a, w.b);
  const double speed = std::max(0.0, -m.normal.dot(velocity));
  const double tangential = (velocity + speed * m.normal).norm();
  const double pulled = std::sqrt(speed * speed + 2.0 * w.pair.well / w.pair.mass);
  const double since = pulled > 0.0 ? std::min(substep.h, std::max(0.0, m.overlap) / pulled) : 0.0;

  Contact c;
  c.phase = ContactPhase::impact;
  c.a = w.record_a.carrier, c.b = w.b != nullptr ? w.record_b->carrier : -1;
  c.triangle = w.b != nullptr ? -1 : w.touch.plane.triangle;
  c.normal = m.normal;
  c.time_start = substep.time - since;
  // Overlap that no motion explains (placed so, or a wall that bends under it) is taken as the shape, without force.
  c.offset = std::max(0.0, m.overlap - 2.0 * substep.h * pulled);
  c.normal_speed = speed, c.tangential_speed = tangential;
  double load = w.record_a.load_size;
  if (w.b != nullptr) load = std::max(load, w.record_b->load_size);
  const double allowed =
      w.b == nullptr ? w.pair.allowed : glancing_overlap(w.pair, w.constants.reach, speed, velocity.norm());
  c.stiffness = first_stiffness(w.law, w.pair, pulled, load, allowed);
  push(-m.normal * ((pulled - speed) * w.pair.mass), w.a, w.b);

  // Placed at rest against each other: a bond that carries its load from the start.
  const double parting = m.normal.dot(velocity);
  Vector3d apart = w.record_a.acceleration;
  if (w.b != nullptr) apart -= w.record_b->acceleration;
  const double pull = parting == 0.0 ? m.normal.dot(apart) : 0.0;
  if (hangs_at_rest(parting, pull, w.pair)) hang(m, pull, w.law, w.pair, c, w.a, w.b);
  const WallPlane plane = w.touch.plane;
  restore_contact(static_cast<std::int32_t>(index), c, rules, cluster);
  w.touch.plane = plane;

  ContactBegun begun;
  begun.a = w.record_a.id, begun.b = w.b != nullptr ? w.record_b->id : -1;
  begun.triangle = c.triangle;
  begun.point = w.b != nullptr ? Vector3d(vec(w.a.x) - m.arm_a * m.normal) : plane.point;
  begun.normal = m.normal;
  begun.normal_speed = speed, begun.tangential_speed = tangential;
  begun.angle = std::atan2(tangential, speed);
  begun.time = c.time_start;
  cluster.begun.push_back(begun);
}

/// True if the contact ends now: it left its first impact with more than the energy of the well. Otherwise it is
/// bonded; DMT and JKR contacts have no well, they end. Gives back what the last half kick pushed too much, since the
/// contact carried forces only up to `since` ago.
bool separates(const Meeting& m, double h, double since, const Whole& w) {
  const double spring = w.s.spring[w.l], dashpot = w.s.dashpot[w.l];
  Vector3d slip = vec(w.pull.force);  // the last force, but for its normal part
  slip -= m.normal * m.normal.dot(slip);
  push_at_contact(m.normal * (-0.5 * since * spring + (0.5 * h - since) * dashpot) - 0.5 * since * slip, m, w.a, w.b);
  const double speed = m.normal.dot(centre_velocity(w.a, w.b));
  const double left = speed * speed - 2.0 * w.pair.well / w.pair.mass;
  if (speed <= 0.0 || left <= 0.0) return w.pair.well == 0.0;
  push(m.normal * ((std::sqrt(left) - speed) * w.pair.mass), w.a, w.b);
  return true;
}

}  // namespace

void note_overlap(std::size_t index, Cluster& cluster) {
  const Touch& touch = cluster.touches[index];
  const double a = cluster.bodies[touch.a].radius;
  const double smaller = touch.b >= 0 ? std::min(a, cluster.bodies[touch.b].radius) : a;
  const double overlap = cluster.block(index).max_overlap[index % Springs::lanes];
  cluster.largest_overlap = std::max(cluster.largest_overlap, overlap / (2.0 * smaller));
}

void end_contact(double time, std::size_t index, Cluster& cluster) {
  Touch& touch = cluster.touches[index];
  const BodyRecord& a = cluster.records[touch.a];
  const BodyRecord* b = touch.b >= 0 ? &cluster.records[touch.b] : nullptr;
  Springs& s = cluster.block(index);
  const int l = static_cast<int>(index) % Springs::lanes;
  const Contact& c = touch.memory;
  note_overlap(index, cluster);
  ContactEnded ended;
  ended.time_start = c.time_start, ended.time_end = time;
  ended.a = a.id, ended.b = b != nullptr ? b->id : -1;
  ended.triangle = c.triangle;
  ended.normal_speed = c.normal_speed, ended.tangential_speed = c.tangential_speed;
  const double mass = b != nullptr ? 0.5 * (a.single_mass + b->single_mass) : a.single_mass;
  ended.energy = impact_energy(c, mass);
  ended.max_force = s.max_force[l], ended.max_overlap = s.max_overlap[l];
  cluster.ended.push_back(ended);
  touch.memory = Contact{};
  touch.rolling_moment = Vector3d::Zero();
  touch.rolling_use = 0.0;
  s.phase[l] = lane::free;
  cluster.alive[index] = 0;
  s.idle_until = 0.0;
  Pull& pull = cluster.pulls[index];
  for (int d = 0; d < 3; ++d) pull.force[d] = pull.moment[d] = 0.0;
}

Wish meet_event(std::size_t index, const Substep& substep, const Rules& rules, Cluster& cluster) {
  const Whole w(index, rules, cluster);
  const Wish over{never, false};
  const double h = substep.h;
  double share = h;  // the part of the last sub-step during which the present force acted
  Meeting m = w.meeting();
  if (w.s.phase[w.l] == lane::free) {
    // A push before it may have turned the pair: then it does not touch, and is looked at again.
    const double parting = m.normal.dot(centre_velocity(w.a, w.b));
    if (parting > 0.0) return over;
    if (w.b != nullptr && w.record_b->sleeper) w.record_b->disturbed = cluster.disturbed = true;
    begin_contact(m, index, substep, rules, cluster);
    share = substep.time - w.touch.memory.time_start;
    if (w.b == nullptr && rules.on_wall == OnWall::stick) {
      w.record_a.stuck = w.record_a.fixed = true;
      w.a.inverse_mass = w.a.inverse_inertia = 0.0;
      vec(w.a.v) = vec(w.a.w) = vec(w.a.kick) = vec(w.a.twist) = Vector3d::Zero();
      // A weight that stayed would press it into the wall again, in no time, for ever.
      w.record_a.acceleration = w.record_a.turning = Vector3d::Zero();
      end_contact(substep.time, index, cluster);
      return over;
    }
  } else {
    const double stretch = w.pair.jkr.stretch;  // how far the surfaces may part before the contact is over
    const double overlap = m.overlap - w.s.offset[w.l];
    const double closing = -m.normal.dot(centre_velocity(w.a, w.b));
    if (w.s.phase[w.l] != lane::bonded && overlap <= -stretch && closing < 0.0) {
      const double since = std::min(h, (overlap + stretch) / closing);
      if (separates(m, h, since, w)) {
        end_contact(substep.time - since, index, cluster);
        return over;
      }
      w.s.phase[w.l] = lane::bonded;
      share = since;
    }
  }
  const Followed followed = follow(index, h, share, rules, cluster);
  if (followed.event) {  // the bond broke
    end_contact(substep.time, index, cluster);
    return over;
  }
  if (share < h)  // a contact younger than the sub-step: take back the excess of the half kick to come
    push_at_contact(m.normal * (0.5 * (share - h) * followed.spring + (share - 0.5 * h) * followed.dashpot) +
                        0.5 * (share - h) * followed.tangential,
                    m, w.a, w.b);
  return {followed.step, true};
}

}  // namespace puffin::dem
