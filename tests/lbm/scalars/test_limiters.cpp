#include <gtest/gtest.h>

#include <cmath>

#include "lbm/scalars/limiters.hpp"

namespace puffin::lbm {
namespace {

template <class Limiter>
class Limiters : public testing::Test {};
using All = testing::Types<Upwind, Minmod, VanLeer, MonotonizedCentral>;
TYPED_TEST_SUITE(Limiters, All);

TYPED_TEST(Limiters, are_flat_at_an_extremum) {
  EXPECT_EQ(TypeParam::slope(1.0, -0.5), 0.0);
  EXPECT_EQ(TypeParam::slope(-2.0, 0.5), 0.0);
  EXPECT_EQ(TypeParam::slope(0.0, 1.0), 0.0);
  EXPECT_EQ(TypeParam::slope(0.0, 0.0), 0.0);
}

TYPED_TEST(Limiters, stay_within_twice_the_smaller_difference_and_mirror) {
  for (const double a : {1e-9, 0.1, 1.0, 3.0})
    for (const double b : {1e-9, 0.2, 1.0, 10.0}) {
      const double s = TypeParam::slope(a, b);
      EXPECT_GE(s, 0.0);
      EXPECT_LE(s, 2.0 * std::min(a, b));
      EXPECT_EQ(TypeParam::slope(-a, -b), -s);
      EXPECT_EQ(TypeParam::slope(b, a), s);
    }
}

TEST(Limiter, second_order_ones_are_exact_on_a_straight_line) {
  EXPECT_DOUBLE_EQ(Minmod::slope(0.3, 0.3), 0.3);
  EXPECT_DOUBLE_EQ(VanLeer::slope(0.3, 0.3), 0.3);
  EXPECT_DOUBLE_EQ(MonotonizedCentral::slope(0.3, 0.3), 0.3);
}

// A thin cloud has a slope too, where the product of two differences would be 0 in float.
TEST(Limiter, know_small_differences_of_float) {
  EXPECT_FLOAT_EQ(Minmod::slope(1e-25f, 3e-25f), 1e-25f);
  EXPECT_FLOAT_EQ(VanLeer::slope(1e-25f, 3e-25f), 1.5e-25f);
  EXPECT_FLOAT_EQ(MonotonizedCentral::slope(1e-25f, 2e-25f), 1.5e-25f);
  EXPECT_EQ(MonotonizedCentral::slope(1e-25f, -2e-25f), 0.0f);
}

TEST(Limiter, have_their_known_values) {
  EXPECT_DOUBLE_EQ(Minmod::slope(1.0, 3.0), 1.0);
  EXPECT_DOUBLE_EQ(VanLeer::slope(1.0, 3.0), 1.5);
  EXPECT_DOUBLE_EQ(MonotonizedCentral::slope(1.0, 2.0), 1.5);
  EXPECT_DOUBLE_EQ(MonotonizedCentral::slope(1.0, 5.0), 2.0);
}

}  // namespace
}  // namespace puffin::lbm
