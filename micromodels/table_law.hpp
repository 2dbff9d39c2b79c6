#pragma once
// A law given as a table.

#include <vector>

#include "micromodels/validity.hpp"

namespace puffin::micromodels {

/// Linear interpolation in the speed, and in the impact angle if there are several (bilinear).
/// in : speed [m/s] >= 0; angle between velocity and surface [degrees], 90 = head on
/// out: fraction [1], or rate [1/s]; not clipped. Below the first speed linear to 0 at rest; above the last speed, and
/// beyond the
///      first and last angle, the value at the end is held.
class TableLaw {
 public:
  /// value[i * angles.size() + j] belongs to speed i and angle j. An empty list of angles: no dependence on the angle.
  /// Throws std::invalid_argument unless speeds > 0 (the first may be 0) and angles rise strictly, the values are
  /// finite, >= 0, 0 at rest, and, unless `may_fall`, do not fall with the speed.
  TableLaw(std::vector<double> speeds, std::vector<double> angles, std::vector<double> values, bool may_fall = false,
           Validity valid = {});

  double value(double speed, double angle) const;
  const Validity& valid() const { return valid_; }

 private:
  double at_angle(std::size_t speed, double angle) const;

  std::vector<double> speeds_, angles_, values_;
  Validity valid_;
};

}  // namespace puffin::micromodels
