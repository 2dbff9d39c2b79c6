#pragma once
// What the sub-steps read and change of the touches of a cluster, eight in a block, so that they are computed together
// (contact_law.inc.hpp). No Eigen here: this is read by code compiled for several instruction sets.

#include <cstdint>

namespace puffin::dem {

/// State of a lane: a touch that is no more, a candidate, or the phase of a live contact (ContactPhase). As numbers,
/// for lanes are compared and chosen as such.
namespace lane {
constexpr double lost = -1.0, free = 0.0, impact = 1.0, leaving = 2.0, bonded = 3.0;
}

/// What follows from the sizes and materials of a pair. Carriers of one size share one.
struct PairConstants {
  double reach, share;         // R_a + R_b [m]; R_a/(R_a + R_b)
  double inverse_mass;         // 1/m* [1/kg]
  double knee;                 // overlap where the second spring begins [m]
  double pull_off, well;       // F0 [N], U [J]
  double pull_stiffness;       // k_p [N/m]
  double eta_pull, pull_step;  // dashpot and sub-step in tension [kg/s], [s]
};

/// What a live contact does to its bodies; zero for all others. One cache line.
struct alignas(64) Pull {
  double force[3];   // on a [N]; b gets the opposite
  double moment[3];  // (x_a - x_b) x force [N m]; -share of it turns a, the rest b
  double share;      // as in PairConstants
};

/// Eight touches. All but a, b, pair and phase have a meaning for live contacts alone.
struct alignas(64) Springs {
  static constexpr int lanes = 8;
  using Row = double[lanes];

  std::int32_t a[lanes], b[lanes];  // bodies; b = -1: a wall
  std::int32_t pair[lanes];         // of the constants
  std::int32_t one_pair;            // all lanes have the constants of lane 0
  alignas(64) Row phase;            // of `lane`
  Row stiffness, offset, eta,
      push_step;                 // k [N/m]; overlap without force [m]; dashpot [kg/s]; sub-step in compression [s]
  Row slip_stiffness, eta_slip;  // k_t [N/m], its dashpot [kg/s]
  Row knee_stiffness;            // [N/m]; 0: not reached
  Row slip[3];                   // tangential spring [m]
  Row spring, dashpot;           // normal force, > 0 pushes, at the last evaluation [N]
  Row limit;                     // of friction [N]
  Row max_force, max_overlap;    // [N], [m]
  double idle_until, latest;     // candidates need not be looked at before, but must be by then [s]
};

/// What all contacts of one kind share in a sub-step.
struct SpringLaw {
  double stick, slip, limit, slip_speed, limit_speed;  // friction (surface_law.hpp)
  double zeta;
  double step_factor;   // sub-step = step_factor sqrt(m*/k)
  double quiet_factor;  // longer sub-steps of quiet bonds
  bool rotation, hertz;
};

}  // namespace puffin::dem
