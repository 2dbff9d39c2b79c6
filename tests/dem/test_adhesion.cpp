// van der Waals adhesion: forces and energies that do not depend on the softened stiffness.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "dem/surface_law.hpp"
#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

constexpr double gamma_lactose = 3.6e-3, d0 = 4e-10;  // the thesis's surface energy and cut-off gap
constexpr double radius = 35e-6;

double well_depth() { return 4.0 * M_PI * gamma_lactose * radius * d0; }  // carrier on wall, U = F0 d0

Scene sticky_floor(double e, std::optional<double> stiffness) {
  Scene s;
  s.models.carrier.adhesion = Hamaker{gamma_lactose, 0.0, d0, ParcelScaling::ddpm};
  s.law().restitution = e;
  s.law().stiffness = stiffness;
  s.same_walls();
  s.walls = PlaneWalls::floor();
  return s;
}

/// Force [N] at which a resting carrier leaves the floor when it is pulled by a force that grows by 1e-4 F0 in 2 us.
double pull_off(std::optional<double> stiffness, bool sleep) {
  Scene s = sticky_floor(0.3, stiffness);
  s.models.integration.sleep = sleep;
  s.add(lactose(1, {0, 0, radius}));
  s.loads[0].force = {0, 0, -1e-8};
  s.run(200e-6, 1e-6);  // falls the last nothing and comes to rest
  for (double pull = 0.0; pull < 3e-6; pull += 1e-4 * 1.5834e-6) {
    s.loads[0].force = {0, 0, pull};
    s.step(2e-6);
    if (!s.events.ended.empty()) return pull;
  }
  return 0.0;
}

struct Blow {
  double out = 0.0;  // speed of leaving, 0: stuck
};

/// A head-on impact on the floor at `speed`.
Blow blow(double e, double speed, std::optional<double> stiffness) {
  Scene s = sticky_floor(e, stiffness);
  s.models.integration.sleep = false;
  const double height = std::max(speed, 1e-5) * 3e-6;
  s.add(lactose(1, {0, 0, radius + height}, {0, 0, -speed}));
  for (int i = 0; i < 4000 && s.events.ended.empty(); ++i) s.step(1e-6);
  return {s.events.ended.empty() ? 0.0 : s.v(0).z()};
}

}  // namespace

// Catalogue D10, facts 1.3 k: carrier-wall 1.583e-6 N, carrier-carrier half of it.
TEST(Adhesion, PullOffForceIsThatOfTheHamakerCatalogue) {
  Surfaces surfaces;
  surfaces.adhesion = Hamaker{gamma_lactose, 4.343e-20, d0, ParcelScaling::ddpm};
  const SurfaceLaw law(surfaces);
  const double wall = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(pair_law(law, radius, radius, wall, wall, 1e-10).pull_off, 1.5834e-6, 1e-3 * 1.5834e-6);
  EXPECT_NEAR(pair_law(law, radius, radius, radius, radius, 1e-10).pull_off, 0.7917e-6, 1e-3 * 0.7917e-6);
  // U = H R*/(6 d0), facts 3.1: 6.33e-16 J
  EXPECT_NEAR(pair_law(law, radius, radius, wall, wall, 1e-10).well, 6.33e-16, 1e-3 * 6.33e-16);
}

// A case may place a carrier so that it hangs. Of a bond at rest the spring gives 2 d0 at F0; it is placed loaded.
TEST(Adhesion, ACarrierPlacedOnAWallHoldsUpToItsPullOffForceWhateverTheStiffness) {
  for (const std::optional<double> stiffness : {std::optional<double>{}, std::optional(100.0), std::optional(1e4)})
    for (const double part : {0.98, 1.02}) {
      Scene s = sticky_floor(0.5, stiffness);
      s.models.integration.sleep = false;
      s.add(lactose(1, {0, 0, radius}));
      s.loads[0].force = {0, 0, part * 1.58336e-6};
      s.run(200e-6, 1e-6);
      if (part < 1.0)
        EXPECT_NEAR(s.x(0).z(), radius, 2.0 * d0) << stiffness.value_or(0.0);
      else
        EXPECT_GT(s.x(0).z(), 2.0 * radius) << stiffness.value_or(0.0);  // F t^2/(2 m) = 1.2e-4 m further
    }
}

