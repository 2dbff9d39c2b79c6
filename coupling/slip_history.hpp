#pragma once
// How long every carrier spent at which slip speed: enough to ask another drag law what it would have taken.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "micromodels/law.hpp"

namespace puffin::coupling {

/// Slip speeds in classes of a quarter octave from 1/16 to 256 m/s, and one class below and one above. A class keeps
/// its time and the way that slipped by, so that a rate linear in the speed is returned exactly; another one to the
/// curvature within a class (below 0.3 % for the square of the speed). Plain data; belongs in a checkpoint.
struct SlipHistory {
  static constexpr int per_octave = 4, octaves = 12, classes = per_octave * octaves + 2;
  static constexpr double lowest = 1.0 / 16.0;  // [m/s]

  SlipHistory() = default;
  explicit SlipHistory(std::size_t carriers)
      : seconds(carriers * classes, 0.0), metres(carriers * classes, 0.0), asked(carriers, 0.0) {}

  // by carrier id and class: [id * classes + class]
  std::vector<double> seconds;  // [s]
  std::vector<double> metres;   // [m], integral of the slip speed
  // by carrier id
  std::vector<double> asked;  // fines that the run's own drag law asked for since the last contact that released

  /// Class of a slip speed [m/s] >= 0.
  static int class_of(double slip) {
    if (!(slip >= lowest)) return 0;
    const int k = 1 + static_cast<int>(std::floor(per_octave * std::log2(slip / lowest)));
    return k < classes ? k : classes - 1;
  }
  void add(std::int64_t id, double slip, double duration) {
    const std::size_t at = static_cast<std::size_t>(id) * classes + static_cast<std::size_t>(class_of(slip));
    seconds[at] += duration;
    metres[at] += slip * duration;
  }
};

/// Rates [1/s] of a law at 16 speeds in each class: two laws that agree here are taken for the same.
using RateSamples = std::vector<double>;
RateSamples sample_rates(const micromodels::Law& law);

}  // namespace puffin::coupling
