// The step that a lattice takes so that its density hardly answers the pressures that a case wants; the air at the
// start.

#include "cases/compressibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "cases/initial_air.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

/// A duct 1 mm x 1 mm x 20 mm of air, 0.1 m/s: Re = 1.2 * 0.1 * 0.001/1.8e-5 = 6.7.
Case narrow_duct() {
  return parse_case(
      "schema = 1\nname = \"narrow\"\n[geometry]\ngenerator = \"duct\"\n[geometry.duct]\nlength = \"20 mm\"\n"
      "width = \"1 mm\"\nheight = \"1 mm\"\n[air]\ndensity = 1.2\nviscosity = 1.8e-5\n"
      "[[air.boundary]]\npatch = \"inlet\"\ntype = \"velocity-inlet\"\nvelocity = \"0.1 m/s\"\n"
      "[[air.boundary]]\npatch = \"outlet\"\ntype = \"pressure-outlet\"\n"
      "[numerics]\ndx = \"0.2 mm\"\n[stop]\ntime = \"1 ms\"\n",
      "narrow.toml");
}

// 8 mu U/D = 0.0144 Pa on 80 mm^2 of wall over 1 mm^2 of inlet: 1.152 Pa. At 0.1 for 0.1 m/s the density would change
// by 3 * 1.152/1.2 * 1 = 2.88; half a per cent wants 0.1 sqrt(0.005/2.88). Exact but for rounding.
TEST(Compressibility, FrictionLowersTheLatticeSpeedAndIsTold) {
  const Case c = narrow_duct();
  const Surface s = load_surface(c);
  EXPECT_NEAR(expected_pressure_difference(c, s, 0.1), 1.152, 1e-9);
  const LatticeSpeed speed = lattice_speed(c, s, 0.1);
  EXPECT_NEAR(speed.value, 0.1 * std::sqrt(0.005 / 2.88), 1e-9);
  EXPECT_NE(speed.warning.find("1.15 Pa"), std::string::npos) << speed.warning;
  EXPECT_NE(speed.warning.find("the run takes 0.00417"), std::string::npos) << speed.warning;
}

// Creeping flow at 1 mm/s, nothing to compress it: tau = 1/2 + 3 nu u_lb/(U dx) = 1/2 + 3 1.5e-5/(0.001 2e-4) 0.1 = 23;
// tau 1 wants u_lb = 0.5/225. As it was, drag in an array of spheres came out at half of what it is.
TEST(Compressibility, CreepingFlowTakesARelaxationTimeOfOne) {
  Case c = narrow_duct();
  c.air.boundaries.clear();
  const LatticeSpeed speed = lattice_speed(c, load_surface(c), 0.001);
  EXPECT_NEAR(speed.value, 0.5 / 225.0, 1e-12);
  EXPECT_NE(speed.warning.find("tau = 23 "), std::string::npos) << speed.warning;
}

TEST(Compressibility, ASpeedThatIsLowEnoughStays) {
  Case c = narrow_duct();
  c.numerics.lattice_speed = 0.004;
  const LatticeSpeed speed = lattice_speed(c, load_surface(c), 0.1);
  EXPECT_EQ(speed.value, 0.004);
  EXPECT_EQ(speed.warning, "");
}

// 60 m/s: Re 4000 is no laminar friction; the pressures are of the order of rho U^2.
TEST(Compressibility, ATurbulentInletKeepsItsSpeed) {
  Case c = narrow_duct();
  c.air.boundaries[0].flow = MeanSpeed{60.0};
  EXPECT_EQ(lattice_speed(c, load_surface(c), 60.0).value, c.numerics.lattice_speed);
}

// Plates 1 mm apart, 2 mm of them between periodic sides, 20 mm long: D = 4 * 2 mm^2/(4 mm of edge) = 2 mm, 80 mm^2 of
// wall over 2 mm^2: 8 * 1.8e-5 * 0.1/0.002 * 40 = 0.288 Pa. Slip walls do not rub.
TEST(Compressibility, OnlyWallsRub) {
  const auto boundary = [](const std::string& patch, const std::string& more) {
    return "[[air.boundary]]\npatch = \"" + patch + "\"\ntype = \"" + more + "\"\n";
  };
  Case c = parse_case(
      "schema = 1\nname = \"plates\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\n"
      "x = \"20 mm\"\ny = \"2 mm\"\nz = \"1 mm\"\n[air]\ndensity = 1.2\nviscosity = 1.8e-5\n" +
          boundary("x-min", "velocity-inlet\"\nvelocity = \"0.1 m/s") + boundary("x-max", "pressure-outlet") +
          boundary("y-min", "periodic\"\nwith = \"y-max") + "[numerics]\ndx = \"0.2 mm\"\n[stop]\ntime = \"1 ms\"\n",
      "plates.toml");
  EXPECT_NEAR(expected_pressure_difference(c, load_surface(c), 0.1), 0.288, 1e-9);
  for (const char* patch : {"z-min", "z-max"}) {
    Boundary plate;
    plate.patch = patch, plate.type = BoundaryType::slip;
    c.air.boundaries.push_back(plate);
  }
  EXPECT_EQ(expected_pressure_difference(c, load_surface(c), 0.1), 0.0);
  EXPECT_EQ(lattice_speed(c, load_surface(c), 0.1).value, c.numerics.lattice_speed);
}