// Placed touching, to the digits of a case file or 0.3 nm apart, two at rest hold each other though at first nothing
// pulls them apart: both fall alike until the ceiling holds the upper one. Its pull-off force is 600 times their
// weight.
TEST(Adhesion, CarriersPlacedTouchingHoldEachOther) {
  for (const double gap : {0.0, 3e-10})
    for (const bool adhesive : {true, false}) {
      Scene s = sticky_floor(0.5, {});
      s.walls = PlaneWalls({{{0, 0, 2e-3}, -Vector3d::UnitZ()}});
      if (!adhesive) s.models.carrier.adhesion = NoAdhesion{};
      s.models.gravity = {0, 0, -9.81};
      s.add(lactose(1, {1e-3, 0, 1.965e-3}));
      s.add(lactose(2, {1e-3, 0, 1.895e-3 - gap}));
      s.run(2e-3, 2e-5);
      EXPECT_NEAR(s.x(0).z(), 1.965e-3, 2.0 * d0);
      if (adhesive)
        EXPECT_NEAR(s.x(1).z(), 1.895e-3 - gap, 4.0 * d0) << gap;
      else
        EXPECT_NEAR(s.x(1).z(), 1.895e-3 - 0.5 * 9.81 * 4e-6, 1e-8);
    }
}

// Facts 3.12: for 10 carriers a parcel, l = 2.154, adhesion per mass is x 0.215, 0.464, 1 of a single carrier's.
TEST(Adhesion, ParcelScalingKeepsForcePerLengthAreaOrMass) {
  const double wall = std::numeric_limits<double>::infinity(), l = std::cbrt(10.0);
  const double single = 1.58336e-6;
  int power = 1;
  for (const ParcelScaling scaling : {ParcelScaling::ddpm, ParcelScaling::energy, ParcelScaling::mass}) {
    Surfaces surfaces;
    surfaces.adhesion = Hamaker{gamma_lactose, 0.0, d0, scaling};
    const PairLaw pair = pair_law(SurfaceLaw(surfaces), l * radius, radius, wall, wall, 1e-9);
    EXPECT_NEAR(pair.pull_off / single, std::pow(l, power), 1e-3 * std::pow(l, power));
    EXPECT_NEAR(pair.well / pair.pull_off, d0, 1e-12 * d0);
    ++power;
  }
}

// The bond's damped oscillation under a ramp of 1e-4 F0 in 2 us stays below 1e-3 F0 (its period is 2.3 us): 0.1 %, as
// the catalogue asks. With sleep the release is computed awake, so it is no later.
TEST(Adhesion, SlowPullReleasesAtTheTrueForceForEveryStiffness) {
  const double expected = 4.0 * M_PI * gamma_lactose * radius;
  for (const std::optional<double> k :
       {std::optional<double>(), std::optional(1000.0), std::optional(100.0), std::optional(10.0)})
    for (const bool sleep : {false, true})
      EXPECT_NEAR(pull_off(k, sleep), expected, 1e-3 * expected) << k.value_or(0.0) << (sleep ? " asleep" : " awake");
}

// Catalogue D12: v_contact^2 = v_inf^2 + 2U/m, here seen as the energy of the spring and of motion inside the contact.
TEST(Adhesion, ATouchGainsTheWellDepth) {
  for (const double k : {1000.0, 10.0}) {
    Scene s = sticky_floor(1.0, k);
    const double speed = 1e-3;
    s.add(lactose(1, {0, 0, radius + 1e-9}, {0, 0, -speed}));
    const double m = s.state.carriers.mass[0];
    const double expected = 0.5 * m * speed * speed + well_depth();
    double worst = 0.0;
    int inside = 0;
    for (int i = 0; i < 2000 && s.events.ended.empty(); ++i) {
      s.step(0.02e-6);
      const double overlap = radius - s.x(0).z();
      if (overlap <= 0.0) continue;
      ++inside;
      worst = std::max(worst, std::abs(0.5 * m * s.v(0).squaredNorm() + 0.5 * k * overlap * overlap - expected));
    }
    EXPECT_GT(inside, 10);
    EXPECT_LT(worst, 1e-3 * expected);
  }
}

