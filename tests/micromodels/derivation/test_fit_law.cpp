#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "micromodels/continuity.hpp"
#include "micromodels/derivation/fit_law.hpp"

namespace puffin::micromodels::derivation {
namespace {

std::vector<Point> sampled(const auto& law, double from, double to, int count) {
  std::vector<Point> points;
  for (int n = 0; n < count; ++n) {
    const double v = from * std::pow(to / from, n / (count - 1.0));
    points.push_back({v, law.value(v), 1.0});
  }
  return points;
}

TEST(FitPower, returns_the_constants_of_exact_data) {
  // No noise: the solver stops at a relative change of 1e-12; forward differences leave some 1e-7 in the powers.
  const PowerLaw law({0.01, 1.0, 2.0, 0.02, 0.5});
  const PowerFit fit = fit_power(sampled(law, 0.3, 30.0, 25));
  EXPECT_NEAR(fit.A[0].value, 0.01, 1e-8);
  EXPECT_NEAR(fit.A[1].value, 1.0, 1e-6);
  EXPECT_NEAR(fit.A[3].value, 0.02, 1e-8);
  EXPECT_NEAR(fit.A[4].value, 0.5, 1e-6);
  EXPECT_LE(fit.A[2].low, 2.0);  // a law that jumps there: no more than the two neighbours is known
  EXPECT_GE(fit.A[2].high, 2.0);
  EXPECT_LE(fit.A[2].high / fit.A[2].low, std::pow(100.0, 1.0 / 24.0) * (1.0 + 1e-12));
}

TEST(FitPower, finds_where_branches_meet) {
  // 0.05 v^2 and 0.1 v meet at v = 2.
  const PowerFit fit = fit_power(sampled(PowerLaw({0.05, 2.0, 2.0, 0.1, 1.0}), 0.5, 9.0, 12));
  EXPECT_NEAR(fit.A[2].value, 2.0, 1e-5);
  EXPECT_NEAR(jump(Law(fit.law())).height, 0.0, 1e-5);
}

TEST(FitPower, a_law_that_begins_at_a_threshold_has_a_lower_branch_of_zero) {
  const PowerFit fit = fit_power(sampled(PowerLaw({0.0, 1.0, 3.0, 0.1, 0.5}), 1.0, 20.0, 20));
  EXPECT_EQ(fit.A[0].value, 0.0);
  EXPECT_NEAR(fit.A[3].value, 0.1, 1e-7);
}

TEST(FitPower, its_intervals_hold_the_truth_as_often_as_they_say) {
  // 95 % intervals: of 300 trials 285 expected, standard deviation sqrt(300 0.95 0.05) = 3.8; the choice of the switch
  // is not in the intervals of the powers, so they may be a little short: 5 deviations below.
  const PowerLaw law({0.02, 1.5, 3.0, 0.06, 0.5});
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 0.002);
  int inside = 0;
  for (int trial = 0; trial < 300; ++trial) {
    auto points = sampled(law, 0.6, 20.0, 24);
    for (Point& p : points) p.fraction = std::max(0.0, p.fraction + noise(random));
    const Estimate e = fit_power(points).A[4];
    inside += e.low <= 0.5 && 0.5 <= e.high;
  }
  EXPECT_GE(inside, 285 - 19);
  EXPECT_LE(inside, 299);  // nor are they wide beyond use
}

TEST(FitPower, does_not_depend_on_the_unit_of_speed) {
  const PowerLaw law({0.01, 1.0, 2.0, 0.02, 0.5});
  auto points = sampled(law, 0.3, 30.0, 25);
  for (Point& p : points) p.speed *= 1000.0;
  const PowerFit fit = fit_power(points);
  EXPECT_NEAR(fit.A[4].value, 0.5, 1e-6);
  EXPECT_NEAR(fit.A[3].value, 0.02 / std::sqrt(1000.0), 1e-8);
}

TEST(FitWeibull, returns_the_constants_of_exact_data) {
  const WeibullLaw law({0.8, 3.0, 0.7, 2.84e-10, 1e-10});
  const WeibullFit fit = fit_weibull(sampled(law, 0.2, 10.0, 20), 2.84e-10, 1e-10, false);
  EXPECT_NEAR(fit.limit.value, 0.8, 1e-5);
  EXPECT_NEAR(fit.energy_ratio.value, 3.0, 1e-4);
  EXPECT_NEAR(fit.shape.value, 0.7, 1e-5);
}

TEST(FitWeibull, can_be_told_that_everything_comes_off) {
  const WeibullLaw law({1.0, 5.0, 1.2, 2.84e-10, 1e-10});
  const WeibullFit fit = fit_weibull(sampled(law, 0.3, 4.0, 12), 2.84e-10, 1e-10, true);
  EXPECT_EQ(fit.limit.value, 1.0);
  EXPECT_NEAR(fit.energy_ratio.value, 5.0, 1e-4);
}

TEST(Fits, refuse_nonsense) {
  const auto good = sampled(PowerLaw({0.01, 1.0, 2.0, 0.02, 0.5}), 0.3, 30.0, 8);
  EXPECT_THROW(fit_power(std::span(good).first(4)), std::invalid_argument);
  auto bad = good;
  bad[3].fraction = -0.1;
  EXPECT_THROW(fit_power(bad), std::invalid_argument);
  bad = good;
  std::swap(bad[1], bad[2]);
  EXPECT_THROW(fit_power(bad), std::invalid_argument);
  bad = good;
  bad[0].error = 0.0;
  EXPECT_THROW(fit_power(bad), std::invalid_argument);
  EXPECT_THROW(fit_weibull(good, 0.0, 1.0, false), std::invalid_argument);
}

TEST(LeastSquares, a_short_first_step_stays_where_the_residual_is_felt) {
  // 0.02 e^x = 0.3 at x = ln 15. The tangent at 0 leads to x = 14, where the residual is 0.2 however x changes.
  const auto residual = [](const Eigen::VectorXd& x, Eigen::VectorXd& r) {
    r[0] = std::min(0.02 * std::exp(x[0]), 0.5) - 0.3;
  };
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(1);
  EXPECT_NEAR(least_squares(residual, 1, start, 1.0).x[0], std::log(15.0), 1e-9);
  EXPECT_NEAR(least_squares(residual, 1, start).sum_of_squares, 0.04, 1e-9) << "else a short step has no reason";
}

TEST(Student, is_the_tabulated_quantile) {
  // Abramowitz & Stegun table 26.10.
  EXPECT_NEAR(student_95(3), 3.182, 0.01);
  EXPECT_NEAR(student_95(5), 2.571, 0.002);
  EXPECT_NEAR(student_95(10), 2.228, 0.001);
  EXPECT_NEAR(student_95(100), 1.984, 0.001);
}

}  // namespace
}  // namespace puffin::micromodels::derivation
