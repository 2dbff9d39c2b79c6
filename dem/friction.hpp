#pragma once
// Sliding and rolling resistance of one touch.

#include "dem/meeting.hpp"

namespace puffin::dem {

/// Dashpot [kg/s] beside a tangential spring [N/m] of a pair of reduced mass `mass` [kg].
double slip_dashpot(const SurfaceLaw& law, bool rotation, double mass, double slip_stiffness);

/// Tangential force on a [N]: a spring with dashpot (Cundall & Strack 1979) up to the friction limit mu * `pressing`
/// (thesis eq. 2.4). Moves the spring by `step` [s] of the bodies' half-step velocities and shortens it at the limit,
/// so it never gives back more than it took. Sets the contact's `use` and `hold`.
Eigen::Vector3d slip_force(const Meeting& m, double step, double pressing, const SurfaceLaw& law, Touch& touch,
                           const Body& a, const Body* b);

/// Rolling moment on a [N m]: elastic, k_r = k_t R*^2, up to mu_r R* * `pressing` (EPSD2; Ai et al., Powder Technol.
/// 206, 269 (2011)), with the dashpot of the contact's damping ratio, at least 0.1 so that rolling comes to rest.
Eigen::Vector3d rolling_moment(const Meeting& m, double step, double pressing, const SurfaceLaw& law, Touch& touch,
                               const Body& a, const Body* b);

}  // namespace puffin::dem
