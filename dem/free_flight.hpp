#pragma once
// A carrier that touches nothing, in closed form.

#include <Eigen/Core>
#include <cmath>

#include "dem/loads.hpp"

namespace puffin::dem {

/// What a time in free flight does to a carrier.
struct Flight {
  Eigen::Vector3d position, velocity, spin;
  Eigen::Vector3d drag_impulse;  // integral of drag (u - v) dt [N s]
};

/// Exact solution of m dv/dt = beta (u - v) + F over the time t, for constant u, F:
///   v(t) = v + (v_inf - v) (1 - exp(-t/tau)),  v_inf = u + F/beta,  tau = m/beta,
///   x(t) = x + v t + (v_inf - v) (t - tau (1 - exp(-t/tau))),
/// and its limit for beta t/m -> 0, where the bracket is summed as a series to keep its digits.
/// in : velocity [m/s], mass [kg], inertia [kg m^2], total force F apart from drag (gravity included) [N]
inline Flight free_flight(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin,
                          double mass, double inertia, const Load& load, const Eigen::Vector3d& force, double t) {
  const double s = load.drag * t / mass;  // t/tau
  // part1 = (1 - e^-s)/s, part2 = (s - 1 + e^-s)/s^2, the means of the response over the step
  double part1, part2;
  if (s < 1e-2) {
    part1 = 1.0 - s * (1.0 / 2 - s * (1.0 / 6 - s * (1.0 / 24 - s * (1.0 / 120 - s / 720))));
    part2 = 1.0 / 2 - s * (1.0 / 6 - s * (1.0 / 24 - s * (1.0 / 120 - s * (1.0 / 720 - s / 5040))));
  } else {
    part1 = -std::expm1(-s) / s;
    part2 = (1.0 - part1) / s;
  }
  const Eigen::Vector3d start = (load.drag * (load.air_velocity - velocity) + force) / mass;  // dv/dt at the start
  Flight end;
  end.velocity = velocity + start * (part1 * t);
  end.position = position + velocity * t + start * (part2 * t * t);
  end.spin = spin + load.torque * (t / inertia);
  // integral of beta (u - v) = beta (u t - (x(t) - x))
  end.drag_impulse = load.drag * ((load.air_velocity - velocity) * t - start * (part2 * t * t));
  return end;
}

}  // namespace puffin::dem
