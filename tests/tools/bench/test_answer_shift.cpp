// What `puffin bench skip` makes of answers that moved.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tools/bench/answer_shift.hpp"
#include "tools/bench/median.hpp"

namespace puffin::bench {
namespace {

// FFE scatters by 0.1, FFW by 1e-3: three fillings each.
const std::vector<Answers> fillings{
    {{"FFE", 0.5}, {"FFW", 0.200}}, {{"FFE", 0.6}, {"FFW", 0.201}}, {{"FFE", 0.7}, {"FFW", 0.202}}};

/// All fillings with FFE and FFW moved.
std::vector<Answers> moved(double FFE, double FFW) {
  std::vector<Answers> runs = fillings;
  for (Answers& run : runs) run["FFE"] += FFE, run["FFW"] += FFW;
  return runs;
}

TEST(AnswerShift, WhatIsComparedOfARun) {
  std::map<std::string, double> numbers{{"fines.drug.FFE", 0.6},
                                        {"fines.drug.in_air", 0.1},
                                        {"fines.drug.by_mechanism.wall", 0.2},
                                        {"carriers.retained_fraction", 0.3},
                                        {"pressure.static_drop.mean", 2800.0}};
  EXPECT_EQ(answers_of(numbers, {}), (Answers{{"FFE", 0.6}, {"retained_fraction", 0.3}}));
  EXPECT_EQ(answers_of(numbers, {"pressure.static_drop.mean"}).at("pressure.static_drop.mean"), 2800.0);
  EXPECT_THROW(answers_of(numbers, {"pressure.drop"}), std::invalid_argument);
  numbers["fines.other.FFE"] = 0.5;
  EXPECT_EQ(answers_of(numbers, {}, "other").at("FFE"), 0.5);
  EXPECT_THROW(answers_of(numbers, {}), std::invalid_argument);
}

// s = 0.1 and 0.001; Student's t of two degrees of freedom for 95 %: 4.303 (any table).
TEST(AnswerShift, TheIntervalIsStudentsOfTheReplicates) {
  const Answers of_three = half_widths(fillings, 3), of_one = half_widths(fillings, 1);
  EXPECT_NEAR(of_three.at("FFE"), 4.303 * 0.1 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(of_three.at("FFW"), 4.303 * 0.001 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(of_one.at("FFE"), 4.303 * 0.1, 1e-12);
  EXPECT_EQ(half_widths({{{"x", 0.1}}, {{"x", 0.1}}, {{"x", 0.1}}}, 3).at("x"), 0.0) << "no scatter by rounding";
}

// A shift of FFW by twenty times its own scatter is one, however much FFE scatters.
TEST(AnswerShift, EachAnswerIsMeasuredByItsOwnInterval) {
  const Answers widths = half_widths(fillings, 3);
  const Shift shift = farthest_shift(fillings, moved(0.03, 0.02), widths, false);
  EXPECT_LT(0.02, widths.at("FFE")) << "it would hide in the widest interval";
  EXPECT_EQ(shift.answer, "FFW");
  EXPECT_NEAR(shift.change, 0.02, 1e-12);
  EXPECT_NEAR(shift.ratio, 0.02 / (4.303 * 0.001 / std::sqrt(3.0)), 1e-6);
  EXPECT_FALSE(shift.within);
}

TEST(AnswerShift, WhatStaysInsideIsWithin) {
  const Shift shift = farthest_shift(fillings, moved(0.1, -0.0005), half_widths(fillings, 3), false);
  EXPECT_TRUE(shift.within);
  EXPECT_EQ(shift.answer, "FFE") << "0.40 of its interval, FFW 0.20";
  EXPECT_NEAR(shift.ratio, std::sqrt(3.0) / 4.303, 1e-6);
}

TEST(AnswerShift, MeansAreComparedAndNotSingleRuns) {
  std::vector<Answers> turned{fillings[2], fillings[1], fillings[0]};  // the same runs in another order
  const Shift shift = farthest_shift(fillings, turned, half_widths(fillings, 3), false);
  EXPECT_NEAR(shift.change, 0.0, 1e-15);
  EXPECT_TRUE(shift.within);
  EXPECT_FALSE(farthest_shift(fillings, turned, half_widths(fillings, 3), true).within) << "but not exact";
}

TEST(AnswerShift, ExactMeansNoBitAndNoScatterLeavesNoRoom) {
  const Answers widths = half_widths(fillings, 3);
  EXPECT_TRUE(farthest_shift(fillings, fillings, widths, true).within);
  const Shift bit = farthest_shift(fillings, moved(1e-16, 0.0), widths, true);
  EXPECT_FALSE(bit.within);
  EXPECT_EQ(bit.answer, "FFE");
  const std::vector<Answers> all_stay{{{"kept", 1.0}}, {{"kept", 1.0}}}, one_goes{{{"kept", 1.0}}, {{"kept", 0.9}}};
  const Answers none = half_widths(all_stay, 2);
  EXPECT_TRUE(farthest_shift(all_stay, all_stay, none, false).within);
  const Shift shift = farthest_shift(all_stay, one_goes, none, false);
  EXPECT_FALSE(shift.within);
  EXPECT_TRUE(std::isinf(shift.ratio));
}

TEST(AnswerShift, WhatIsMissingIsNoAgreement) {
  const Answers widths = half_widths(fillings, 3);
  std::vector<Answers> lost = fillings;
  lost[1].erase("FFW");
  EXPECT_THROW(farthest_shift(fillings, lost, widths, false), std::invalid_argument);
  EXPECT_THROW(half_widths(lost, 3), std::invalid_argument);
  EXPECT_THROW(half_widths({fillings[0]}, 1), std::invalid_argument);
  EXPECT_THROW(farthest_shift(fillings, moved(0, 0), {}, false), std::invalid_argument);
}

TEST(AnswerShift, AMeanOverTimeHasAnIntervalOfItsOwn) {
  const std::map<std::string, double> numbers{
      {"p.drop.mean", 200.0}, {"p.drop.ci_low", 190.0}, {"p.drop.ci_high", 210.0}, {"q.mean", 1.0}};
  EXPECT_EQ(own_half_widths(numbers, {"p.drop.mean", "q.mean", "FFE"}, 4), (Answers{{"p.drop.mean", 5.0}}));
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({3.0, 1.0, 100.0}), 3.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 100.0}), 3.0);
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace puffin::bench
