#pragma once
// Small boxes of air and clouds of carriers for the tests of the coupling.

#include <Eigen/Core>
#include <array>
#include <random>
#include <vector>

#include "lbm/moments.hpp"
#include "lbm/rows.hpp"

namespace puffin::coupling::testing {

/// A box of nx x ny x nz cells with the first cell's centre at (1, -2, 3) mm. `fluid(i,j,k)` says which are air.
template <class Fluid>
lbm::Rows box(std::array<int, 3> size, double dx, Fluid fluid, std::array<bool, 3> periodic = {false, false, false}) {
  lbm::geometry::Voxels voxels;
  voxels.origin = {1e-3, -2e-3, 3e-3};
  voxels.dx = dx;
  voxels.size = size;
  voxels.fill(fluid);
  return lbm::Rows(voxels, periodic);
}

inline lbm::Rows full_box(std::array<int, 3> size, double dx, std::array<bool, 3> periodic = {false, false, false}) {
  return box(
      size, dx, [](int, int, int) { return true; }, periodic);
}

/// `count` places, uniform between `low` and `high`, given in cells from the centre of cell (0,0,0).
inline std::vector<Eigen::Vector3d> places(const lbm::Rows& rows, int count, Eigen::Vector3d low, Eigen::Vector3d high,
                                           unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Eigen::Vector3d> result;
  for (int n = 0; n < count; ++n) {
    const Eigen::Vector3d r(uniform(random), uniform(random), uniform(random));
    result.push_back(rows.origin() + rows.dx() * (low + (high - low).cwiseProduct(r)));
  }
  return result;
}

inline std::vector<int> all(std::size_t count) {
  std::vector<int> result(count);
  for (std::size_t n = 0; n < count; ++n) result[n] = static_cast<int>(n);
  return result;
}

inline lbm::Moments moments(const lbm::Rows& rows) {
  const std::size_t n = rows.slots();
  return {std::vector<float>(n), std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
}

inline lbm::BodyForce force(const lbm::Rows& rows) {
  const std::size_t n = rows.slots();
  return {std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
}

}  // namespace puffin::coupling::testing
