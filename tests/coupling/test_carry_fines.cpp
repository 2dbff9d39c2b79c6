// How many air steps an update of the fines' transport covers.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/carry_fines.hpp"

namespace puffin::coupling {
namespace {

TEST(StepsPerUpdate, OneSubStepWhereAnExchangeFits) {
  EXPECT_EQ(steps_per_update(5.2, 5), 5.0);
  EXPECT_EQ(steps_per_update(14.9, 5), 14.0);  // rounded down to exchanges by carry_fines
  EXPECT_EQ(steps_per_update(1.3, 1), 1.0);
}

// Sub-steps an air step: 3.6 allowed: 2/5, 3/10, 5/15; 4.9: 2/5, 3/10, 4/15; 2.6: 2/5, 4/10, 6/15.
TEST(StepsPerUpdate, OtherwiseTheFewestSubStepsAnAirStep) {
  EXPECT_EQ(steps_per_update(3.6, 5), 10.0);
  EXPECT_EQ(steps_per_update(4.9, 5), 15.0);
  EXPECT_EQ(steps_per_update(2.6, 5), 5.0);
}

TEST(StepsPerUpdate, StaysWithin64StepsAndThreeExchanges) {
  EXPECT_EQ(steps_per_update(std::numeric_limits<double>::infinity(), 5), 64.0);
  for (double allowed = 0.05; allowed < 80.0; allowed *= 1.07)
    for (const int exchange : {1, 2, 5, 8, 33, 64}) {
      const double steps = steps_per_update(allowed, exchange);
      EXPECT_GE(steps, 1.0);
      EXPECT_LE(steps, 64.0);
      if (allowed < exchange) {
        EXPECT_EQ(std::fmod(steps, exchange), 0.0) << allowed << ' ' << exchange;
        EXPECT_LE(steps, 3.0 * exchange);
      }
    }
}

// Crank and Nicolson's weights hold up to n D = 1/2.
TEST(StepsDiffusionFollows, TheFastestScalar) {
  lbm::ScalarOptions options;
  options.scalar.resize(3);
  EXPECT_TRUE(std::isinf(steps_diffusion_follows(options)));
  options.scalar[1].diffusivity = 0.1;
  options.scalar[2].diffusivity = 0.01;
  EXPECT_DOUBLE_EQ(steps_diffusion_follows(options), 5.0);
  options.scalar[0].diffusivity = 40.0;
  EXPECT_EQ(steps_diffusion_follows(options), 1.0);
}

}  // namespace
}  // namespace puffin::coupling
