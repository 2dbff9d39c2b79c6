// Walls that hold a concentration.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

/// A slab of n cells in y between walls, periodic in x and z; patch 0 holds below, patch 1 above.
struct Slab {
  explicit Slab(int n)
      : scene(make_scene({4, n, 3}, {true, false, true})), fields(scene.fields()), budget(scene.budget()) {
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 4; ++i) {
        fields.work.held_walls[1].push_back({scene.at(i, 0, k), 0, false});
        fields.work.held_walls[1].push_back({scene.at(i, n - 1, k), 1, true});
      }
  }
  void advance(double steps, const ScalarLaw& law) {
    advance_scalars(scene.rows, scene.fluxes, steps, ScalarOptions{{law}}, fields, budget);
  }
  double at(int j) const { return fields.amount[0][scene.at(2, j, 1)]; }

  Scene scene;
  ScalarFields fields;
  ScalarBudget budget;
};

ScalarLaw law(double diffusivity, WallRule wall, double below, double above) {
  ScalarLaw l{Scheme::mc, diffusivity, wall};
  l.fixed = {below, above};
  return l;
}

/// Steady: Y = below + (above - below)(j + 1/2)/n at the centres, exact on cells. After 14 diffusion times of the slab
/// what is left of the start is exp(-14 pi^2) of it, 1e-60. Once with steps that diffusion allows inside the sweeps and
/// once far beyond them, in lines; walls that reflect elsewhere and walls that absorb do the same where a value is
/// held.
TEST(HeldWalls, LeadToTheStraightProfileExactly) {
  constexpr int n = 8;
  for (const WallRule wall : {WallRule::reflect, WallRule::absorb})
    for (const double step : {1.0, 40.0}) {
      Slab slab(n);
      const ScalarLaw l = law(0.1, wall, 0.7, 0.2);
      for (double t = 0.0; t < 14.0 * n * n / 0.1; t += step) slab.advance(step, l);
      for (int j = 0; j < n; ++j)
        EXPECT_NEAR(slab.at(j), 0.7 - 0.5 * (j + 0.5) / n, 1e-12) << j << ", steps of " << step;
      // What is in the slab came in and did not leave again. Of what walls took each of N sums rounds by half a unit.
      const double rounding = 14.0 * n * n / 0.1 / step * 0x1p-53 * absorbed(slab.budget, 0);
      EXPECT_NEAR(total(slab.fields, 0), -gone(slab.budget, 0), rounding + 1e-12);
    }
}

/// The equation is linear: what is held at 1 and starts at 0 is 1 less what starts at 1 and is absorbed, at any time.
/// Of a slab at rest both take the same steps, so the difference is rounding: 1e-13 over 300 updates of numbers up
/// to 1.
TEST(HeldWalls, AtOneAreAbsorbingWallsTurnedAround) {
  constexpr int n = 8;
  for (const double step : {0.5, 20.0}) {
    Slab holds(n), absorbs(n);
    for (const auto& run : absorbs.scene.rows.runs())
      for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) absorbs.fields.amount[0][s] = 1.0;
    for (int t = 0; t < 300; ++t) {
      holds.advance(step, law(0.05, WallRule::reflect, 1.0, 1.0));
      absorbs.advance(step, {Scheme::mc, 0.05, WallRule::absorb});
    }
    for (int j = 0; j < n; ++j) EXPECT_NEAR(holds.at(j), 1.0 - absorbs.at(j), 1e-13) << j << ", steps of " << step;
    EXPECT_GT(holds.at(n / 2), 0.1) << "it has come to the middle";
  }
}

/// A wall without a value does as the law says, in the list or not: where it reflects, the slab fills to what the other
/// wall holds; where it absorbs, the profile falls to it. In sweeps and in lines.
TEST(HeldWalls, WithoutAValueAreOrdinaryWalls) {
  constexpr int n = 5;
  for (const double step : {1.0, 40.0})
    for (const bool listed : {true, false}) {
      ScalarLaw l{Scheme::mc, 0.1, WallRule::reflect};
      l.fixed = {0.7};
      if (listed) l.fixed.push_back(std::nullopt);
      Slab reflects(n), absorbs(n);
      // The slowest part of what is missing falls with (pi/2)^2 D/n^2: 40 diffusion times leave exp(-99).
      for (double t = 0.0; t < 40.0 * n * n / 0.1; t += step) reflects.advance(step, l);
      l.wall = WallRule::absorb;
      for (double t = 0.0; t < 40.0 * n * n / 0.1; t += step) absorbs.advance(step, l);
      for (int j = 0; j < n; ++j) {
        EXPECT_NEAR(reflects.at(j), 0.7, 1e-12) << j;
        EXPECT_NEAR(absorbs.at(j), 0.7 - 0.7 * (j + 0.5) / n, 1e-12) << j;
      }
    }
}

/// Two scalars side by side, one held at 1 below and one above, are each other's mirror image; a third that holds
/// nothing stays as it is. Nothing of one enters another.
TEST(HeldWalls, OfOneScalarLeaveTheOthersAlone) {
  constexpr int n = 6;
  Slab slab(n);
  slab.fields.amount.resize(3, std::vector<double>(slab.scene.rows.slots(), 0.0));
  slab.budget = ScalarBudget(slab.scene.rows, 3, 2);
  slab.fields.amount[2][slab.scene.at(1, 2, 1)] = 0.25;
  ScalarOptions o{{{Scheme::mc, 0.05, WallRule::reflect}, {Scheme::mc, 0.05, WallRule::reflect}, {}}};
  o.scalar[0].fixed = {1.0, 0.0};
  o.scalar[1].fixed = {0.0, 1.0};
  for (int t = 0; t < 50; ++t) advance_scalars(slab.scene.rows, slab.scene.fluxes, 1.0, o, slab.fields, slab.budget);
  for (int j = 0; j < n; ++j)
    EXPECT_NEAR(slab.fields.amount[0][slab.scene.at(2, j, 1)], slab.fields.amount[1][slab.scene.at(2, n - 1 - j, 1)],
                1e-15);
  EXPECT_GT(slab.fields.amount[0][slab.scene.at(2, n / 2, 1)], 0.01);
  EXPECT_EQ(slab.fields.amount[2][slab.scene.at(1, 2, 1)], 0.25);
}

TEST(HeldWalls, MustBeWallsOfCells) {
  Slab slab(4);
  slab.fields.work.held_walls[1].push_back({slab.scene.at(0, 1, 0), 0, true});  // an open face
  EXPECT_THROW(slab.advance(1.0, law(0.1, WallRule::reflect, 1.0, 0.0)), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::lbm
