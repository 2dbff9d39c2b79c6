#include "coupling/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace {
using namespace puffin::coupling;

/// x' = r x + noise: variance of a long mean is s^2 (1 + r)/(1 - r)/n with s^2 the variance of x.
std::vector<double> series(int count, double r, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, std::sqrt(1.0 - r * r));
  std::vector<double> x{std::normal_distribution<double>(0.0, 1.0)(random)};
  for (int n = 1; n < count; ++n) x.push_back(r * x.back() + normal(random));
  return x;
}

TEST(Statistics, StudentsQuantileIsThatOfTheTables) {
  // t(0.975, nu) from any table, three decimals; the expansion is good to 0.2 % for nu >= 3.
  EXPECT_NEAR(student_quantile(3), 3.182, 0.002 * 3.182);
  EXPECT_NEAR(student_quantile(7), 2.365, 0.001);
  EXPECT_NEAR(student_quantile(19), 2.093, 0.0006);
  EXPECT_NEAR(student_quantile(1000), 1.962, 0.0006);
}

TEST(Statistics, IntervalsCoverTheTrueMeanInNineteenOfTwentyRecords) {
  // 500 records: the covered part has a standard deviation of sqrt(0.95 * 0.05 / 500) = 1 %. Correlated samples with a
  // correlation time of (1 + r)/(1 - r) = 19 samples and pieces of 200: the pieces' correlation is about 5 %, whose
  // widening of the interval and remaining bias stay below 1.5 %. Tolerance 3 sigma + that.
  std::mt19937 random(11);
  for (const double r : {0.0, 0.9}) {
    int covered = 0;
    for (int n = 0; n < 500; ++n) {
      const auto x = series(4000, r, random);
      const TimeMean mean = batch_means(x, std::vector<double>(x.size(), 1e-6));
      covered += std::abs(mean.mean) <= mean.half_width;
    }
    EXPECT_NEAR(covered / 500.0, 0.95, 0.045) << r;
  }
}

TEST(Statistics, SamplesCountByTheirDuration) {
  // (1 * 1 + 2 * 3)/4; equal pieces of a constant have no spread.
  EXPECT_DOUBLE_EQ(batch_means(std::vector<double>{1.0, 2.0}, std::vector<double>{1.0, 3.0}).mean, 1.75);
  std::vector<double> value(100, 3.5), duration;
  for (int n = 0; n < 100; ++n) duration.push_back(1.0 + 0.03 * n);
  const TimeMean mean = batch_means(value, duration);
  EXPECT_NEAR(mean.mean, 3.5, 1e-14);
  EXPECT_NEAR(mean.half_width, 0.0, 1e-13);
  EXPECT_EQ(mean.batches, 20);
}

TEST(Statistics, ATrendWidensTheIntervalAndShowsInTheCorrelation) {
  // A straight line has batch means with a lag-1 correlation near 0.85 for 20 pieces: factor sqrt(1.85/0.15) = 3.5.
  std::vector<double> value(1000);
  std::iota(value.begin(), value.end(), 0.0);
  const TimeMean mean = batch_means(value, std::vector<double>(1000, 1.0));
  EXPECT_GT(mean.correlation, 0.7);
  EXPECT_GT(mean.half_width, 2.0 * 2.09 * 1000.0 / std::sqrt(12.0) / std::sqrt(20.0));
}

TEST(Statistics, TooFewSamplesGiveNoIntervalAndNonsenseIsRefused) {
  EXPECT_TRUE(std::isnan(batch_means(std::vector<double>(5, 1.0), std::vector<double>(5, 1.0)).half_width));
  EXPECT_EQ(batch_means(std::vector<double>(20, 1.0), std::vector<double>(20, 1.0)).batches, 10);
  EXPECT_THROW(batch_means({}, {}), std::invalid_argument);
  EXPECT_THROW(batch_means(std::vector<double>(3), std::vector<double>(2)), std::invalid_argument);
  EXPECT_THROW(batch_means(std::vector<double>{1.0}, std::vector<double>{-1.0}), std::invalid_argument);
}
}  // namespace
