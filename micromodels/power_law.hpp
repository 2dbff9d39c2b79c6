#pragma once
// Power law in two branches: the form of the founding thesis.

#include <array>

#include "micromodels/validity.hpp"

namespace puffin::micromodels {

/// f(v) = A0 v^A1 for v < A2, A3 v^A4 for v >= A2.
/// Source: thesis eq. 2.8 (fraction of the INITIAL fines at an impact) and 2.10 (per second, by the slip speed v_r
/// of 2.11). in : speed v [m/s] >= 0 out: fraction [1], or rate [1/s]; not clipped. A0 and A3 carry the unit
/// [(s/m)^A1], [(s/m)^A4], for a rate times [1/s]; A2 [m/s]. Zero at rest unless A1 = 0. The branches need not meet:
/// see jump().
class PowerLaw {
 public:
  /// Throws std::invalid_argument unless all A are finite and >= 0.
  explicit PowerLaw(const std::array<double, 5>& constants, Validity valid = {});

  double value(double speed) const;
  /// Upper minus lower branch at the switch A2: 0 for a continuous law.
  double jump() const;
  const std::array<double, 5>& constants() const { return a_; }
  const Validity& valid() const { return valid_; }

 private:
  std::array<double, 5> a_;
  Validity valid_;
};

}  // namespace puffin::micromodels
