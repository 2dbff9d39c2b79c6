#include "micromodels/power_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puffin::micromodels {

PowerLaw::PowerLaw(const std::array<double, 5>& constants, Validity valid) : a_(constants), valid_(valid) {
  for (std::size_t i = 0; i < a_.size(); ++i)
    if (!std::isfinite(a_[i]) || a_[i] < 0.0)
      throw std::invalid_argument("power law: A" + std::to_string(i) +
                                  " must be a number >= 0, as more speed cannot take less");
}

namespace {

constexpr double most = 1e30;  // of fines that are all taken at 1: more could overflow, and times no fines be no number

/// A factor of zero takes nothing however steep the branch: 0 times an overflowing power would be no number.
double branch(double factor, double speed, double exponent) {
  return factor == 0.0 ? 0.0 : std::min(factor * std::pow(speed, exponent), most);
}

}  // namespace

double PowerLaw::value(double speed) const {
  return speed < a_[2] ? branch(a_[0], speed, a_[1]) : branch(a_[3], speed, a_[4]);
}

double PowerLaw::jump() const { return branch(a_[3], a_[2], a_[4]) - branch(a_[0], a_[2], a_[1]); }

}  // namespace puffin::micromodels
