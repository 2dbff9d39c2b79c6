#pragma once
// Lift of a sphere in a shear flow and of a spinning sphere, and the torque that air exerts on its spin.
// d: diameter [m]; slip u - v [m/s]; vorticity curl u [1/s]; relative spin Omega = curl u/2 - spin [rad/s].
// Checked by: tests/coupling/test_lift.cpp

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "coupling/drag.hpp"

namespace puffin::coupling {

/// Which lift acts.
enum class Lift { none, saffman_mei, saffman_magnus };

/// F = 1.615 d^2 sqrt(rho mu/|w|) (slip x w) C [N], with C(Re, b), b = d |w|/(2 |slip|):
///   Re <= 40: (1 - 0.3314 sqrt b) exp(-Re/10) + 0.3314 sqrt b;   Re > 40: 0.0524 sqrt(b Re).
/// Sources: Saffman, J. Fluid Mech. 22, 385 (1965) and 31, 624 (1968); Mei, Int. J. Multiphase Flow 18, 145 (1992).
/// Valid: far from walls, 0.005 < b < 0.4, Re < 100. A carrier that lags behind is pushed to the faster side.
inline Eigen::Vector3d saffman_mei_lift(const Air& air, double d, const Eigen::Vector3d& slip,
                                        const Eigen::Vector3d& vorticity) {
  const double w = vorticity.norm(), u = slip.norm();
  if (!(w > 0.0) || !(u > 0.0)) return Eigen::Vector3d::Zero();
  const double re = air.density * d * u / air.viscosity, b = 0.5 * d * w / u;
  const double root = 0.3314 * std::sqrt(b);
  const double mei = re <= 40.0 ? (1.0 - root) * std::exp(-0.1 * re) + root : 0.0524 * std::sqrt(b * re);
  return 1.615 * d * d * std::sqrt(air.density * air.viscosity / w) * mei * slip.cross(vorticity);
}

/// F = pi/8 rho d^2 C |slip| (Omega x slip)/|Omega| [N], C = 0.45 + (Re_r/Re - 0.45) exp(-0.05684 Re_r^0.4 Re^0.3),
/// Re_r = rho d^2 |Omega|/mu. Source: Oesterle & Bui Dinh, Exp. Fluids 25, 16 (1998). Valid: Re < 140; as Re -> 0 it is
/// Rubinow & Keller's pi/8 rho d^3 Omega x slip.
inline Eigen::Vector3d magnus_lift(const Air& air, double d, const Eigen::Vector3d& slip,
                                   const Eigen::Vector3d& relative_spin) {
  const double w = relative_spin.norm(), u = slip.norm();
  if (!(w > 0.0) || !(u > 0.0)) return Eigen::Vector3d::Zero();
  const double re = air.density * d * u / air.viscosity, re_r = air.density * d * d * w / air.viscosity;
  const double c = 0.45 + (re_r / re - 0.45) * std::exp(-0.05684 * std::pow(re_r, 0.4) * std::pow(re, 0.3));
  return std::numbers::pi / 8.0 * air.density * d * d * c * u / w * relative_spin.cross(slip);
}

/// T = k Omega; k [N m s] = rho/2 (d/2)^5 C_R |Omega|, C_R = 64 pi/Re_r below Re_r = 32, else 12.9/sqrt(Re_r) +
/// 128.4/Re_r. Source: Dennis, Singh & Ingham, J. Fluid Mech. 101, 257 (1980). Slow: k = pi mu d^3.
/// Valid: Re_r < 1000. The two branches meet within 0.5 %.
inline double spin_resistance(const Air& air, double d, double relative_spin) {
  const double re = air.density * d * d * relative_spin / air.viscosity;
  const double stokes = std::numbers::pi * air.viscosity * d * d * d;
  if (re < 32.0) return stokes;
  return stokes * (12.9 * std::sqrt(re) + 128.4) / (64.0 * std::numbers::pi);
}

}  // namespace puffin::coupling