// v_out^2 = e^2 (v^2 + 2U/m) - 2U/m: sticks below v_s = sqrt((1/e^2 - 1) 2U/m). e is right within 0.1 % (test_impact),
// so v_s is right within 0.1 %/(1-e^2) = 0.2 %; tested 1 % to either side.
TEST(Adhesion, SticksBelowTheSpeedOfTheEnergyBalanceForEveryStiffness) {
  const double e = 0.6, m = lactose(1, {0, 0, 0}).mass;
  const double w = 2.0 * well_depth() / m;
  const double threshold = std::sqrt((1.0 / (e * e) - 1.0) * w);
  for (const std::optional<double> k :
       {std::optional<double>(), std::optional(2000.0), std::optional(200.0), std::optional(20.0)}) {
    EXPECT_EQ(blow(e, 0.99 * threshold, k).out, 0.0) << k.value_or(0.0);
    EXPECT_GT(blow(e, 1.01 * threshold, k).out, 0.0) << k.value_or(0.0);
    const double speed = 2.0 * threshold, out = std::sqrt(e * e * (speed * speed + w) - w);
    EXPECT_NEAR(blow(e, speed, k).out, out, 0.005 * out) << k.value_or(0.0);
  }
}

// A bonded carrier that is struck leaves with the energy above the well: v_out^2 = v^2 - 2U/m, for every stiffness.
TEST(Adhesion, ABondBreaksByABlowAtTheTrueEnergy) {
  for (const std::optional<double> k : {std::optional<double>(), std::optional(1000.0), std::optional(10.0)}) {
    const double m = lactose(1, {0, 0, 0}).mass, w = 2.0 * well_depth() / m;
    for (const double factor : {0.9, 1.1}) {
      Scene s = sticky_floor(1.0, k);
      s.law().restitution = 0.3;
      s.same_walls();
      s.models.integration.sleep = false;
      s.add(lactose(1, {0, 0, radius}));
      s.loads[0].force = {0, 0, -1e-9};
      s.run(300e-6, 1e-6);
      ASSERT_EQ(s.events.ended.size(), 0u);
      s.loads[0].force = Vector3d::Zero();
      s.run(100e-6, 1e-6);
      // undamped from now on, so that the energy balance is exact
      std::get<LinearContact>(s.models.wall.contact).restitution = 1.0;
      s.state.carriers.velocity[0] = {0, 0, std::sqrt(factor * w)};
      s.run(20e-6, 0.1e-6);
      if (factor < 1.0) {
        EXPECT_EQ(s.events.ended.size(), 0u);
      } else {
        ASSERT_EQ(s.events.ended.size(), 1u);
        EXPECT_NEAR(s.v(0).z() * s.v(0).z(), 0.1 * w, 0.01 * w);
      }
    }
  }
}

// A bonded carrier slides when the drag along the wall exceeds mu F0 (rotation off, as the thesis).
TEST(Adhesion, FrictionOfABondHoldsMuTimesThePullOffForce) {
  const double f0 = 4.0 * M_PI * gamma_lactose * radius;
  for (const double part : {0.95, 1.05}) {
    Scene s = sticky_floor(0.5, std::nullopt);
    s.models.rotation = false;
    s.add(lactose(1, {0, 0, radius}));
    s.loads[0].force = {0, 0, -1e-9};
    s.run(300e-6, 1e-6);
    for (int i = 0; i < 200; ++i) {
      s.loads[0].force = {0.3 * f0 * part * (i + 1) / 200.0, 0, 0};
      s.step(2e-6);
    }
    s.run(200e-6, 2e-6);
    const double stretch = 0.3 * f0 / (2.0 / 7.0 * 10.0 * f0 / (0.02 * 2.0 * radius));  // of the tangential spring
    if (part < 1.0)
      EXPECT_LT(s.x(0).x(), 1.5 * stretch);
    else  // a = 5 % of 0.3 F0/m for some 200 us
      EXPECT_GT(s.x(0).x(), stretch + 0.2 * 0.5 * 0.05 * 0.3 * f0 / s.state.carriers.mass[0] * 4e-8);
  }
}
