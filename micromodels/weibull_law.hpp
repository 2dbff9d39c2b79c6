#pragma once
// Cumulative Weibull function of the energy of the impact.

#include "micromodels/validity.hpp"

namespace puffin::micromodels {

/// f(v) = limit (1 - exp(-(I/I0)^k)), I = (M v^2 / 2) / adhesion energy.
/// Source of the form: Yang, Wu & Adams, Int. J. Pharm. 490 (2015) 32 (fitted to the dispersion of agglomerates; I0 and
/// k depend on the formulation and must be given). in : speed v [m/s] >= 0.   out: fraction [1] in [0, limit].
class WeibullLaw {
 public:
  struct Constants {
    double limit = 1.0;            // f at infinite speed [1], in (0, 1]
    double energy_ratio = 0.0;     // I0 [1]
    double shape = 0.0;            // k [1]
    double carrier_mass = 0.0;     // M [kg]
    double adhesion_energy = 0.0;  // work that parts all fines from the carrier [J]
  };
  /// Throws std::invalid_argument unless all constants are positive and limit <= 1.
  explicit WeibullLaw(const Constants& constants, Validity valid = {});

  double value(double speed) const;
  const Constants& constants() const { return c_; }
  const Validity& valid() const { return valid_; }

 private:
  Constants c_;
  Validity valid_;
};

}  // namespace puffin::micromodels
