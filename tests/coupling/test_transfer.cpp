#include "coupling/transfer.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "coupling/volume_fraction.hpp"
#include "tests/coupling/boxes.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;
using namespace puffin::coupling::testing;

const Scale scale{2e-4, 4e-7, 1.2};

/// 1,000 carriers in a duct with a step, beside its walls too.
struct Scene {
  explicit Scene(double diameter = 1.5e-4, int count = 1000)
      : rows(box({60, 14, 12}, scale.dx, [](int i, int j, int) { return i < 20 ? j > 4 : true; })),
        cells(rows),
        position(places(rows, count, {1, 5, 1}, {58, 12, 10})),
        which(all(position.size())) {
    stencils.build(cells, position, std::vector<double>(position.size(), 0.5 * diameter), which);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1e-12, 1e-12);
    for (int n = 0; n < count; ++n) impulse.emplace_back(uniform(random), uniform(random), uniform(random));
  }
  lbm::Rows rows;
  CellIndex cells;
  std::vector<Eigen::Vector3d> position, impulse;
  std::vector<int> which;
  Stencils stencils;
};

TEST(Interpolate, AUniformFlowIsReadAsItIsBesideWallsToo) {
  // Weights sum to 1 within 4e-14 (test_stencils); the values are floats that convert exactly.
  Scene s;
  auto m = moments(s.rows);
  std::fill(m.ux.begin(), m.ux.end(), 0.1f);
  AirSamples air;
  interpolate(s.stencils, m, s.position.size(), air);
  for (std::size_t p = 0; p < s.position.size(); ++p) {
    EXPECT_NEAR(air.velocity_lu[p].x(), 0.1f, 1e-14);
    EXPECT_EQ(air.velocity_lu[p].y(), 0.0);
  }
}

TEST(Interpolate, ALinearFlowAndItsGradientAreReadExactlyAwayFromWalls) {
  const auto rows = full_box({30, 30, 30}, scale.dx);
  const CellIndex cells(rows);
  const auto position = places(rows, 100, {8, 8, 8}, {21, 21, 21});
  // Integers divided by 1024 are exact floats, so only the doubles round: 343 * 1e-16 * 0.1.
  auto m = moments(rows);
  Eigen::Matrix3d slope;
  slope << 1, -2, 0, 3, 1, -1, 0, 2, -2;
  const Eigen::Vector3d pressure_slope(2, 0, -1);
  for (const auto& run : rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const auto slot = run.first + n;
      const auto c = rows.cell(slot);
      const Eigen::Vector3d u = slope * Eigen::Vector3d(c[0], c[1], c[2]) / 1024.0;
      m.ux[slot] = static_cast<float>(u.x());
      m.uy[slot] = static_cast<float>(u.y());
      m.uz[slot] = static_cast<float>(u.z());
      m.density_excess[slot] = static_cast<float>(pressure_slope.dot(Eigen::Vector3d(c[0], c[1], c[2])) / 1024.0);
    }
  for (const double d : {0.7e-4, 1.5e-4, 3.3e-4}) {
    Stencils s;
    s.build(cells, position, std::vector<double>(position.size(), 0.5 * d), all(position.size()));
    AirSamples air;
    AirGradients gradients;
    interpolate(s, m, position.size(), air);
    interpolate_gradients(s, m, position.size(), gradients);
    for (std::size_t p = 0; p < position.size(); ++p) {
      const Eigen::Vector3d expected = slope * ((position[p] - rows.origin()) / scale.dx) / 1024.0;
      EXPECT_LT((air.velocity_lu[p] - expected).norm(), 1e-13);
      EXPECT_LT((gradients.velocity_lu[p] - slope / 1024.0).norm(), 1e-12);
      EXPECT_LT((gradients.density_excess_lu[p] - pressure_slope / 1024.0).norm(), 1e-12);
    }
  }
}

TEST(Interpolate, GradientsOfALinearFlowAreExactBesideWallsToo) {
  Scene s;
  auto m = moments(s.rows);
  for (const auto& run : s.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const auto c = s.rows.cell(run.first + n);
      m.uy[run.first + n] = static_cast<float>((c[0] - 3 * c[1] + 2 * c[2]) / 1024.0);
    }
  AirGradients gradients;
  interpolate_gradients(s.stencils, m, s.position.size(), gradients);
  // The solve divides by a variance of at least 1e-3 cells squared (below, the gradient is left 0): 1e-16/1e-3.
  for (const auto& g : gradients.velocity_lu)
    EXPECT_LT((g.row(1).transpose() - Eigen::Vector3d(1, -3, 2) / 1024.0).norm(), 1e-12);
}

