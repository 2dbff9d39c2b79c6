#pragma once
// The bodies of a cluster: what every contact asks of them, apart from what is kept for the air step alone. No Eigen
// here: this is read by code compiled for several instruction sets.

namespace puffin::dem {

/// What contacts read and give, three cache lines. v and w are those of the half step; v + kick and w + twist predict
/// the end of the sub-step.
struct alignas(64) Body {
  double x[3];                           // [m]
  double v[3], kick[3];                  // [m/s]
  double w[3], twist[3];                 // [rad/s]
  double radius;                         // [m]
  double force[3], torque[3];            // of the contacts [N], [N m]
  double inverse_mass, inverse_inertia;  // 0 if fixed (or without rotation) [1/kg], [1/(kg m^2)]
};

}  // namespace puffin::dem
