#include <gtest/gtest.h>

#include "coupling/scale.hpp"

namespace {
using puffin::coupling::Scale;

// Expected values by hand: dx = 0.2 mm, dt = 4e-7 s, rho = 1.2 kg/m^3, so one lattice speed is 500 m/s. A product of at
// most six rounded factors is within 6 * 2^-53 of the value, relative; DOUBLE_EQ allows 4 units in the last place, NEAR
// 1e-14.
const Scale scale{2e-4, 4e-7, 1.2};

TEST(Scale, OneLatticeSpeedIsDxOverDt) {
  EXPECT_DOUBLE_EQ(scale.speed(), 500.0);
  EXPECT_DOUBLE_EQ(scale.velocity_lu(50.0), 0.1);
}

TEST(Scale, GravityOnACellOfAirIsItsAccelerationInLatticeUnits) {
  const double weight = scale.cell_mass() * 9.81;  // [N]
  EXPECT_NEAR(scale.force_lu(weight) / scale.acceleration_lu(9.81), 1.0, 1e-14);
}

TEST(Scale, AForceDensityEqualsTheForceOnACell) {
  const double volume = scale.dx * scale.dx * scale.dx;
  EXPECT_NEAR(scale.force_density_lu(3.0) / scale.force_lu(3.0 * volume), 1.0, 1e-14);
}

TEST(Scale, PressureIsTheSquaredSpeedOfSoundTimesTheDensity) {
  // c_s = 500 / sqrt(3) m/s; an excess of 1 % of 1.2 kg/m^3 gives 0.012 * 250000/3 = 1000 Pa.
  EXPECT_NEAR(scale.pressure(0.01), 1000.0, 1e-10);
  EXPECT_NEAR(scale.density_excess_lu(1000.0), 0.01, 1e-15);
}

TEST(Scale, ViscosityGivesTheRelaxationTime) {
  // nu dt/dx^2 = 1.5e-5 * 4e-7 / 4e-8 = 1.5e-4
  EXPECT_NEAR(scale.viscosity_lu(1.5e-5), 1.5e-4, 1e-18);
  EXPECT_NEAR(scale.relaxation_time(1.5e-5), 0.50045, 1e-15);
}

TEST(Scale, ConversionsThereAndBackReturnTheValue) {
  EXPECT_NEAR(scale.velocity(scale.velocity_lu(63.0)) / 63.0, 1.0, 1e-14);
  EXPECT_NEAR(scale.force(scale.force_lu(1e-6)) / 1e-6, 1.0, 1e-14);
  EXPECT_NEAR(scale.viscosity(scale.viscosity_lu(1.5e-5)) / 1.5e-5, 1.0, 1e-14);
  EXPECT_NEAR(scale.momentum() / (scale.force() * scale.dt), 1.0, 1e-14);
}
}  // namespace
