#include <gtest/gtest.h>

#include <cmath>

#include "cases/derived.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

Case l_bend_flow() {
  return test::parse(test::sample, {{"air.boundary[0].flow_rate", "[[0, 0], [0.24, '36 L/min'], [0.55, '40 L/min']]"},
                                    {"stop.time", "0.211"}});
}
const AreaOf inlet_area = [](const std::string&) { return 10.5e-6; };  // 1.5 x 7 mm

// The thesis's L inlet at 40 L/min: 63.49 m/s, Re 10380 on D_h = 2.471 mm.
TEST(Derived, InletSpeedOfTheLBend) {
  const Case c = l_bend_flow();
  EXPECT_NEAR(mean_speed(c.air.boundaries[0], 0.55, 10.5e-6), 63.49, 0.01);
  Air air;
  air.density = 1.204;
  air.viscosity = 1.82e-5;
  EXPECT_NEAR(reynolds(air, 63.49, 2.471e-3), 10380.0, 5.0);
}

// The flow at 211 ms is 36 * 211/240 L/min, the largest of the run; a later peak does not count.
TEST(Derived, ReferenceSpeedIsTheLargestUntilTheStop) {
  const Case c = l_bend_flow();
  const double expected = 36e-3 / 60.0 * 0.211 / 0.24 / 10.5e-6;
  EXPECT_NEAR(reference_speed(c, inlet_area), expected, 1e-12 * expected);
}

// dt = u_lb dx / U, tau = 1/2 + 3 nu dt/dx^2, Ma = sqrt(3) u_lb: exact up to rounding.
TEST(Derived, LatticeNumbersFollowTheirFormulas) {
  Case c = l_bend_flow();
  c.numerics.time_step = TimeStepRule::fixed;
  const LatticeNumbers n = lattice_numbers(c, 2.34e-4, 63.0, inlet_area);
  EXPECT_DOUBLE_EQ(n.dt, 0.1 * 2.34e-4 / 63.0);
  EXPECT_DOUBLE_EQ(n.tau, 0.5 + 3.0 * 1.8e-5 / 1.2 * n.dt / (2.34e-4 * 2.34e-4));
  EXPECT_DOUBLE_EQ(n.mach, std::sqrt(3.0) * 0.1);
  EXPECT_DOUBLE_EQ(n.steps, 0.211 / n.dt);
}

// With dt ~ 1/U up to 4 dt0 on a ramp 0 -> U over the whole run: 1/4 of the time at 1/4, then the integral of s from
// 1/4 to 1: 1/16 + 15/32 = 0.53125 of the fixed steps. Midpoints of 2000 samples: exact but for one cell with a kink.
TEST(Derived, FollowingTheRampSavesSteps) {
  Case c = l_bend_flow();
  const double reference = reference_speed(c, inlet_area);
  const LatticeNumbers n = lattice_numbers(c, 2.34e-4, reference, inlet_area);
  EXPECT_NEAR(n.steps / (c.stop.time / n.dt), 0.53125, 1e-6);
  EXPECT_DOUBLE_EQ(n.dt_largest, 4.0 * n.dt);
}

// Whatever speed the smallest step is sized for: the ratio of the steps is that of the inlet's speeds.
TEST(Derived, AReferenceSpeedThatIsGivenIsFollowedToo) {
  Case c = l_bend_flow();
  const double reference = reference_speed(c, inlet_area);
  const LatticeNumbers plain = lattice_numbers(c, 2.34e-4, reference, inlet_area);
  c.numerics.reference_speed = 2.0 * reference;
  const LatticeNumbers halved = lattice_numbers(c, 2.34e-4, 2.0 * reference, inlet_area);
  EXPECT_NEAR(halved.steps, 2.0 * plain.steps, 1e-9 * plain.steps);
  EXPECT_DOUBLE_EQ(halved.dt_largest, 0.5 * plain.dt_largest);
}

// The ramp is at 0 then: what moves the air is a lid, or air that moved at the start.
TEST(Derived, TheStepFollowsWhateverMovesTheAir) {
  Case c = l_bend_flow();
  const double ramp = 36e-3 / 60.0 * 0.1 / 0.24 / 10.5e-6;
  EXPECT_NEAR(followed_speed(c.air, 0.1, inlet_area), ramp, 1e-12 * ramp);
  EXPECT_DOUBLE_EQ(followed_speed(c.air, 0.0, inlet_area), 0.0);
  c.air.initial_velocity = {0.0, 3.0, 4.0};
  EXPECT_DOUBLE_EQ(followed_speed(c.air, 0.0, inlet_area), 5.0);
  Boundary lid;
  lid.patch = "lid";
  lid.type = BoundaryType::moving_wall;
  lid.flow = Velocity{{0.0, 7.0, 0.0}};
  c.air.boundaries.push_back(lid);
  EXPECT_DOUBLE_EQ(followed_speed(c.air, 0.0, inlet_area), 7.0);
}

TEST(Derived, CellSizeFromANumberOfCells) {
  Numerics n;
  EXPECT_THROW(cell_size(n, 1.0), std::invalid_argument);
  n.cells = 1000;
  EXPECT_NEAR(cell_size(n, 1e-9), 1e-4, 1e-18);
}

// A fine of 1/50000 of the carrier's mass at equal density has 1/36.84 of its diameter: 1.90 um.
TEST(Derived, FinesDiameter) {
  EXPECT_NEAR(fines_diameter(*test::parse(test::sample).carriers, 1520.0), 1.90e-6, 0.005e-6);
}

TEST(Derived, TimeTablesAreLinearBetweenAndConstantOutside) {
  const TimeTable t{{1.0, 3.0}, {10.0, 20.0}};
  EXPECT_EQ(t.at(0.0), 10.0);
  EXPECT_EQ(t.at(2.0), 15.0);
  EXPECT_EQ(t.at(9.0), 20.0);
}

}  // namespace
}  // namespace puffin::cases