TEST(Spread, WhatTheCarriersGiveTheCellsTake) {
  for (const double d : {0.7e-4, 1.5e-4, 3.3e-4}) {
    Scene s(d);
    auto f = force(s.rows);
    Spreader spreader(s.rows.slots());
    const double interval = 3 * scale.dt;
    const MomentumBooking books = spreader.spread(s.stencils, s.impulse, interval, scale, f);
    EXPECT_LT((books.given - books.taken).norm() / books.exchanged, 1e-12);  // the ledger's demand
    Eigen::Vector3d stored = Eigen::Vector3d::Zero();
    for (std::size_t slot = 0; slot < s.rows.slots(); ++slot) {
      stored += Eigen::Vector3d(f.x[slot], f.y[slot], f.z[slot]);
      if (!s.rows.is_active(slot)) {
        EXPECT_EQ(f.x[slot], 0.0f);
      }
    }
    stored *= scale.force() * interval;
    // what the lattice holds is what was taken and the booked rounding
    EXPECT_LT((stored - books.taken - books.rounding).norm() / books.exchanged, 1e-12);
    // each float is within 2^-24 of its value
    EXPECT_LT(books.rounding.norm() / books.exchanged, 6e-8);
  }
}

TEST(Spread, IsTheTransposeOfInterpolationAwayFromWalls) {
  // sum_p u_p . J_p = sum_j u_j . F_j: both are sum_pj w_pj u_j . J_p. Sums of 67,000 terms in another order, and
  // floats of the force (6e-8 each, of random sign: 6e-8 is a bound). Carriers that walls make read elsewhere give 0.
  Scene s;
  int whole = 0;
  for (std::size_t n = 0; n < s.stencils.stencils().size(); ++n)
    if (s.stencils.shifts(n).empty())
      ++whole;
    else
      s.impulse[s.stencils.stencils()[n].carrier].setZero();
  ASSERT_GT(whole, 500);
  auto m = moments(s.rows);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-0.1f, 0.1f);
  for (auto* u : {&m.ux, &m.uy, &m.uz})
    for (float& x : *u) x = uniform(random);
  auto f = force(s.rows);
  Spreader spreader(s.rows.slots());
  spreader.spread(s.stencils, s.impulse, scale.dt, scale, f);
  AirSamples air;
  interpolate(s.stencils, m, s.position.size(), air);
  double carriers = 0.0, cells = 0.0, size = 0.0;
  for (std::size_t p = 0; p < s.position.size(); ++p) {
    const double power = air.velocity_lu[p].dot(s.impulse[p]);
    carriers += power;
    size += std::abs(power);
  }
  for (std::size_t slot = 0; slot < s.rows.slots(); ++slot)
    cells += static_cast<double>(f.x[slot]) * m.ux[slot] + static_cast<double>(f.y[slot]) * m.uy[slot] +
             static_cast<double>(f.z[slot]) * m.uz[slot];
  cells *= scale.force() * scale.dt;
  EXPECT_NEAR(carriers, cells, 6e-8 * size);
}

TEST(Spread, ForcesAreTheSameForOneAndTwoThreadsAndAfterClearing) {
  Scene s(1.5e-4, 4000);
  std::array<lbm::BodyForce, 2> f{force(s.rows), force(s.rows)};
  std::array<MomentumBooking, 2> books;
  Spreader spreader(s.rows.slots());
  for (int n = 0; n < 2; ++n) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, n + 1);
    books[n] = spreader.spread(s.stencils, s.impulse, scale.dt, scale, f[n]);
  }
  EXPECT_EQ(f[0].x, f[1].x);
  EXPECT_EQ(f[0].y, f[1].y);
  EXPECT_EQ(f[0].z, f[1].z);
  EXPECT_EQ(books[0].taken, books[1].taken);
  EXPECT_EQ(books[0].rounding, books[1].rounding);
  Spreader::clear(s.stencils.cells(), f[0]);
  EXPECT_EQ(f[0].x, force(s.rows).x);
  EXPECT_EQ(f[0].z, force(s.rows).z);
}

TEST(SolidFraction, OfAnEvenCloudIsItsVolumeFraction) {
  // One carrier at each cell centre and each corner... every cell of a periodic box gets the same sum by symmetry when
  // the carriers sit at the same place in every cell: phi = V / dx^3, up to the rounding of 27 * 27 products.
  const auto rows = full_box({12, 12, 12}, scale.dx, {true, true, true});
  const CellIndex cells(rows);
  std::vector<Eigen::Vector3d> position;
  for (const auto& run : rows.runs())
    for (int n = 0; n < run.count; ++n)
      position.push_back(rows.centre(run.first + n) + scale.dx * Eigen::Vector3d(0.2, -0.1, 0.4));
  Stencils s;
  s.build(cells, position, std::vector<double>(position.size(), 0.5e-4), all(position.size()));
  Spreader spreader(rows.slots());
  std::vector<double> fraction(position.size(), 0.0);
  const double cell = scale.dx * scale.dx * scale.dx;
  solid_fraction(s, std::vector<double>(position.size(), 0.25 * cell), scale.dx, spreader, fraction);
  for (const double phi : fraction) EXPECT_NEAR(phi, 0.25, 1e-13);
  solid_fraction(s, std::vector<double>(position.size(), 3.0 * cell), scale.dx, spreader, fraction);
  for (const double phi : fraction) EXPECT_NEAR(phi, largest_solid_fraction, 1e-13);
}
}  // namespace
