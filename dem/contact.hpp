#pragma once
// The memory of one live contact.

#include <Eigen/Core>
#include <cstdint>

namespace puffin::dem {

enum class ContactPhase : std::uint8_t {
  free,     // an unused place in the list
  impact,   // closing in for the first time: pushes only
  leaving,  // moving apart again: ends at separation if it is fast enough, else becomes bonded
  bonded    // came to rest on the other: also pulls, up to the adhesion force F0 (0 without adhesion)
};

/// Plain data, trivially copyable. Normals point from b (or the wall) to a.
struct Contact {
  ContactPhase phase = ContactPhase::free;
  std::int32_t a = -1, b = -1;  // places of the carriers; b = -1: a wall
  std::int32_t triangle = -1;
  std::int32_t next_a = -1, next_b = -1;  // next contact of a, of b; -1: the last
  double stiffness = 0.0;                 // k, chosen at first touch [N/m]
  double knee_stiffness = 0.0;            // additional stiffness beyond the allowed overlap [N/m]; 0: not reached
  double slip_stiffness = 0.0;            // k_t at the last evaluation [N/m]
  double offset = 0.0;  // overlap without force, of carriers that overlapped before they closed in [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d slip = Eigen::Vector3d::Zero();   // tangential spring [m]
  Eigen::Vector3d roll = Eigen::Vector3d::Zero();   // rolling spring [rad]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // on a, at the end of the last step [N]
  double normal_force = 0.0;                        // of it, > 0 pushes [N]
  double use = 0.0;         // part of what the contact can hold that is used, the largest of pull and friction
  double hold = 0.0;        // the weakest of the forces that would move it: pull-off, sliding [N]
  double time_start = 0.0;  // [s]
  double normal_speed = 0.0, tangential_speed = 0.0;  // at first touch, before adhesion pulls [m/s]
  double max_force = 0.0;                             // [N]
  double max_overlap = 0.0;                           // [m]
};

}  // namespace puffin::dem
