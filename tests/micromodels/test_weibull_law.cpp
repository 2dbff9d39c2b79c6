#include <gtest/gtest.h>

#include <cmath>

#include "micromodels/law.hpp"

namespace puffin::micromodels {
namespace {

// M v^2/2 = adhesion energy x I0 at v = 2 m/s.
const WeibullLaw::Constants constants{0.8, 50.0, 1.3, 2.84e-10, 0.5 * 2.84e-10 * 4.0 / 50.0};

TEST(WeibullLaw, has_taken_one_minus_one_over_e_of_its_limit_at_the_scale_energy) {
  EXPECT_NEAR(WeibullLaw(constants).value(2.0), 0.8 * (1.0 - std::exp(-1.0)), 1e-15);
}

TEST(WeibullLaw, is_zero_at_rest_and_reaches_its_limit) {
  const WeibullLaw law(constants);
  EXPECT_EQ(law.value(0.0), 0.0);
  EXPECT_DOUBLE_EQ(law.value(100.0), 0.8);
}

TEST(WeibullLaw, is_a_straight_line_of_slope_two_k_in_weibull_coordinates) {
  // ln(-ln(1 - f/limit)) = k ln(I/I0), I ~ v^2. Rounding of f near 1 costs a few ulp of the logarithm: 1e-12.
  const WeibullLaw law(constants);
  const auto y = [&](double v) { return std::log(-std::log1p(-law.value(v) / 0.8)); };
  EXPECT_NEAR((y(2.5) - y(0.5)) / std::log(5.0), 2.0 * 1.3, 1e-12);
}

TEST(WeibullLaw, depends_on_the_ratio_of_the_energies_alone) {
  auto scaled = constants;
  scaled.carrier_mass *= 7.0;
  scaled.adhesion_energy *= 7.0;
  for (const double v : {0.1, 1.0, 5.0})
    EXPECT_NEAR(WeibullLaw(scaled).value(v), WeibullLaw(constants).value(v), 1e-14);
}

TEST(WeibullLaw, refuses_what_is_not_a_distribution) {
  for (double WeibullLaw::Constants::*member :
       {&WeibullLaw::Constants::limit, &WeibullLaw::Constants::energy_ratio, &WeibullLaw::Constants::shape,
        &WeibullLaw::Constants::carrier_mass, &WeibullLaw::Constants::adhesion_energy}) {
    auto bad = constants;
    bad.*member = 0.0;
    EXPECT_THROW(WeibullLaw{bad}, std::invalid_argument);
  }
  auto bad = constants;
  bad.limit = 1.01;
  EXPECT_THROW(WeibullLaw{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace puffin::micromodels
