// What a carrier reads whose kernel a wall cuts.

#include "coupling/cut_stencil.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "coupling/transfer.hpp"
#include "tests/coupling/boxes.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;
using namespace puffin::coupling::testing;

constexpr double dx = 2e-4;

/// Air where `height` [cells] of a cell's centre above the surface is positive, and 1,000 carriers whose centres are at
/// least 0.15 cells above it (70 um on cells of 230 um) and at most 2.
struct Scene {
  using Height = std::function<double(const Eigen::Vector3d&)>;  // of a place in cells

  Scene(const Height& above, double diameter)
      : height(above),
        rows(box({16, 16, 16}, dx, [&](int i, int j, int k) { return above(Eigen::Vector3d(i, j, k)) > 0.0; })),
        cells(rows),
        air(moments(rows)) {
    for (const auto& x : places(rows, 200000, {4, 4, 2}, {11, 11, 11}))
      if (const double h = height(in_cells(x)); h > 0.15 && h < 2.0 && position.size() < 1000) position.push_back(x);
    stencils.build(cells, position, std::vector<double>(position.size(), 0.5 * diameter), all(position.size()));
  }
  Eigen::Vector3d in_cells(const Eigen::Vector3d& x) const { return (x - rows.origin()) / dx; }
  void blow(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& velocity) {
    for (const auto& run : rows.runs())
      for (int n = 0; n < run.count; ++n) {
        const auto c = rows.cell(run.first + n);
        const Eigen::Vector3d u = velocity({double(c[0]), double(c[1]), double(c[2])});
        air.ux[run.first + n] = static_cast<float>(u[0]);
        air.uy[run.first + n] = static_cast<float>(u[1]);
        air.uz[run.first + n] = static_cast<float>(u[2]);
      }
  }
  std::vector<Eigen::Vector3d> read() const {
    AirSamples samples;
    interpolate(stencils, air, position.size(), samples);
    return samples.velocity_lu;
  }
  /// What the weights alone read, by carrier.
  std::vector<Eigen::Vector3d> read_without_shift() const {
    std::vector<Eigen::Vector3d> result(position.size(), Eigen::Vector3d::Zero());
    for (const Stencil& s : stencils.stencils())
      for (const StencilEntry& e : stencils.entries(s))
        result[s.carrier] += e.weight * Eigen::Vector3d(air.ux[e.slot], air.uy[e.slot], air.uz[e.slot]);
    return result;
  }
  Height height;
  lbm::Rows rows;
  CellIndex cells;
  lbm::Moments air;
  std::vector<Eigen::Vector3d> position;
  Stencils stencils;
};

// Heights and velocities are integers over 1024, exact as floats. The solve divides by a variance of at least 1e-3
// cells squared: rounding 1e-16 * 2/1e-3, times the speeds of below 0.03.
constexpr double rounding = 1e-14;

TEST(CutStencil, AShearFlowIsReadAtTheCarriersPlaceBesidePlaneWallsAlignedAndOblique) {
  const std::vector<Scene::Height> walls{
      [](const Eigen::Vector3d& x) { return x[2] - 3.5; },     // in the faces of cells
      [](const Eigen::Vector3d& x) { return x[2] - 3.9375; },  // just below the centres
      [](const Eigen::Vector3d& x) { return x[2] - 4.0625; },  // just above: the nearest cell of many is solid
      [](const Eigen::Vector3d& x) { return (x[0] + 2.0 * x[2] - 16.5) / std::sqrt(5.0); },
      [](const Eigen::Vector3d& x) { return (x[0] - 2.0 * x[1] + 3.0 * x[2] - 15.25) / std::sqrt(14.0); }};
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (const double diameter : {0.7e-4, 3.3e-4}) {
      Scene s(walls[w], diameter);
      ASSERT_EQ(s.position.size(), 1000U);
      const double norm = std::array{1.0, 1.0, 1.0, std::sqrt(5.0), std::sqrt(14.0)}[w];
      const auto shear = [&](const Eigen::Vector3d& x) {
        return Eigen::Vector3d(Eigen::Vector3d(2, 1, -1) * (norm * walls[w](x) / 1024.0));
      };
      s.blow(shear);
      const auto u = s.read(), before = s.read_without_shift();
      double worst = 0.0;
      for (std::size_t p = 0; p < u.size(); ++p) {
        EXPECT_LT((u[p] - shear(s.in_cells(s.position[p]))).norm(), rounding) << w << ' ' << diameter;
        worst = std::max(worst, before[p].norm() / u[p].norm());
      }
      EXPECT_GT(worst, 2.0) << "the scene has cut stencils: the weights alone read more than twice the speed";
    }
}

