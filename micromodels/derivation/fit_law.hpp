#pragma once
// From measured or derived fractions to the constants of a law.

#include <array>
#include <span>

#include "micromodels/derivation/least_squares.hpp"
#include "micromodels/power_law.hpp"
#include "micromodels/weibull_law.hpp"

namespace puffin::micromodels::derivation {

struct Point {
  double speed = 0.0;     // [m/s], > 0
  double fraction = 0.0;  // [1]
  double error = 1.0;     // standard error, or any number that all points share
};

struct PowerFit {
  std::array<Estimate, 5> A;
  double rms = 0.0;  // of the misfit in units of the errors
  PowerLaw law() const { return PowerLaw({A[0].value, A[1].value, A[2].value, A[3].value, A[4].value}); }
};

/// Both branches of f = A0 v^A1 (v < A2), A3 v^A4 (v >= A2) by least squares, the points weighted by 1/error. The
/// switch is tried between all neighbouring points that leave two or more to each branch; the best one lies where the
/// branches meet, if that is between its neighbours, else in their geometric middle: the law may jump there. Its
/// interval are those neighbours, widened to the other switches whose sum of squares is not worse by more than t^2.
/// A branch of zeros has A0 = 0, A1 = 1.
/// Throws std::invalid_argument with fewer than 5 points, speeds that are not positive or do not rise, negative
/// fractions or errors that are not positive.
PowerFit fit_power(std::span<const Point> points);

struct WeibullFit {
  Estimate limit, energy_ratio, shape;
  double carrier_mass = 0.0, adhesion_energy = 0.0;
  double rms = 0.0;
  WeibullLaw law() const {
    return WeibullLaw({limit.value, energy_ratio.value, shape.value, carrier_mass, adhesion_energy});
  }
};

/// f = limit (1 - exp(-(I/I0)^k)), I = carrier_mass v^2 / (2 adhesion_energy). With fix_limit the limit is 1.
/// Throws std::invalid_argument as fit_power(), and unless mass [kg] and energy [J] are positive.
WeibullFit fit_weibull(std::span<const Point> points, double carrier_mass, double adhesion_energy, bool fix_limit);

/// Root of the mean of ((value - fraction)/error)^2 over the points: how well a law predicts data it has not seen.
double misfit(const PowerLaw& law, std::span<const Point> points);

}  // namespace puffin::micromodels::derivation
