#include <gtest/gtest.h>

#include <cmath>

#include "micromodels/law.hpp"

namespace puffin::micromodels {
namespace {

TEST(TableLaw, returns_its_rows_and_is_linear_between_them) {
  const TableLaw law({1.0, 3.0}, {}, {0.1, 0.5});
  EXPECT_DOUBLE_EQ(law.value(1.0, head_on), 0.1);
  EXPECT_DOUBLE_EQ(law.value(2.0, head_on), 0.3);
  EXPECT_DOUBLE_EQ(law.value(3.0, head_on), 0.5);
}

TEST(TableLaw, goes_to_zero_at_rest_and_holds_its_last_value) {
  const TableLaw law({1.0, 3.0}, {}, {0.1, 0.5});
  EXPECT_EQ(law.value(0.0, head_on), 0.0);
  EXPECT_DOUBLE_EQ(law.value(0.5, head_on), 0.05);
  EXPECT_DOUBLE_EQ(law.value(100.0, head_on), 0.5);
}

TEST(TableLaw, is_exact_for_a_bilinear_function_of_speed_and_angle) {
  // f = v (1 + angle/90) / 100 is bilinear, so interpolation returns it to rounding.
  const auto f = [](double v, double a) { return v * (1.0 + a / 90.0) / 100.0; };
  const std::vector<double> v{0.0, 2.0, 7.0}, a{10.0, 45.0, 90.0};
  std::vector<double> values;
  for (const double x : v)
    for (const double y : a) values.push_back(f(x, y));
  const TableLaw law(v, a, values);
  for (const double x : {0.3, 2.0, 5.5, 7.0})
    for (const double y : {10.0, 33.0, 60.0, 90.0}) EXPECT_NEAR(law.value(x, y), f(x, y), 1e-15);
  EXPECT_NEAR(law.value(5.0, 3.0), f(5.0, 10.0), 1e-15);  // beyond the first angle: held
}

TEST(TableLaw, refuses_rows_out_of_order_and_falling_values) {
  EXPECT_THROW(TableLaw({}, {}, {}), std::invalid_argument);
  EXPECT_THROW(TableLaw({1.0, 1.0}, {}, {0.1, 0.2}), std::invalid_argument);
  EXPECT_THROW(TableLaw({2.0, 1.0}, {}, {0.1, 0.2}), std::invalid_argument);
  EXPECT_THROW(TableLaw({1.0, 2.0}, {}, {0.1}), std::invalid_argument);
  EXPECT_THROW(TableLaw({1.0, 2.0}, {}, {0.1, -0.1}), std::invalid_argument);
  EXPECT_THROW(TableLaw({0.0, 2.0}, {}, {0.1, 0.2}), std::invalid_argument);
  EXPECT_THROW(TableLaw({1.0, 2.0}, {}, {0.2, 0.1}), std::invalid_argument);
  EXPECT_NO_THROW(TableLaw({1.0, 2.0}, {}, {0.2, 0.1}, true));
}

}  // namespace
}  // namespace puffin::micromodels
