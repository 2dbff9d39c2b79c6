// Sleeping: saves time, and changes the answer within a stated bound.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

constexpr double radius = 35e-6;
const double f0_wall = 4.0 * M_PI * 3.6e-3 * radius;

/// Layers of carriers on a sticky floor, a little above each other, as a bed that falls together.
Scene bed(int side, int layers, bool sleep) {
  Scene s;
  s.models.carrier.adhesion = Hamaker{3.6e-3, 0.0, 4e-10, ParcelScaling::ddpm};
  s.law().restitution = 0.4;
  s.law().rolling_friction = 0.05;
  s.models.gravity = {0, 0, -9.81};
  s.models.integration.sleep = sleep;
  s.same_walls();
  s.walls = PlaneWalls::floor();
  int id = 0;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i, ++id)
        s.add(lactose(id, {i * 2.02 * radius + 1e-7 * (id % 3), j * 2.02 * radius + 1e-7 * (id % 5),
                           radius * 1.02 + k * 2.02 * radius}));
  return s;
}

}  // namespace

TEST(Rest, ABedFallsAsleepAndThenCostsNothing) {
  Scene s = bed(4, 2, true);
  s.run(20e-3, 2e-6);
  EXPECT_EQ(count_asleep(s.state), 32u);
  const auto steps = s.state.statistics.contact_steps;
  s.run(1e-3, 2e-6);
  EXPECT_EQ(s.state.statistics.contact_steps, steps);
  EXPECT_LT(s.state.statistics.largest_overlap, 0.02);
}

// Pulled up slowly, single carriers on the floor leave at F0 - m g with and without sleep; the load grows by 1e-3 F0 a
// step and must be noticed within wake_change: the release itself is computed awake, so both agree within 2 steps.
TEST(Rest, SleepersWakeInTimeToLeaveAtTheSameLoad) {
  double released[2];
  for (const bool sleep : {false, true}) {
    Scene s = bed(1, 1, sleep);
    s.run(10e-3, 2e-6);
    EXPECT_EQ(count_asleep(s.state), sleep ? 1u : 0u);
    double pull = 0.0;
    while (s.events.ended.empty() && pull < 2.0 * f0_wall) {
      pull += 1e-3 * f0_wall;
      s.loads[0].force = {0, 0, pull};
      s.run(100e-6, 2e-6);  // slowly: it falls asleep again between
    }
    released[sleep] = pull;
  }
  EXPECT_NEAR(released[1], released[0], 2e-3 * f0_wall);
  EXPECT_NEAR(released[1], f0_wall, 3e-3 * f0_wall);
}

// A load that changes by 0.15 of what friction holds, every 80 steps: it falls asleep after 50 and wakes at the change.
// Each nap doubles the wait, 50, 100, ...: no second one fits between changes, where without patience there would be
// one in each of 100. When the load stays, it sleeps again, and after a long sleep it does so as fast as at first.
TEST(Rest, NapsThatDoNotLastAreGivenUp) {
  Scene s = bed(1, 1, true);
  s.models.rotation = false;
  const auto pushed = [&](double part, int steps) {
    s.loads[0].force = {0.3 * part * f0_wall, 0, 0};
    for (int n = 0; n < steps; ++n) s.run(2e-6, 2e-6);
  };
  for (int n = 0; n < 100; ++n) pushed(n % 2 ? 0.15 : 0.0, 80);
  EXPECT_LE(s.state.statistics.wakes, 2);
  EXPECT_GE(s.state.statistics.wakes, 1);
  pushed(0.0, 64 * 50 + 1000);
  EXPECT_EQ(count_asleep(s.state), 1u);
  pushed(0.15, 90);
  EXPECT_EQ(count_asleep(s.state), 1u) << "it had slept long: 50 steps are enough again";
  s.state.rest[0].patience = 64, s.state.rest[0].steps_at_rest = 64 * 50;
  const auto wakes = s.state.statistics.wakes;
  pushed(0.0, 1);
  EXPECT_EQ(s.state.statistics.wakes, wakes + 1);
  EXPECT_EQ(s.state.rest[0].patience, 64) << "no longer than that";
}

