#pragma once
// A running sum that does not lose the small terms.

#include <cmath>

namespace puffin::lbm {

/// Neumaier's compensated sum: the error is about one rounding of the result, whatever the number of terms.
/// Source: A. Neumaier, ZAMM 54, 39 (1974). The result depends on the order of the terms alone.
class CompensatedSum {
 public:
  void add(double term) {
    const double sum = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

  /// The two parts, for a checkpoint that restores the sum to the bit.
  double sum() const { return sum_; }
  double lost() const { return lost_; }
  static CompensatedSum restored(double sum, double lost) {
    CompensatedSum s;
    s.sum_ = sum;
    s.lost_ = lost;
    return s;
  }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

}  // namespace puffin::lbm
