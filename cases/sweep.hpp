#pragma once
// Points of a parameter sweep.

#include <cstdint>
#include <string>
#include <vector>

namespace puffin::cases {

enum class SweepMethod { list, factorial, lhs };

/// One swept key: its values as TOML texts and, where they are numbers or quantities, in SI.
struct SweepRange {
  std::string key;
  std::vector<std::string> texts;
  std::vector<double> numbers;  // as many as texts, or none
  bool whole = false;           // the key takes whole numbers: points in between are rounded to such
};

/// Values by point, one TOML text a range. samples: 0 if not given.
/// Throws std::invalid_argument naming the range and the remedy: lists of different length (list), not exactly two
/// numbers that differ (lhs; factorial with samples), no samples (lhs), samples with a list, more than 100000 points.
std::vector<std::vector<std::string>> sweep_points(SweepMethod method, const std::vector<SweepRange>& ranges,
                                                   std::int64_t samples, std::uint64_t seed);

}  // namespace puffin::cases
