#pragma once
// The elastic contact of two spheres, or of a sphere and a plane, in closed form: Hertz (1882) along the normal,
// Mindlin (1949) across it, and the dashpot that returns the restitution asked for. Sources: Tsuji, Tanaka & Ishida,
// Powder Technol. 71, 239 (1992); Thornton, Cummins & Cleary, Powder Technol. 233, 30 (2013); Antypov & Elliott,
// Europhys. Lett. 94, 50004 (2011); Johnson, Contact Mechanics, sections 4.2, 7.2, 11.4. Checked by:
// tests/dem/test_hertz.cpp

#include <cmath>
#include <limits>
#include <numbers>

namespace puffin::dem {

/// Of a pair of bodies: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 and 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2, G = E/(2(1+nu)).
struct PairModuli {
  double normal = 0.0;  // E* [Pa]
  double shear = 0.0;   // G* [Pa]
};
inline PairModuli pair_moduli(double young_a, double poisson_a, double young_b, double poisson_b) {
  const double g_a = young_a / (2.0 * (1.0 + poisson_a)), g_b = young_b / (2.0 * (1.0 + poisson_b));
  return {1.0 / ((1.0 - poisson_a * poisson_a) / young_a + (1.0 - poisson_b * poisson_b) / young_b),
          1.0 / ((2.0 - poisson_a) / g_a + (2.0 - poisson_b) / g_b)};
}

/// Radius of the contact, a = sqrt(R* delta) [m]; 0 without overlap.
inline double hertz_radius(double radius, double overlap) { return std::sqrt(radius * std::max(0.0, overlap)); }

/// F = 4/3 E* a delta [N]. Its slope dF/d delta is hertz_stiffness(a).
inline double hertz_force(double modulus, double a, double overlap) { return 4.0 / 3.0 * modulus * a * overlap; }

/// S_n = 2 E* a [N/m] of a contact of radius a, whatever presses it together.
inline double hertz_stiffness(double modulus, double a) { return 2.0 * modulus * a; }

/// k_t = 8 G* a [N/m] as long as nothing slips.
inline double mindlin_stiffness(double shear_modulus, double a) { return 8.0 * shear_modulus * a; }

/// Overlap [m] under a force: (3 F/(4 E* sqrt(R*)))^(2/3).
inline double hertz_overlap(double modulus, double radius, double force) {
  return std::cbrt(std::pow(0.75 * force / modulus, 2) / radius);
}

/// Largest overlap [m] of an elastic impact: (15 m* v^2/(16 E* sqrt(R*)))^(2/5). It lasts 2.943 times that over v.
inline double hertz_peak_overlap(double modulus, double radius, double mass, double speed) {
  return std::pow(15.0 / 16.0 * mass * speed * speed / (modulus * std::sqrt(radius)), 0.4);
}

/// Part beta of critical damping of the dashpot eta = 2 beta sqrt(m* S_n) of a contact that never pulls: it is over
/// when the force is zero. e from 0.01 to 0.9 by the polynomial of Thornton et al. (2013, their eq. 18; e returned
/// within 0.1 %). Above, where the polynomial fails (it has no root at e = 1), the pulling part of the dashpot's force
/// is a correction of a few per cent to the exact beta = sqrt(5/6) zeta of a contact that may pull: taken as linear in
/// 1 - e, joined at e = 0.9.
inline double hertz_damping(double restitution) {
  const double e = restitution;
  if (e > 0.9) {
    const double l = std::log(e);
    const double exact = -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l) * std::sqrt(5.0 / 6.0);
    return exact * (1.0 + 0.2316 * (1.0 - e));
  }
  constexpr double h[] = {-6.918798, -16.41105, 146.8049,  -796.4559, 2928.711,
                          -7206.864, 11494.29,  -11342.18, 6276.757,  -1489.915};
  double alpha = 0.0;
  for (int n = 9; n >= 0; --n) alpha = e * (h[n] + alpha);
  return std::sqrt(1.0 / (1.0 - (1.0 + e) * (1.0 + e) * std::exp(alpha)) - 1.0);
}

/// Time [s] of a Rayleigh wave around a sphere: pi R sqrt(rho/G)/(0.1631 nu + 0.8766), rho from its mass.
inline double rayleigh_time(double radius, double mass, double young, double poisson) {
  const double density = 0.75 * mass / (std::numbers::pi * radius * radius * radius);
  const double shear = young / (2.0 * (1.0 + poisson));
  return std::numbers::pi * radius * std::sqrt(density / shear) / (0.1631 * poisson + 0.8766);
}

}  // namespace puffin::dem
