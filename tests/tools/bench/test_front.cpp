// The front of run time against error.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tools/bench/front.hpp"

namespace puffin::bench {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Front, HoldsWhatNoOtherBeatsInBoth) {
  // fast and wrong, slow and right, both worse than the second, as fast as the first and worse
  const std::vector<CostAndError> settings{{1.0, 0.5, 0.0}, {4.0, 0.1, 0.0}, {5.0, 0.2, 0.0}, {1.0, 0.6, 0.0}};
  EXPECT_EQ(on_front(settings), (std::vector<bool>{true, true, false, false}));
}

TEST(Front, KeepsTies) {
  EXPECT_EQ(on_front({{1.0, 0.5, 0.0}, {1.0, 0.5, 0.0}}), (std::vector<bool>{true, true}));
  // the same error for more time is no tie
  EXPECT_EQ(on_front({{1.0, 0.5, 0.0}, {2.0, 0.5, 0.0}}), (std::vector<bool>{true, false}));
}

TEST(Front, LeavesOutWhatHasNoError) {
  EXPECT_EQ(on_front({{1.0, nan, 0.0}, {2.0, 0.5, 0.0}}), (std::vector<bool>{false, true}));
}

TEST(Front, AnyOrderGivesTheSameSettings) {
  const std::vector<CostAndError> settings{{3.0, 0.3, 0.0}, {1.0, 0.9, 0.0}, {2.0, 0.95, 0.0}, {9.0, 0.01, 0.0}};
  std::vector<CostAndError> reversed(settings.rbegin(), settings.rend());
  std::vector<bool> back = on_front(reversed);
  EXPECT_EQ(on_front(settings), std::vector<bool>(back.rbegin(), back.rend()));
}

// At the cost of each of: fast and wrong, slow and wrong, slower and right, and one that failed early.
TEST(BestForCost, IsTheMostAccurateThatCostsNoMore) {
  const std::vector<CostAndError> settings{{1.0, 0.5, 0.0}, {4.0, 0.6, 0.0}, {5.0, 0.1, 0.0}, {0.5, nan, 0.0}};
  EXPECT_EQ(best_for_cost(settings, 0), 0U);
  EXPECT_EQ(best_for_cost(settings, 1), 0U);
  EXPECT_EQ(best_for_cost(settings, 2), 2U);
  EXPECT_EQ(best_for_cost(settings, 3), 3U);  // nothing else is so cheap
}

TEST(BestForCost, OfEqualsIsTheFastestWhateverTheOrder) {
  EXPECT_EQ(best_for_cost({{2.0, 0.1, 0.0}, {1.0, 0.1, 0.0}}, 0), 1U);
  EXPECT_EQ(best_for_cost({{1.0, 0.1, 0.0}, {2.0, 0.1, 0.0}}, 1), 0U);
}

TEST(TimeOverFront, IsTheRatioToTheFastestThatIsNoLessAccurate) {
  const std::vector<CostAndError> settings{{10.0, 0.10, 0.0}, {8.0, 0.09, 0.0}, {1.0, 0.50, 0.0}};
  EXPECT_DOUBLE_EQ(time_over_front(settings, 0, false), 10.0 / 8.0);
  EXPECT_DOUBLE_EQ(time_over_front(settings, 1, false), 1.0);
}

TEST(TimeOverFront, LuckDoesNotCount) {
  // 0.09 +- 0.02 is not certainly more accurate than 0.10 +- 0.02; 0.02 +- 0.02 is (hypot(0.02, 0.02) = 0.028 < 0.08)
  std::vector<CostAndError> settings{{10.0, 0.10, 0.02}, {8.0, 0.09, 0.02}};
  EXPECT_DOUBLE_EQ(time_over_front(settings, 0, true), 1.0);
  settings.push_back({5.0, 0.02, 0.02});
  EXPECT_DOUBLE_EQ(time_over_front(settings, 0, true), 2.0);
}

}  // namespace
}  // namespace puffin::bench
