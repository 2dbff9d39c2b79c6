#pragma once
// The middle of repeated measurements.

#include <algorithm>
#include <limits>
#include <vector>

namespace puffin::bench {

/// The middle value, or the mean of the two in the middle; NaN of none.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

}  // namespace puffin::bench
