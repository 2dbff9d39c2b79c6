#include <gtest/gtest.h>

#include "micromodels/continuity.hpp"

namespace puffin::micromodels {
namespace {

TEST(Continuity, a_power_law_reports_its_jump) {
  const Jump jump = micromodels::jump(PowerLaw({0.01, 1.0, 2.0, 0.02, 0.5}));
  EXPECT_EQ(jump.speed, 2.0);
  EXPECT_NEAR(jump.height, 0.02 * 1.4142135623730951 - 0.02, 1e-15);
}

TEST(Continuity, branches_that_meet_do_not_jump) {
  EXPECT_EQ(micromodels::jump(PowerLaw({0.05, 2.0, 2.0, 0.1, 1.0})).height, 0.0);
  EXPECT_EQ(micromodels::jump(PowerLaw({0.3, 1.0, 0.0, 0.2, 1.0})).height, 0.0);  // one branch alone
}

TEST(Continuity, other_laws_are_continuous) {
  EXPECT_EQ(micromodels::jump(TableLaw({0.0, 1.0}, {}, {0.0, 0.5})).height, 0.0);
  EXPECT_EQ(micromodels::jump(WeibullLaw({1.0, 1.0, 1.0, 1.0, 1.0})).height, 0.0);
}

}  // namespace
}  // namespace puffin::micromodels
