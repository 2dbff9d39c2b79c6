// How many air steps an update of the fines' transport covers.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/carry_fines.hpp"

namespace puffin::coupling {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity(), no_pair = 0.01;

TEST(StepsPerUpdate, OneSubStepWhereAnExchangeFits) {
  EXPECT_EQ(steps_per_update({14.9, no_pair}, endless, 5), 14.0);  // rounded down to exchanges by carry_fines
}

// Sweeps an air step: (2.5 + 3.5 n)/steps with n sub-steps. 5.2 allowed: 6/5, 9.5/10, 13/15; 3.6: 9.5/5, 13/10,
// 20/15; 4.9: 9.5/5, 13/10, 16.5/15.
TEST(StepsPerUpdate, OtherwiseTheFewestSweepsAnAirStep) {
  EXPECT_EQ(steps_per_update({5.2, no_pair}, endless, 5), 15.0);
  EXPECT_EQ(steps_per_update({3.6, no_pair}, endless, 5), 10.0);
  EXPECT_EQ(steps_per_update({4.9, no_pair}, endless, 5), 15.0);
}

// (2.5 + 5.5 n)/steps with n pairs: 8/10, 13.5/15 where a pair holds two exchanges, 8/15 where it holds three.
TEST(StepsPerUpdate, PairsWhereTheySave) {
  EXPECT_EQ(steps_per_update({5.2, 10.4}, endless, 5), 10.0);
  EXPECT_EQ(steps_per_update({5.2, 15.0}, endless, 5), 15.0);
}

// A flow that allows 60 in one sub-step; diffusion is followed over 7, or not even over one exchange.
TEST(StepsPerUpdate, NoLongerThanDiffusionFollows) {
  EXPECT_EQ(steps_per_update({60.0, 10.0}, 7.1, 5), 7.0);
  EXPECT_EQ(steps_per_update({60.0, 10.0}, 2.5, 5), 5.0);
  EXPECT_EQ(steps_per_update({5.2, 10.4}, 7.1, 5), 7.0);
}

TEST(StepsPerUpdate, StaysWithin64StepsAndThreeExchanges) {
  EXPECT_EQ(steps_per_update({1.3, no_pair}, endless, 64), 64.0);
  EXPECT_EQ(steps_per_update({endless, 10.0}, endless, 5), 64.0);
  EXPECT_EQ(steps_per_update({endless, endless}, endless, 5), 64.0);
  for (double allowed = 0.05; allowed < 80.0; allowed *= 1.07)
    for (const int exchange : {1, 2, 5, 8, 33, 64}) {
      const double steps = steps_per_update({allowed, 1.7 * allowed}, endless, exchange);
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
