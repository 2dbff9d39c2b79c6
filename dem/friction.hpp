#pragma once
// Resistance to sliding and rolling of one touch. Sliding itself: contact_law.inc.hpp.

#include "dem/meeting.hpp"

namespace puffin::dem {

/// Dashpot [kg/s] beside a tangential spring [N/m] of a pair of reduced mass `mass` [kg].
double slip_dashpot(const SurfaceLaw& law, bool rotation, double mass, double slip_stiffness);

/// Rolling moment on a [N m]: elastic, k_r = k_t R*^2, up to mu_r R* * `pressing` (EPSD2; Ai et al., Powder Technol.
/// 206, 269 (2011)), with the dashpot of the contact's damping ratio, at least 0.1 so that rolling comes to rest.
/// Moves the touch's rolling spring by `step` [s] of the half-step spins.
void roll(const Eigen::Vector3d& normal, double step, double pressing, double slip_stiffness, double pair_radius,
          const SurfaceLaw& law, const Body& a, const Body* b, Touch& touch);

}  // namespace puffin::dem
