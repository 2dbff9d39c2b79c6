// The speed of air that a force, a pressure or its start moves.

#include "cases/undriven_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/assessment.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

/// Plates 1 mm apart, 2 mm long: 4 volume/wall area = 2 mm.
Case plates(const std::string& air, const std::string& ends, const std::string& stop) {
  return parse_case(
      "schema = 1\nname = \"plates\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\nx = \"2 mm\"\ny = \"0.5 mm\"\n"
      "z = \"1 mm\"\n[air]\ndensity = 1.2\nviscosity = 1.8e-5\n" +
          air + "\n[[air.boundary]]\npatch = \"y-min\"\ntype = \"periodic\"\nwith = \"y-max\"\n" + ends +
          "[numerics]\ndx = \"0.1 mm\"\n[stop]\ntime = \"" + stop + "\"\n",
      "plates.toml");
}
const std::string periodic = "[[air.boundary]]\npatch = \"x-min\"\ntype = \"periodic\"\nwith = \"x-max\"\n";
const std::string pressures =
    "[[air.boundary]]\npatch = \"x-min\"\ntype = \"pressure-outlet\"\npressure = \"0.3 Pa\"\n"
    "[[air.boundary]]\npatch = \"x-max\"\ntype = \"pressure-outlet\"\n";

// Laminar G D^2/(32 mu) = 100 * 4e-6/5.76e-4 = 0.694 m/s; turbulent sqrt(2 * 1e5 * 2e-3/0.036) = 105 m/s, where laminar
// were 694; in 1 ms no more than G t/rho = 0.0833 m/s. Exact but for rounding.
TEST(UndrivenSpeed, OfABodyForceIsTheLeastOfFrictionAndInertia) {
  const auto speed = [](const std::string& force, const std::string& stop) {
    const Case c = plates("body_force = [" + force + ", 0.0, 0.0]", periodic, stop);
    return estimated_speed(c, load_surface(c)).value;
  };
  EXPECT_NEAR(speed("100.0", "1 s"), 400e-6 / 5.76e-4, 1e-9);
  EXPECT_NEAR(speed("1e5", "1 s"), std::sqrt(400.0 / 0.036), 1e-6);
  EXPECT_NEAR(speed("100.0", "1 ms"), 0.1 / 1.2, 1e-9);
  Case still = plates("body_force = [100.0, 0.0, 0.0]", periodic, "1 s");
  still.air.body_force = Vec3(0.0, 0.0, 0.0);
  EXPECT_EQ(estimated_speed(still, load_surface(still)).value, 0.0);
}

// 0.3 Pa over 2 mm: 150 N/m^3, laminar 1.042 m/s; Bernoulli allows sqrt(0.6/1.2) = 0.707 m/s.
TEST(UndrivenSpeed, OfPressuresApartIsAtMostBernoullis) {
  Case c = plates("", pressures, "1 s");
  EXPECT_NEAR(estimated_speed(c, load_surface(c)).value, std::sqrt(0.5), 1e-9);
  c.air.boundaries[1].pressure = 0.03;
  EXPECT_NEAR(estimated_speed(c, load_surface(c)).value, 15.0 * 4e-6 / 5.76e-4, 1e-9);
}

TEST(UndrivenSpeed, IsTakenWhereTheCaseGivesNoneAndIsTold) {
  const Case c = plates("body_force = [100.0, 0.0, 0.0]", periodic, "1 s");
  const Assessment a = assess(c, load_surface(c));
  EXPECT_NEAR(a.reference_speed, 400e-6 / 5.76e-4, 1e-9);
  ASSERT_FALSE(a.warnings.empty());
  EXPECT_NE(a.warnings[0].find("0.694 m/s is taken as reference_speed, from the body force"), std::string::npos)
      << a.warnings[0];
}

}  // namespace
}  // namespace puffin::cases