// Whatever blows, the shift is no longer than the reading of the weights: the sum is on its side of the wall's rest.
TEST(CutStencil, NoReadingGoesPastAWallAtRest) {
  const Scene::Height oblique = [](const Eigen::Vector3d& x) { return (x[0] + 2.0 * x[2] - 16.5) / std::sqrt(5.0); };
  Scene s(oblique, 0.7e-4);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  s.blow([&](const Eigen::Vector3d&) { return Eigen::Vector3d(uniform(random), uniform(random), uniform(random)); });
  const auto u = s.read(), weights = s.read_without_shift();
  int limited = 0;
  for (std::size_t p = 0; p < u.size(); ++p) {
    const double most = weights[p].norm(), far = (u[p] - weights[p]).norm();
    EXPECT_LE(far, most * (1.0 + 1e-12));
    EXPECT_GE(u[p].dot(weights[p]), -1e-12 * most * most);
    limited += far > most * (1.0 - 1e-12);
  }
  EXPECT_GT(limited, 10);
}

// u = y z/1024 above two walls: what is read lies between the walls' rest and what the weights read.
TEST(CutStencil, ACornerIsReadBetweenItsWallsAndTheMeanPlace) {
  const Scene::Height corner = [](const Eigen::Vector3d& x) { return std::min(x[1] - 3.75, x[2] - 4.125); };
  Scene s(corner, 0.7e-4);
  const auto flow = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d((x[1] - 3.75) * (x[2] - 4.125) / 1024.0, 0, 0);
  };
  s.blow(flow);
  const auto u = s.read(), weights = s.read_without_shift();
  double error = 0.0, before = 0.0;
  for (std::size_t p = 0; p < u.size(); ++p) {
    EXPECT_GE(u[p][0], -1e-15);
    const double exact = flow(s.in_cells(s.position[p]))[0];
    error += std::abs(u[p][0] - exact), before += std::abs(weights[p][0] - exact);
  }
  EXPECT_LT(error, 0.5 * before);
}

TEST(CutStencil, AGapOfOneCellIsReadAsItsCell) {
  Scene s([](const Eigen::Vector3d& x) { return 0.5 - std::abs(x[2] - 8.0); }, 0.7e-4);
  ASSERT_FALSE(s.position.empty());
  s.blow([](const Eigen::Vector3d& x) { return Eigen::Vector3d(x[0] / 1024.0, 0, 0); });
  const auto u = s.read();
  for (std::size_t p = 0; p < u.size(); ++p) EXPECT_NEAR(u[p][0], s.in_cells(s.position[p])[0] / 1024.0, rounding);
}

TEST(CutStencil, WhatIsSpreadStaysOnTheCellsOfTheKernel) {
  Scene s([](const Eigen::Vector3d& x) { return x[2] - 4.0625; }, 0.7e-4);
  for (std::size_t n = 0; n < s.stencils.stencils().size(); ++n) {
    double weights = 0.0, shifts = 0.0;
    for (const StencilEntry& e : s.stencils.entries(s.stencils.stencils()[n])) {
      EXPECT_GT(e.weight, 0.0);
      weights += e.weight;
    }
    for (const Shift& shift : s.stencils.shifts(n)) {
      shifts += shift.weight;
      EXPECT_TRUE(std::binary_search(s.stencils.cells().begin(), s.stencils.cells().end(), shift.slot));
    }
    EXPECT_NEAR(weights, 1.0, 1e-14);
    EXPECT_NEAR(shifts, 0.0, 1e-12);
  }
}
}  // namespace
