// What a run says that it takes for granted about the air.

#include "cases/air_assumption.hpp"

#include <gtest/gtest.h>

namespace puffin::cases {
namespace {

Case with_an_inlet() {
  Case c;
  Boundary inlet;
  inlet.type = BoundaryType::velocity_inlet;
  c.air.boundaries = {inlet};
  return c;
}

}  // namespace

TEST(AirAssumption, SaysWhatTheCaseAsksFor) {
  Case c = with_an_inlet();
  EXPECT_EQ(air_assumption(c), "air: Smagorinsky large-eddy simulation, no turbulence at the inlet, no wall model");
  c.reference["FFE"] = 0.5;  // of anybody's device
  EXPECT_EQ(air_assumption(c), "air: Smagorinsky large-eddy simulation, no turbulence at the inlet, no wall model");
  c.reference["thesis.FFE"] = 0.5;
  EXPECT_EQ(
      air_assumption(c),
      "air: Smagorinsky large-eddy simulation, no turbulence at the inlet, no wall model; the founding study used "
      "a k-epsilon model");
  c.numerics.les = Les::vreman;
  c.numerics.wall_model = true;
  c.air.boundaries[0].turbulence = 0.05;
  EXPECT_EQ(air_assumption(c),
            "air: Vreman large-eddy simulation, synthetic turbulence at the inlet, with a wall model; the founding "
            "study used a k-epsilon model");
}

TEST(AirAssumption, ALaminarCaseHasNoTurbulenceModelAndAPeriodicOneNoInlet) {
  Case c;
  c.numerics.les = Les::none;
  EXPECT_EQ(air_assumption(c), "air: no turbulence model, the cells resolve the flow, no wall model");
}

TEST(AirAssumption, ADrySceneAndAFrozenFieldHaveNone) {
  Case c = with_an_inlet();
  c.air.model = AirModel::none;
  EXPECT_EQ(air_assumption(c), "");
  c.air.model = AirModel::frozen;
  EXPECT_EQ(air_assumption(c), "");
}

}  // namespace puffin::cases