TEST(Compressibility, PressuresGivenAtTwoOpeningsCount) {
  Case c = narrow_duct();
  c.air.boundaries[0].type = BoundaryType::pressure_outlet;
  c.air.boundaries[0].pressure = 5.0;
  c.air.boundaries[1].pressure = -1.0;
  EXPECT_EQ(expected_pressure_difference(c, load_surface(c), 0.1), 6.0);
  EXPECT_EQ(expected_pressure_difference(c, load_surface(c), 60.0), 0.0);  // Re 4000: some rho U^2, as everywhere
}

// dt = 1e-4 s is 0.05 in lattice units at 0.1 m/s and 0.2 mm: 72 % of the density. The user's step stays.
TEST(Compressibility, AStepGivenInSecondsStaysWithAWarning) {
  Case c = narrow_duct();
  c.numerics.time_step = TimeStepRule::given;
  c.numerics.time_step_seconds = 1e-4;
  const LatticeSpeed speed = lattice_speed(c, load_surface(c), 0.1);
  EXPECT_EQ(speed.value, c.numerics.lattice_speed);
  EXPECT_NE(speed.warning.find("by 72 %"), std::string::npos) << speed.warning;
}

// 3 and 5 Pa have 3 in common, -3 and -5 Pa -3, -3 and 5 nothing, no outlet nothing.
TEST(Compressibility, OutletsHaveThePressureNearestToZeroInCommon) {
  const auto common = [](std::initializer_list<double> pressures) {
    Case c;
    for (const double p : pressures) {
      Boundary b;
      b.type = BoundaryType::pressure_outlet, b.pressure = p;
      c.air.boundaries.push_back(b);
    }
    return common_pressure(c);
  };
  EXPECT_EQ(common({3.0, 5.0}), 3.0);
  EXPECT_EQ(common({-5.0, -3.0}), -3.0);
  EXPECT_EQ(common({-3.0, 5.0}), 0.0);
  EXPECT_EQ(common({}), 0.0);
}

// Momentum: rho (u . grad) u = -grad p exactly, by central differences of 1e-4 of the box; and no divergence.
TEST(InitialAir, TaylorGreenInARectangleAndASlabIsSteadyWithoutFriction) {
  Air air;
  air.density = 1.2, air.initial = InitialField::taylor_green, air.initial_velocity = {0.3, 0.0, 0.4};
  for (const Vec3& box : {Vec3(1.0, 2.0, 0.7), Vec3(1.0, 0.03, 2.0), Vec3(0.1, 1.0, 1.5)}) {
    const auto start = initial_air(air, Vec3(0.2, 0.0, -0.1), box);
    ASSERT_TRUE(start);
    const Vec3 x = Vec3(0.2, 0.0, -0.1) + box.cwiseProduct(Vec3(0.13, 0.29, 0.41));
    Eigen::Matrix3d gradient;
    Vec3 slope;
    for (int d = 0; d < 3; ++d) {
      const Vec3 h = 1e-4 * box[d] * Vec3::Unit(d);
      gradient.col(d) = (start->velocity(x + h) - start->velocity(x - h)) / (2.0 * h[d]);
      slope[d] = (start->pressure(x + h) - start->pressure(x - h)) / (2.0 * h[d]);
    }
    const Vec3 inertia = air.density * gradient * start->velocity(x);
    EXPECT_GT(inertia.norm(), 0.05) << box.transpose();
    EXPECT_NEAR((inertia + slope).norm(), 0.0, 1e-5 * inertia.norm()) << box.transpose();
    EXPECT_NEAR(gradient.trace(), 0.0, 1e-6 * gradient.norm()) << box.transpose();
  }
}

}  // namespace
}  // namespace puffin::cases
