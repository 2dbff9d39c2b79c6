// Lift, torque and the nearness of walls: known values, limits, units, directions.

#include "coupling/lift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/near_wall.hpp"

using namespace puffin::coupling;
using Eigen::Vector3d;

namespace {
constexpr Air air{1.204, 1.82e-5};
}

// Slow: C -> 1, F = 1.615 mu d |slip| sqrt(d^2 G/nu). At Re = 1e-3 exp(-Re/10) is 1 within 1e-4.
TEST(Lift, SlowShearIsSaffmans) {
  const double d = 10e-6, g = 200.0, u = 1e-3 * air.viscosity / air.density / d;
  const Vector3d lift = saffman_mei_lift(air, d, {u, 0, 0}, {0, 0, -g});
  const double expected = 1.615 * air.viscosity * d * u * std::sqrt(d * d * g * air.density / air.viscosity);
  EXPECT_NEAR(lift.y(), expected, 1e-3 * expected);
  EXPECT_EQ(lift.x(), 0.0);
}

// u = G y e_x: a carrier that lags (slip > 0) goes to the fast side (+y), one that leads to the slow side.
TEST(Lift, ALaggingCarrierGoesToTheFasterSide) {
  EXPECT_GT(saffman_mei_lift(air, 70e-6, {1, 0, 0}, {0, 0, -1e3}).y(), 0.0);
  EXPECT_LT(saffman_mei_lift(air, 70e-6, {-1, 0, 0}, {0, 0, -1e3}).y(), 0.0);
}

// Mei (1992): at b = 0.1 and Re = 10, C = (1 - 0.3314 sqrt 0.1) e^-1 + 0.3314 sqrt 0.1 = 0.43412; at Re = 80, 0.0524
// sqrt(8) = 0.14821.
TEST(Lift, MeisFactorHasItsTabledValues) {
  for (const auto& [re, factor] : {std::pair{10.0, 0.43412}, {80.0, 0.14821}}) {
    const double d = 70e-6, u = re * air.viscosity / air.density / d, w = 0.1 * 2.0 * u / d;
    const double saffman = 1.615 * d * d * std::sqrt(air.density * air.viscosity / w) * u * w;
    EXPECT_NEAR(saffman_mei_lift(air, d, {u, 0, 0}, {0, 0, w}).norm() / saffman, factor, 1e-4);
  }
}

// Slow: Rubinow & Keller, pi/8 rho d^3 Omega x slip; the sphere spins about +z and moves along +x in still air, so that
// slip and relative spin are both reversed: the force is along +y.
TEST(Lift, SlowSpinIsRubinowAndKellers) {
  const double d = 10e-6, u = 1e-4, w = 10.0;
  const Vector3d lift = magnus_lift(air, d, {-u, 0, 0}, {0, 0, -w});
  EXPECT_NEAR(lift.y(), std::numbers::pi / 8.0 * air.density * d * d * d * w * u, 1e-3 * lift.y());
}

TEST(Lift, SpinResistanceIsStokesAndContinuous) {
  const double d = 70e-6;
  EXPECT_NEAR(spin_resistance(air, d, 1.0), std::numbers::pi * air.viscosity * d * d * d, 1e-25);
  const double at = 32.0 * air.viscosity / (air.density * d * d);
  EXPECT_NEAR(spin_resistance(air, d, at * 1.0001) / spin_resistance(air, d, at * 0.9999), 1.0, 0.01);
}

// Metres to micrometres: density times 1e-18, viscosity 1e-6, lengths and speeds 1e6; forces (kg m/s^2) times 1e6.
TEST(Lift, DoesNotDependOnTheUnitOfLength) {
  const Air small{air.density * 1e-18, air.viscosity * 1e-6};
  const Vector3d slip(0.3, 0.1, -0.2), spin(100, 2000, -50);
  EXPECT_LT((saffman_mei_lift(small, 70.0, slip * 1e6, spin) * 1e-6 - saffman_mei_lift(air, 70e-6, slip, spin)).norm(),
            1e-20);
  EXPECT_LT((magnus_lift(small, 70.0, slip * 1e6, spin) * 1e-6 - magnus_lift(air, 70e-6, slip, spin)).norm(), 1e-20);
}

TEST(Lift, RotatesWithItsInput) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3d slip(0.3, 0.1, -0.2), spin(100, 2000, -50);
  EXPECT_LT(
      (turn * saffman_mei_lift(air, 7e-5, slip, spin) - saffman_mei_lift(air, 7e-5, turn * slip, turn * spin)).norm(),
      1e-20);
  EXPECT_LT((turn * magnus_lift(air, 7e-5, slip, spin) - magnus_lift(air, 7e-5, turn * slip, turn * spin)).norm(),
            1e-20);
}

TEST(Lift, NoShearAndNoSpinMakeNone) {
  EXPECT_EQ(saffman_mei_lift(air, 7e-5, {1, 0, 0}, {0, 0, 0}).norm(), 0.0);
  EXPECT_EQ(saffman_mei_lift(air, 7e-5, {0, 0, 0}, {0, 0, 1}).norm(), 0.0);
  EXPECT_EQ(magnus_lift(air, 7e-5, {1, 0, 0}, {0, 0, 0}).norm(), 0.0);
}

// Brenner's series (1961) at h/R = cosh 1 = 1.5431: 3.036; at cosh 0.5 = 1.1276: 9.252. The fit is within 1 %.
TEST(NearWall, ApproachIsBrenners) {
  EXPECT_NEAR(drag_towards_wall(0.5431), 3.0361, 0.015 * 3.0361);
  EXPECT_NEAR(drag_towards_wall(0.1276), 9.2518, 0.015 * 9.2518);
  EXPECT_NEAR(drag_towards_wall(1e-2) * 1e-2, 1.0, 0.05);  // 1/g near
  EXPECT_EQ(drag_towards_wall(0.0), drag_towards_wall(1e-3));
}

TEST(NearWall, SlidingIsFaxens) {
  EXPECT_NEAR(drag_along_wall(0.5), 1.0 / (1.0 - 0.28125 + 0.015625 - 0.0109863 - 0.00195313), 1e-6);
  EXPECT_EQ(drag_along_wall(0.0), 1.0);
  EXPECT_NEAR(drag_towards_wall(1e3), 1.0, 2e-3);
}
