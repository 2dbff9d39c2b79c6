#pragma once
// Two bodies of a cluster, or a body and a wall, at one place of contact: where, how fast, and how impulses act there.

#include <Eigen/Geometry>

#include "dem/cluster.hpp"

namespace puffin::dem {

/// Three numbers of a Body as a vector.
inline auto vec(double (&numbers)[3]) { return Eigen::Map<Eigen::Vector3d>(numbers); }
inline auto vec(const double (&numbers)[3]) { return Eigen::Map<const Eigen::Vector3d>(numbers); }

/// Positions of a touch.
struct Meeting {
  Eigen::Vector3d normal;           // towards a
  double overlap = 0.0;             // > 0 pressed [m]
  double arm_a = 0.0, arm_b = 0.0;  // from the centres to the place of contact [m]
};

inline Meeting meet(const Touch& touch, const PairConstants& pair, const Body& a, const Body* b) {
  Meeting m;
  if (b != nullptr) {
    const Eigen::Vector3d apart = vec(a.x) - vec(b->x);
    const double distance = apart.norm();
    m.normal = distance > 0.0 ? Eigen::Vector3d(apart / distance) : touch.memory.normal;
    m.overlap = pair.reach - distance;
    m.arm_a = pair.share * distance;  // the arms add up to the distance: angular momentum is kept exactly
    m.arm_b = distance - m.arm_a;
  } else {
    m.normal = touch.plane.normal;
    m.overlap = a.radius - m.normal.dot(vec(a.x) - touch.plane.point);
    m.arm_a = a.radius;  // of the true sphere, which hardly flattens; a wall keeps no angular momentum to account for
  }
  return m;
}

/// Velocity of a's surface relative to b's at the place of contact, of the half step, or at its predicted end.
inline Eigen::Vector3d surface_velocity(const Meeting& m, const Body& a, const Body* b, bool end) {
  Eigen::Vector3d v = vec(a.v), turn = m.arm_a * vec(a.w);
  if (end) v += vec(a.kick), turn += m.arm_a * vec(a.twist);
  if (b != nullptr) {
    v -= vec(b->v), turn += m.arm_b * vec(b->w);
    if (end) v -= vec(b->kick), turn += m.arm_b * vec(b->twist);
  }
  return v - turn.cross(m.normal);
}

/// Velocity of a's centre against b's, predicted for the end of the sub-step.
inline Eigen::Vector3d centre_velocity(const Body& a, const Body* b) {
  Eigen::Vector3d v = vec(a.v) + vec(a.kick);
  if (b != nullptr) v -= vec(b->v) + vec(b->kick);
  return v;
}

inline void push(const Eigen::Vector3d& impulse, Body& a, Body* b) {
  vec(a.v) += impulse * a.inverse_mass;
  if (b != nullptr) vec(b->v) -= impulse * b->inverse_mass;
}

/// An impulse at the place of contact, with its moment.
inline void push_at_contact(const Eigen::Vector3d& impulse, const Meeting& m, Body& a, Body* b) {
  push(impulse, a, b);
  const Eigen::Vector3d moment = m.normal.cross(impulse);
  vec(a.w) -= moment * (m.arm_a * a.inverse_inertia);
  if (b != nullptr) vec(b->w) -= moment * (m.arm_b * b->inverse_inertia);
}

}  // namespace puffin::dem
