#pragma once
// The linear spring-dashpot contact in closed form: damping from restitution, contact time, largest overlap.
// Source: Schwager & Poeschel, Granular Matter 9, 465 (2007); the dashpot acts until the overlap is zero again.

#include <cmath>
#include <numbers>

namespace puffin::dem {

/// Damping ratio zeta = eta / (2 sqrt(m* k)) of the dashpot that returns the restitution e, for every m* and k:
/// zeta = -ln e / sqrt(pi^2 + ln^2 e).  0 < e <= 1.
inline double damping_ratio(double restitution) {
  const double l = std::log(restitution);
  return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

/// Contact time t_c = pi sqrt(m*/k) / sqrt(1 - zeta^2) [s].
inline double contact_time(double mass, double stiffness, double zeta) {
  return std::numbers::pi * std::sqrt(mass / (stiffness * (1.0 - zeta * zeta)));
}

/// Largest overlap of an impact at speed v, over v sqrt(m*/k): exp(-(zeta/w) atan(w/zeta)), w = sqrt(1 - zeta^2).
/// 1 without damping.
inline double peak_overlap_factor(double zeta) {
  const double w = std::sqrt(1.0 - zeta * zeta);
  return std::exp(-(zeta / w) * std::atan2(w, zeta));
}

/// The stiffness [N/m] at which an impact of the reduced mass m* at speed v just reaches the overlap `allowed`.
inline double stiffness_for_overlap(double mass, double speed, double allowed, double zeta) {
  const double s = speed * peak_overlap_factor(zeta) / allowed;
  return mass * s * s;
}

}  // namespace puffin::dem
