#include "micromodels/derivation/coat.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace puffin::micromodels::derivation {
namespace {

using Eigen::Vector3d;

Vector3d random_direction(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double z = 2.0 * unit(random) - 1.0, phi = 2.0 * std::numbers::pi * unit(random);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

std::vector<Vector3d> place_fines(int fines, double fine, double carrier, int patches, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Vector3d> centres, placed;
  for (int p = 0; p < patches; ++p) centres.push_back(random_direction(random));
  double in_patch = -1.0;  // cosine of the patches' half-angle: three of four directions are in one
  if (patches > 0) {
    std::vector<double> nearest(4000, -1.0);
    for (double& cosine : nearest) {
      const Vector3d n = random_direction(random);
      for (const Vector3d& c : centres) cosine = std::max(cosine, c.dot(n));
    }
    std::nth_element(nearest.begin(), nearest.begin() + 1000, nearest.end());
    in_patch = nearest[1000];
  }
  const double chord = 2.0 * fine / (carrier + fine), too_near = 1.0 - 0.5 * chord * chord;  // as a cosine
  // Slices in z, each at least as wide as a chord, so that only three need to be searched.
  const int slices = std::max(1, static_cast<int>(2.0 / chord));
  std::vector<std::vector<Vector3d>> slice(static_cast<std::size_t>(slices));
  const auto slice_of = [&](double z) { return std::clamp(static_cast<int>(0.5 * (z + 1.0) * slices), 0, slices - 1); };
  for (long trial = 0; static_cast<int>(placed.size()) < fines; ++trial) {
    if (trial > 1000L * fines)
      throw std::invalid_argument("the fines do not find room on the carrier: fewer or smaller fines, or more patches");
    const Vector3d n = random_direction(random);
    if (patches > 0 &&
        std::none_of(centres.begin(), centres.end(), [&](const Vector3d& c) { return c.dot(n) > in_patch; }))
      continue;
    const int s = slice_of(n.z());
    bool room = true;
    for (int k = std::max(0, s - 1); room && k <= std::min(slices - 1, s + 1); ++k)
      for (const Vector3d& other : slice[static_cast<std::size_t>(k)])
        if (other.dot(n) > too_near) {
          room = false;
          break;
        }
    if (!room) continue;
    slice[static_cast<std::size_t>(s)].push_back(n);
    placed.push_back(n);
  }
  return placed;
}

}  // namespace puffin::micromodels::derivation
