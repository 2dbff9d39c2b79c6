#pragma once
// What the air (and whatever else acts from afar) does to one carrier, held constant during one air step.

#include <Eigen/Core>

namespace puffin::dem {

/// m dv/dt = drag (air_velocity - v) + force + m g + contact forces;  (2/5) m R^2 dw/dt = torque + contact torques.
struct Load {
  Eigen::Vector3d air_velocity = Eigen::Vector3d::Zero();  // u at the carrier [m/s]
  double drag = 0.0;                                       // beta [kg/s], >= 0, of the whole entry
  Eigen::Vector3d force = Eigen::Vector3d::Zero();         // lift, pressure gradient, ...; gravity is in Models [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();        // [N m]
};

}  // namespace puffin::dem
