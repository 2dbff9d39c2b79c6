#pragma once
// Surfaces differ: a log-normal factor on the surface energy of each carrier.

#include <cmath>
#include <cstdint>
#include <numbers>

namespace puffin::dem {

/// exp(sigma z) with z standard normal: median 1. z follows from seed and id alone, so that nothing needs to be stored
/// and a continued run finds the same carriers. Source of the bits: splitmix64 (Steele, Lea & Flood 2014); Box &
/// Muller. A wall contact takes its carrier's factor, a pair the geometric mean of both (Berthelot's rule for W).
inline double adhesion_factor(std::uint64_t seed, std::int64_t id, double sigma) {
  if (sigma == 0.0) return 1.0;
  std::uint64_t state = seed * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(id) * 0xd1342543de82ef95u;
  const auto draw = [&state] {  // in (0, 1)
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  };
  const double length = std::sqrt(-2.0 * std::log(draw()));
  return std::exp(sigma * length * std::cos(2.0 * std::numbers::pi * draw()));
}

}  // namespace puffin::dem
