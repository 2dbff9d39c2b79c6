#include "cases/initial_disturbance.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace puffin::cases {
namespace {

/// The finaliser of SplitMix64: Steele, Lea & Flood, OOPSLA 2014, 453.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

std::function<Eigen::Vector3d(const Eigen::Vector3d&)> initial_disturbance(const Case& c, double reference_speed,
                                                                           double dx, const Eigen::Vector3d& box,
                                                                           const std::array<bool, 3>& periodic) {
  bool repeats = false;
  for (int d = 0; d < 3; ++d) repeats = repeats || (periodic[d] && box[d] > 1.5 * dx);
  if (!repeats || c.numerics.les == Les::none || c.air.initial != InitialField::uniform) return {};
  return [=, seed = c.numerics.seed](const Eigen::Vector3d& x) {
    std::uint64_t key = mix(seed);
    for (int d = 0; d < 3; ++d) key = mix(key ^ static_cast<std::uint64_t>(std::llround(2.0 * x[d] / dx)));
    Eigen::Vector3d u;
    for (int d = 0; d < 3; ++d) {
      key = mix(key);
      const double share = static_cast<double>(key >> 11) * 0x1p-53;  // [0, 1)
      u[d] = 1e-4 * reference_speed * (2.0 * share - 1.0);
    }
    return u;
  };
}

}  // namespace puffin::cases
