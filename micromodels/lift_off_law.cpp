#include "micromodels/lift_off_law.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace puffin::micromodels {

namespace {

using std::numbers::pi;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("lift-off: ") + what);
}

/// Standard normal distribution function.
double normal(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

LiftOffLaw::LiftOffLaw(const Constants& c, Validity valid) : c_(c), valid_(valid) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  require(positive(c.carrier_diameter) && positive(c.fine_diameter), "carrier_diameter and fine_diameter must be > 0");
  require(positive(c.carrier_mass) && positive(c.fine_density), "carrier_mass and fine_density must be > 0");
  require(positive(c.youngs_modulus), "youngs_modulus must be > 0");
  require(c.poisson >= 0.0 && c.poisson <= 0.5, "poisson must lie in [0, 0.5]");
  require(c.partner == Partner::carrier || c.wall_youngs_modulus > 0.0, "wall_youngs_modulus must be > 0");
  require(c.wall_poisson >= 0.0 && c.wall_poisson <= 0.5, "wall_poisson must lie in [0, 0.5]");
  require(positive(c.surface_energy), "surface_energy must be > 0");
  require(std::isfinite(c.spread) && c.spread >= 0.0, "spread must be >= 0");
  require(c.limit > 0.0 && c.limit <= 1.0, "limit must lie in (0, 1]");

  const bool wall = c.partner == Partner::wall;
  const double compliance = (1.0 - c.poisson * c.poisson) / c.youngs_modulus;
  const double other = wall ? (1.0 - c.wall_poisson * c.wall_poisson) / c.wall_youngs_modulus : compliance;
  const double modulus = 1.0 / (compliance + other);               // E*
  const double radius = (wall ? 0.5 : 0.25) * c.carrier_diameter;  // R*
  const double mass = (wall ? 1.0 : 0.5) * c.carrier_mass;         // m*
  const double stiffness = modulus * std::sqrt(radius);
  // a = C v^(6/5)
  const double deceleration = 4.0 / 3.0 * stiffness / c.carrier_mass * std::pow(15.0 * mass / (16.0 * stiffness), 0.6);
  const double fine_mass = pi / 6.0 * c.fine_density * std::pow(c.fine_diameter, 3);
  threshold_ = std::pow(adhesion() / (fine_mass * deceleration), 5.0 / 6.0);
}

double LiftOffLaw::adhesion() const {
  const double fine = 0.5 * c_.fine_diameter, carrier = 0.5 * c_.carrier_diameter;
  return 4.0 * pi * c_.surface_energy * fine * carrier / (fine + carrier);
}

double LiftOffLaw::value(double speed) const {
  if (!(speed > 0.0)) return 0.0;
  const double overload = std::pow(speed / threshold_, 1.2);  // m_f a / F at the median
  if (c_.spread == 0.0) return overload > 1.0 ? c_.limit * (1.0 - 1.0 / overload) : 0.0;
  const double s = c_.spread, x = std::log(overload) / s;
  // The second term is at most the first; far below the threshold both vanish and rounding must not leave a negative
  // rest.
  return c_.limit * std::fmax(normal(x) - std::exp(0.5 * s * s - s * x) * normal(x - s), 0.0);
}

}  // namespace puffin::micromodels
