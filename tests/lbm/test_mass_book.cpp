// The mass of an air that nothing lets in or out.

#include "lbm/mass_book.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "tests/lbm/box_scene.hpp"
#include "tests/sanitized.hpp"

using namespace puffin::lbm;
using puffin::sanitized;
using namespace puffin::lbm::test;
using geometry::Vec3;

namespace {

/// A cavity of n x n x n cells whose lid moves along x.
struct Cavity {
  explicit Cavity(bool double_precision, double n = 8) {
    Boundary lid = wall();
    lid.profile = [](const Vec3&) { return Vec3(1, 0, 0); };
    scene = make_box(Vec3(n, n, n), 1.0, {wall(), wall(), wall(), lid, wall(), wall()});
    AirOptions options;
    options.double_precision = double_precision;
    air = make_air(scene, options);
    drive = at_rest(air);
    drive.speed[3] = 0.1;
  }
  double excess_share() const { return mass_excess(air) / static_cast<double>(air.rows.active_cells()); }

  BoxScene scene;
  Air air;
  Drive drive;
  MassBook book;
  PoreSpace pores;
};

/// Takes `density` from the populations at rest of every cell.
void take(float density, Air& air) {
  auto& p = std::get<Populations<float>>(air.populations);
  for (const Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) p.arrived(run, run.first + n, 0) -= density;
}

}  // namespace

TEST(MassBook, WhatIsMissingComesBackAndIsCounted) {
  Cavity c(false);
  step(c.air, 0.55, c.drive);
  keep_mass(1.0, c.pores, c.air, c.book);
  const double start = c.excess_share();
  const float taken = 1.0F / (1 << 20);
  take(taken, c.air);
  for (int n = 1; n < steps_between_looks; ++n) {
    step(c.air, 0.55, c.drive);
    keep_mass(1.0, c.pores, c.air, c.book);
  }
  // The populations at rest lie below 2^-7, where they are rounded by at most 2^-32 in each cell; the drift of 2,000
  // steps, some 1e-11 each, is part of what is found missing.
  EXPECT_NEAR(c.excess_share(), start, std::ldexp(1.0, -32));
  EXPECT_EQ(c.book.corrections, 1);
  EXPECT_NEAR(c.book.lost_share(), taken, 2000 * 5e-11);
  EXPECT_EQ(c.book.lost_share(), c.book.returned_share());
}

TEST(MassBook, SinglePrecisionStirredForLongKeepsItsMass) {
  Cavity kept(false), left(false);
  step(kept.air, 0.55, kept.drive);
  keep_mass(1.0, kept.pores, kept.air, kept.book);
  step(left.air, 0.55, left.drive);
  const double start = kept.excess_share();
  constexpr int steps = 20'000;
  for (int n = 1; n < steps; ++n) {
    step(kept.air, 0.55, kept.drive);
    keep_mass(1.0, kept.pores, kept.air, kept.book);
    step(left.air, 0.55, left.drive);
  }
  const double drift = std::abs(left.excess_share() - start);
  RecordProperty("drift_without", std::to_string(drift));
  RecordProperty("booked_off", std::to_string((kept.book.lost_share() - (start - left.excess_share())) / drift));
  // The last step is one of a look: what is left is rounding (see above), or too little to be given back.
  EXPECT_LT(std::abs(kept.excess_share() - start), least_return);
  EXPECT_GT(drift, 10.0 * least_return) << "there was nothing to correct";
  // What is booked is the loss of the air that was kept, which flows a little otherwise than the one that was left and
  // so rounds otherwise: found 0.005 of the drift apart with g++, 0.32 in the build for addresses. A book that counts
  // wrong is off by all of it.
  EXPECT_NEAR(kept.book.lost_share(), start - left.excess_share(), (sanitized ? 0.5 : 0.2) * drift);
}

TEST(MassBook, AChangedTimeStepChangesWhatIsBooked) {
  // With r = dt_new/dt_old the collision multiplies rho - 1 by r^2; nothing is missing then.
  Cavity c(true);
  set_cells([](const Vec3&) { return InitialCell{0.01, {0, 0, 0}, {}}; }, c.air);
  c.drive.speed[3] = 0.0;
  step(c.air, 0.8, c.drive);
  keep_mass(1.0, c.pores, c.air, c.book);
  const double r = 1.05;
  collide_and_stream({0.5 + 0.3 / r, r, 0.8}, c.drive, c.air);
  apply_links(c.drive, c.air);
  keep_mass(r, c.pores, c.air, c.book);
  EXPECT_NEAR(c.excess_share(), 0.01 * r * r, 1e-12);
  while (c.air.steps < steps_between_looks) {
    step(c.air, 0.8, c.drive);
    keep_mass(1.0, c.pores, c.air, c.book);
  }
  EXPECT_EQ(c.book.corrections, 0);
  // 2,000 steps x 20 roundings of 1e-17 (of populations of 0.01), at most all of one sign.
  EXPECT_NEAR(c.book.missing_share(), 0.0, 1e-12);
}

TEST(MassBook, AnAirThatAnOpeningHoldsIsLeftAlone) {
  Boundary out = wall();
  out.kind = BoundaryKind::pressure_outlet;
  BoxScene scene = make_box(Vec3(8, 8, 8), 1.0, {wall(), out, wall(), wall(), wall(), wall()});
  Air air = make_air(scene, AirOptions{});
  EXPECT_FALSE(is_closed(air));
  MassBook book;
  step(air, 0.6, at_rest(air));
  keep_mass(1.0, PoreSpace{}, air, book);
  EXPECT_EQ(book.cells, 0);
}

TEST(MassBook, EqualBitsForAnyNumberOfThreads) {
  std::vector<float> first;
  for (const int threads : {1, 3}) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    Cavity c(false, 28);  // 5 chunks
    step(c.air, 0.55, c.drive);
    keep_mass(1.0, c.pores, c.air, c.book);
    take(1e-6F, c.air);
    c.air.steps = steps_between_looks - 20;
    while (c.air.steps < steps_between_looks) {
      step(c.air, 0.55, c.drive);
      keep_mass(1.0, c.pores, c.air, c.book);
    }
    ASSERT_EQ(c.book.corrections, 1);
    ASSERT_GT(c.air.rows.chunks().size(), 4U);
    const auto& f = std::get<Populations<float>>(c.air.populations).f;
    if (first.empty()) first.assign(f.begin(), f.end());
    EXPECT_EQ(std::memcmp(first.data(), f.data(), f.size() * sizeof(float)), 0) << threads << " threads";
  }
}
