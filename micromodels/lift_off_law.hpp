#pragma once
// Fines thrown off by the deceleration of their carrier: a surrogate from contact mechanics.

#include "micromodels/validity.hpp"

namespace puffin::micromodels {

enum class Partner { wall, carrier };  // what the carrier hits: a flat wall, or another carrier like itself

/// Fraction of the fines that lift off a uniformly coated carrier at an impact of speed v:
///   f(v) = limit (1 - (v_c/v)^(6/5)) for v > v_c, 0 below.
/// A fine of mass m_f at the polar angle theta from the contact lifts off when m_f a cos(theta) > F, a the greatest
/// deceleration of the carrier; integrated over the half of the sphere that faces away from the obstacle, limit = 1/2.
/// Hertz impact of the coated carrier (mass M, radius R), with the effective m*, R*, E* of the pair:
///   d = (15 m* v^2 / (16 E* sqrt(R*)))^(2/5),   a = (4/3) E* sqrt(R*) d^(3/2) / M = C v^(6/5),   m_f C v_c^(6/5) = F.
///   wall:    m* = M,   R* = R,   1/E* = (1 - nu^2)/E + (1 - nu_w^2)/E_w   (E_w infinite: rigid)
///   carrier: m* = M/2, R* = R/2, 1/E* = 2 (1 - nu^2)/E
/// Adhesion of a fine: F = 4 pi gamma R_f R/(R_f + R), gamma the surface energy of one surface (Derjaguin, Muller &
/// Toporov 1975). With `spread` s > 0, F is log-normal around this median: ln F has the standard deviation s (measured
/// adhesion of micronised drug is log-normal: Young et al. 2003), and with x = ln(m_f a / F)/s, N the normal
/// distribution:
///   f = limit (N(x) - exp(s^2/2 - s x) N(x - s)).
/// Source: Hertz impact, K. L. Johnson, Contact Mechanics (1985), 11.4; limit 1/2: Cui & Sommerfeld, Powder Technol.
/// 344 (2019) 741, "about half". It leaves out sliding and rolling off, the spin, and the losses of the impact. The
/// impact angle is not used: the speed is the normal one at walls. The moduli must be the materials' own. Never a
/// contact stiffness softened for larger time steps: v_c scales E*^(-1/3), and is 3.1 times too large with a stiffness
/// 1/30 of the true one. in : speed v [m/s] >= 0.   out: fraction [1] in [0, limit].   Scales: v_c ~ gamma^(5/6).
class LiftOffLaw {
 public:
  struct Constants {
    Partner partner = Partner::wall;
    double carrier_diameter = 0.0;     // 2 R [m]
    double carrier_mass = 0.0;         // M, with its fines [kg]
    double fine_diameter = 0.0;        // 2 R_f [m]
    double fine_density = 0.0;         // [kg/m^3]
    double youngs_modulus = 0.0;       // E of the carrier [Pa]
    double poisson = 0.0;              // nu of the carrier
    double wall_youngs_modulus = 0.0;  // E_w [Pa], may be infinite; not used with Partner::carrier
    double wall_poisson = 0.0;         // nu_w
    double surface_energy = 0.0;       // gamma [J/m^2]
    double spread = 0.0;               // s [1], 0: all fines alike
    double limit = 0.5;                // f at infinite speed [1]
  };
  /// Throws std::invalid_argument unless lengths, masses, moduli and gamma are positive, 0 <= nu <= 0.5, 0 < limit <=
  /// 1, spread >= 0.
  explicit LiftOffLaw(const Constants& constants, Validity valid = {});

  double value(double speed) const;
  /// v_c [m/s]: from here on a fine of median adhesion at the pole lifts off.
  double threshold() const { return threshold_; }
  /// F [N], the median pull-off force of a fine.
  double adhesion() const;
  const Constants& constants() const { return c_; }
  const Validity& valid() const { return valid_; }

 private:
  Constants c_;
  Validity valid_;
  double threshold_ = 0.0;
};

}  // namespace puffin::micromodels
