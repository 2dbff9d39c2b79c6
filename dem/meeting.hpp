#pragma once
// Two bodies of a cluster, or a body and a wall, at one place of contact: where, how fast, and how impulses act there.

#include <Eigen/Geometry>

#include "dem/cluster.hpp"

namespace puffin::dem {

/// Positions and speeds of a touch.
struct Meeting {
  Eigen::Vector3d normal;           // towards a
  double overlap = 0.0;             // > 0 pressed [m]
  double arm_a = 0.0, arm_b = 0.0;  // from the centres to the place of contact [m]
};

inline Meeting meet(const Touch& touch, const Body& a, const Body* b) {
  Meeting m;
  if (b != nullptr) {
    const Eigen::Vector3d apart = a.x - b->x;
    const double distance = apart.norm();
    m.normal = distance > 0.0 ? Eigen::Vector3d(apart / distance) : touch.memory.normal;
    m.overlap = touch.reach - distance;
    m.arm_a = distance * a.radius / touch.reach;  // the arms add up to the distance: angular momentum is kept exactly
    m.arm_b = distance - m.arm_a;
  } else {
    m.normal = touch.plane.normal;
    m.arm_a = m.normal.dot(a.x - touch.plane.point);
    m.overlap = a.radius - m.arm_a;
  }
  return m;
}

/// Velocity of a's surface relative to b's at the place of contact, of the half step, or at its predicted end.
inline Eigen::Vector3d surface_velocity(const Meeting& m, const Body& a, const Body* b, bool end) {
  Eigen::Vector3d v = end ? Eigen::Vector3d(a.v + a.kick) : a.v;
  Eigen::Vector3d turn = m.arm_a * (end ? Eigen::Vector3d(a.w + a.twist) : a.w);
  if (b != nullptr) {
    v -= end ? Eigen::Vector3d(b->v + b->kick) : b->v;
    turn += m.arm_b * (end ? Eigen::Vector3d(b->w + b->twist) : b->w);
  }
  return v - turn.cross(m.normal);
}

inline Eigen::Vector3d centre_velocity(const Body& a, const Body* b, bool end) {
  Eigen::Vector3d v = end ? Eigen::Vector3d(a.v + a.kick) : a.v;
  if (b != nullptr) v -= end ? Eigen::Vector3d(b->v + b->kick) : b->v;
  return v;
}

inline Eigen::Vector3d acceleration(const Body& a, const Body* b) {
  return b != nullptr ? Eigen::Vector3d(a.acceleration - b->acceleration) : a.acceleration;
}

inline void push(const Eigen::Vector3d& impulse, Body& a, Body* b) {
  a.v += impulse * a.inverse_mass;
  if (b != nullptr) b->v -= impulse * b->inverse_mass;
}

/// An impulse at the place of contact, with its moment.
inline void push_at_contact(const Eigen::Vector3d& impulse, const Meeting& m, Body& a, Body* b) {
  push(impulse, a, b);
  const Eigen::Vector3d moment = m.normal.cross(impulse);
  a.w -= moment * (m.arm_a * a.inverse_inertia);
  if (b != nullptr) b->w -= moment * (m.arm_b * b->inverse_inertia);
}

}  // namespace puffin::dem