// Sideways: friction holds mu F0; with rotation off. Slides at the same drag with and without sleep.
TEST(Rest, SleepersSlideAtTheSameLoad) {
  double slid[2];
  for (const bool sleep : {false, true}) {
    Scene s = bed(1, 1, sleep);
    s.models.rotation = false;
    s.run(10e-3, 2e-6);
    double pull = 0.0;
    const double x0 = s.x(0).x();
    while (s.x(0).x() - x0 < 3e-6 && pull < f0_wall) {
      pull += 1e-3 * f0_wall;
      s.loads[0].force = {pull, 0, 0};
      s.run(60e-6, 2e-6);
    }
    slid[sleep] = pull;
  }
  EXPECT_NEAR(slid[1], slid[0], 5e-3 * f0_wall);
  EXPECT_NEAR(slid[1], 0.3 * f0_wall, 0.02 * f0_wall);
}

// An impact on a sleeping bed is computed as if it were awake: momentum passes on in the same air step. The bed's rest
// changes positions by less than 1e-4 of a diameter before; after the impact the paths agree within 1 % of the travel.
TEST(Rest, AnImpactOnASleepingRowPassesItsMomentumOn) {
  Vector3d v[2][3];
  for (const bool sleep : {false, true}) {
    Scene s = bed(1, 1, sleep);
    s.models.gravity = Vector3d::Zero();
    s.walls = PlaneWalls({{Vector3d(0, 0, 0), Vector3d::UnitZ()}});
    s.state = State{};
    s.loads.clear();
    for (int i = 0; i < 3; ++i) s.add(lactose(i, {i * 2.0002 * radius, 0, 1.0002 * radius}, {0, 0, -1e-4}));
    s.models.gravity = {0, 0, -9.81};
    s.run(5e-3, 2e-6);
    EXPECT_EQ(count_asleep(s.state), sleep ? 3u : 0u);
    s.add(lactose(9, {-200e-6, 0, radius}, {10.0, 0, 0}));
    s.run(60e-6, 2e-6);
    for (int i = 0; i < 3; ++i) v[sleep][i] = s.v(i);
  }
  for (int i = 0; i < 3; ++i) EXPECT_LT((v[0][i] - v[1][i]).norm(), 0.01 * 10.0) << i;
  EXPECT_GT(v[1][2].x(), 1.0);
}

// From rest 5 nm over the floor, which it reaches within the step, sqrt(2 5e-9/9.81) = 32 us: nothing is fast when it
// is asked what may be met. It comes down by the gap and by what its weight presses it in, m g/k; missed, it would fall
// on.
TEST(Rest, ACarrierPutDownJustAboveTheFloorLandsOnIt) {
  constexpr double gap = 5e-9;
  Scene s;
  s.models.gravity = {0.0, 0.0, -9.81};
  s.law().stiffness = 10.0;
  s.same_walls();
  s.walls = PlaneWalls::floor();
  s.add(lactose(0, {0.0, 0.0, 35e-6 + gap}));
  s.run(5e-3, 5e-5);
  const double sag = s.state.carriers.mass[0] * 9.81 / 10.0;  // 0.3 nm
  EXPECT_NEAR(s.x(0)[2], 35e-6 - sag,
              0.02 * sag);  // its bounces last 32 us (1 + 2 0.6/(1 - 0.6)) = 0.13 ms, then it swings in 35 us
}

// Static equilibrium is honest: a bed under half of the load that it can hold does not creep, awake or asleep.
TEST(Rest, ABedUnderHalfItsLimitDoesNotCreep) {
  for (const bool sleep : {false, true}) {
    Scene s = bed(3, 1, sleep);
    s.run(10e-3, 2e-6);
    for (int i = 1; i <= 500; ++i) {  // slowly: a sudden pull of half the limit would swing up to the limit
      for (Load& load : s.loads) load.force = {0.01 * f0_wall * i / 500, 0, 0.5 * f0_wall * i / 500};
      s.step(2e-6);
    }
    s.run(2e-3, 2e-6);
    const std::vector<Vector3d> before = s.state.carriers.position;
    s.run(5e-3, 2e-6);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT((s.x(i) - before[i]).norm(), 1e-3 * radius);
  }
}
