#include <gtest/gtest.h>

#include <cmath>

#include "micromodels/law.hpp"

namespace puffin::micromodels {
namespace {

TEST(PowerLaw, has_the_values_of_equation_2_8_on_both_branches) {
  const PowerLaw law({0.01, 2.0, 3.0, 0.02, 0.5});
  EXPECT_DOUBLE_EQ(law.value(2.0), 0.04);
  EXPECT_DOUBLE_EQ(law.value(4.0), 0.04);
  EXPECT_DOUBLE_EQ(law.value(3.0), 0.02 * std::sqrt(3.0));  // v >= A2 is the upper branch
}

TEST(PowerLaw, takes_nothing_at_rest) { EXPECT_EQ(PowerLaw({0.5, 0.3, 1.0, 0.5, 0.1}).value(0.0), 0.0); }

TEST(PowerLaw, reports_the_jump_between_its_branches) {
  EXPECT_DOUBLE_EQ(PowerLaw({0.01, 1.0, 2.0, 0.05, 0.0}).jump(), 0.03);
  // Continuous by construction: A3 = A0 A2^(A1 - A4). One rounding each in three factors.
  EXPECT_NEAR(PowerLaw({0.01, 2.0, 4.0, 0.01 * std::pow(4.0, 1.5), 0.5}).jump(), 0.0, 4 * 2.3e-16 * 0.16);
}

TEST(PowerLaw, asks_for_the_same_in_metres_and_in_micrometres) {
  // f(v) with v in um/s: A0' = A0 (1e-6)^A1, A2' = 1e6 A2, A3' = A3 (1e-6)^A4. pow is good to an ulp or two: 1e-14.
  const PowerLaw metres({0.03, 1.7, 2.5, 0.05, 0.6});
  const PowerLaw micrometres({0.03 * std::pow(1e-6, 1.7), 1.7, 2.5e6, 0.05 * std::pow(1e-6, 0.6), 0.6});
  for (const double v : {0.1, 1.0, 2.4, 2.6, 20.0})
    EXPECT_NEAR(micrometres.value(1e6 * v) / metres.value(v), 1.0, 1e-14);
}

TEST(PowerLaw, is_clipped_to_a_fraction_only_when_asked_for_one) {
  const Law law = PowerLaw({0.1, 1.0, 1e9, 0.0, 0.0});
  EXPECT_EQ(fraction(law, 50.0), 1.0);
  EXPECT_DOUBLE_EQ(rate(law, 50.0), 5.0);
}

TEST(PowerLaw, refuses_negative_constants_and_speeds) {
  EXPECT_THROW(PowerLaw({0.1, -1.0, 1.0, 0.1, 1.0}), std::invalid_argument);
  EXPECT_THROW(PowerLaw({0.1, 1.0, 1.0, NAN, 1.0}), std::invalid_argument);
  const Law law = PowerLaw({0.1, 1.0, 1.0, 0.1, 1.0});
  EXPECT_THROW(fraction(law, -1.0), std::invalid_argument);
  EXPECT_THROW(fraction(law, NAN), std::invalid_argument);
}

TEST(PowerLaw, says_where_it_is_valid) {
  const Law law = PowerLaw({0.1, 1.0, 1.0, 0.1, 1.0}, {0.5, 20.0});
  EXPECT_TRUE(valid(law).contains(1.0));
  EXPECT_FALSE(valid(law).contains(0.4));
  EXPECT_FALSE(valid(law).contains(21.0));
}

// 90^570 > 1e308: a share that overflows still takes nothing of no fines (inf times 0 would be no number).
TEST(PowerLaw, stays_finite_where_its_power_overflows) {
  const PowerLaw law({1.0, 1.0, 0.1, 1e-4, 570.0}, {0.0, 80.0});
  EXPECT_TRUE(std::isfinite(law.value(90.0)));
  EXPECT_EQ(law.value(90.0) * 0.0, 0.0);
  EXPECT_GT(law.value(90.0), 1.0);
}

// 0 v^A = 0 for every A, though v^A overflows (2^2000 > 1e308).
TEST(PowerLaw, takes_nothing_with_a_factor_of_zero_however_steep) {
  EXPECT_EQ(PowerLaw({0.0, 2000.0, 3.0, 0.0, 2000.0}).value(2.0), 0.0);
  EXPECT_EQ(PowerLaw({0.0, 2000.0, 3.0, 0.0, 2000.0}).value(4.0), 0.0);
  EXPECT_EQ(PowerLaw({0.0, 2000.0, 3.0, 0.0, 2000.0}).jump(), 0.0);
}

}  // namespace
}  // namespace puffin::micromodels
