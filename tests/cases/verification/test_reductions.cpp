// Every reduction, on a curve whose answer is known.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "cases/verification/reductions.hpp"

namespace puffin::cases {
namespace {

constexpr double pi = 3.14159265358979323846;

Points sample(double from, double to, int count, const std::function<double(double)>& f) {
  Points p;
  for (int i = 0; i < count; ++i) {
    p.x.push_back(from + (to - from) * i / (count - 1));
    p.y.push_back(f(p.x.back()));
  }
  return p;
}

// On a few points by hand: exact but for rounding.
TEST(Reductions, OfFewPointsAreThoseByHand) {
  const Points p{{0.0, 1.0, 3.0}, {2.0, 6.0, -2.0}};
  EXPECT_EQ(reduce(Reduction::first, p), 2.0);
  EXPECT_EQ(reduce(Reduction::last, p), -2.0);
  EXPECT_EQ(reduce(Reduction::mean, p), 2.0);
  EXPECT_EQ(reduce(Reduction::sum, p), 6.0);
  EXPECT_EQ(reduce(Reduction::count, p), 3.0);
  EXPECT_EQ(reduce(Reduction::minimum, p), -2.0);
  EXPECT_EQ(reduce(Reduction::maximum, p), 6.0);
  EXPECT_EQ(reduce(Reduction::range, p), 8.0);
  EXPECT_EQ(reduce(Reduction::integral, p), 4.0 + 4.0);
  EXPECT_EQ(reduce(Reduction::value, p, {.at = 2.0}), 2.0);
  EXPECT_EQ(reduce(Reduction::value, p, {.at = 3.0}), -2.0);
  EXPECT_EQ(reduce(Reduction::crossing, p, {.level = 4.0}), 0.5);
  EXPECT_EQ(reduce(Reduction::crossing, p), 2.5);
  EXPECT_EQ(reduce(Reduction::at_minimum, p), 3.0);
}

// A profile may be read from the lid downwards: the points are the same, in the other order.
TEST(Reductions, PointsMayFall) {
  const Points down{{3.0, 1.0, 0.0}, {-2.0, 6.0, 2.0}};
  EXPECT_EQ(reduce(Reduction::value, down, {.at = 2.0}), 2.0);
  EXPECT_EQ(reduce(Reduction::value, down, {.at = 0.0}), 2.0);
  EXPECT_EQ(reduce(Reduction::max_error, down, {.exact = {{0.5, 2.0}, {4.0, 2.5}}}), 0.5);
  EXPECT_THROW(reduce(Reduction::value, down, {.at = 3.1}), std::invalid_argument);
}

// The parabola through three points of a parabola is that parabola: exact but for rounding, on uneven points too.
TEST(Reductions, ParabolasAreFoundExactly) {
  const auto g = [](double x) { return -2.0 * (x - 0.3) * (x - 1.7); };
  EXPECT_NEAR(reduce(Reduction::quadratic_root, sample(0.4, 1.6, 9, g), {.at = 0.0}), 0.3, 1e-12);
  EXPECT_NEAR(reduce(Reduction::quadratic_root, sample(0.4, 1.6, 9, g), {.at = 2.0}), 1.7, 1e-12);
  const Points uneven{{0.5, 0.9, 1.5}, {g(0.5), g(0.9), g(1.5)}};
  EXPECT_NEAR(reduce(Reduction::at_maximum, uneven), 1.0, 1e-12);
}

TEST(Reductions, RatesOfExactCurvesAreExact) {
  EXPECT_NEAR(reduce(Reduction::slope, sample(0, 2, 7, [](double x) { return 3.0 * x - 1.0; })), 3.0, 1e-12);
  EXPECT_NEAR(reduce(Reduction::decay, sample(0, 2, 7, [](double x) { return -4.0 * std::exp(-1.5 * x); })), 1.5,
              1e-12);
  const auto wave = [](double x) { return 0.7 + 2.0 * std::cos(3.0 * x - 1.1); };
  EXPECT_NEAR(reduce(Reduction::amplitude, sample(0, 5, 40, wave), {.frequency = 3.0}), 2.0, 1e-12);
  EXPECT_NEAR(reduce(Reduction::phase, sample(0, 5, 40, wave), {.frequency = 3.0}), -1.1, 1e-12);
  // Linear between points 0.01 apart near a zero of the sine: 0.01^2/8 of curvature that is 0 there; mean of a whole
  // number of periods but for one point in 1257: 1e-3 of the amplitude moves all passages alike.
  EXPECT_NEAR(reduce(Reduction::period, sample(0, 4 * pi, 1257, [](double x) { return std::sin(2.0 * x + 1.0); })), pi,
              1e-5);
}

// A Gaussian's second moment is sigma^2; the trapezoid rule over +-8 sigma is exact to 1e-12.
TEST(Reductions, SpreadIsTheVariance) {
  const auto gauss = [](double x) { return 5.0 * std::exp(-(x - 0.2) * (x - 0.2) / (2.0 * 0.09)); };
  EXPECT_NEAR(reduce(Reduction::spread, sample(-2.2, 2.6, 400, gauss)), 0.09, 1e-10);
}

TEST(Reductions, ErrorsAreMeasuredAgainstTheExactCurve) {
  const Points p{{0.0, 1.0, 2.0}, {1.0, 2.0, 3.0}};
  EXPECT_NEAR(reduce(Reduction::l2_error, p, {.exact = {{}, {1.0, 2.0, 2.0}}}), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(reduce(Reduction::l2_error, p, {.exact = {{}, {0.0, 0.0, 0.0}}}), std::sqrt(14.0 / 3.0), 1e-15);
  EXPECT_NEAR(reduce(Reduction::max_error, p, {.exact = {{0.5, 1.5}, {1.5, 2.0}}}), 0.5, 1e-15);
  EXPECT_TRUE(std::isnan(reduce(Reduction::max_error, {{0.0, 1.0}, {std::nan(""), 1.0}}, {.exact = {{}, {1.0, 1.0}}})));
}

TEST(Reductions, AnOrderIsTheSlopeOfLogarithms) {
  EXPECT_NEAR(fitted_order({0.4, 0.2, 0.1}, {0.16, 0.04, 0.01}), 2.0, 1e-12);
  EXPECT_THROW(fitted_order({0.2, 0.1}, {0.1, 0.0}), std::invalid_argument);
}

TEST(Reductions, RefuseWhatTheyCannotDo) {
  const Points p{{0.0, 1.0}, {1.0, 2.0}};
  EXPECT_THROW(reduce(Reduction::value, p), std::invalid_argument);
  EXPECT_THROW(reduce(Reduction::value, p, {.at = 1.1}), std::invalid_argument);
  EXPECT_THROW(reduce(Reduction::mean, {}), std::invalid_argument);
  EXPECT_THROW(reduce(Reduction::crossing, p, {.level = 5.0}), std::invalid_argument);
  EXPECT_THROW(reduce(Reduction::amplitude, p, {.frequency = 1.0}), std::invalid_argument);
  EXPECT_THROW(reduce(Reduction::l2_error, p), std::invalid_argument);
  EXPECT_THROW(reduce(Reduction::period, p), std::invalid_argument);
}

// 400 points that alternate between -1 and 1: every batch of 20 has mean 0. A step half way: no batches agree.
// A sinusoid of 40 points a period, 10 periods: the 20 batches have means +-2/pi in turn, whose lag correlation is
// negative and does not widen: t(0.975, 19) s/sqrt(20) with s = 2/pi sqrt(20/19), t = 2.093 within 0.2 %; the mean of
// 20 points of a half period is 2/pi to (pi/20)^2/24 = 0.1 %.
TEST(Reductions, HalfWidthOfTheMeanIsThatOfBatchMeans) {
  Points p;
  for (int i = 0; i < 400; ++i) {
    p.x.push_back(i);
    p.y.push_back(i % 2 == 0 ? 1.0 : -1.0);
  }
  EXPECT_NEAR(reduce(Reduction::mean_half_width, p), 0.0, 1e-14);
  for (int i = 0; i < 400; ++i) p.y[static_cast<std::size_t>(i)] = std::sin(2.0 * pi * (i + 0.5) / 40.0);
  EXPECT_NEAR(reduce(Reduction::mean_half_width, p), 2.093 * 2.0 / pi / std::sqrt(19.0), 0.003 * 0.306);
  p.y.resize(5), p.x.resize(5);
  EXPECT_TRUE(std::isnan(reduce(Reduction::mean_half_width, p)));
}

}  // namespace
}  // namespace puffin::cases
