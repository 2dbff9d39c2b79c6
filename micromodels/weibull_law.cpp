#include "micromodels/weibull_law.hpp"

#include <cmath>
#include <stdexcept>

namespace puffin::micromodels {

WeibullLaw::WeibullLaw(const Constants& constants, Validity valid) : c_(constants), valid_(valid) {
  for (const double c : {c_.limit, c_.energy_ratio, c_.shape, c_.carrier_mass, c_.adhesion_energy})
    if (!std::isfinite(c) || !(c > 0.0))
      throw std::invalid_argument("weibull: limit, energy_ratio, shape, carrier_mass and adhesion_energy must be > 0");
  if (c_.limit > 1.0) throw std::invalid_argument("weibull: limit is a fraction and cannot exceed 1");
}

double WeibullLaw::value(double speed) const {
  const double ratio = 0.5 * c_.carrier_mass * speed * speed / c_.adhesion_energy;
  return -c_.limit * std::expm1(-std::pow(ratio / c_.energy_ratio, c_.shape));
}

}  // namespace puffin::micromodels
