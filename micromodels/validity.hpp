#pragma once
// Where a law may be used.

#include <limits>

namespace puffin::micromodels {

/// Speeds [m/s] for which a law was derived or fitted. Outside it is evaluated all the same; whoever asks reports it.
struct Validity {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  bool contains(double speed) const { return speed >= low && speed <= high; }
};

}  // namespace puffin::micromodels
