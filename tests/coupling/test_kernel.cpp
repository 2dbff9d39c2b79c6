#include "coupling/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {
using puffin::coupling::Kernel;
using puffin::coupling::roma;
using puffin::coupling::roma_variance;

struct Sums {
  double zeroth = 0.0, first = 0.0, second = 0.0;
};

/// Sums of the weights with powers of the distance to the carrier [cells].
Sums sums(const Kernel& kernel, double offset) {
  std::vector<double> w(2 * kernel.reach() + 1);
  kernel.weights(offset, w.data());
  Sums s;
  for (int j = -kernel.reach(); j <= kernel.reach(); ++j) {
    const double x = j - offset, weight = w[j + kernel.reach()];
    s.zeroth += weight;
    s.first += weight * x;
    s.second += weight * x * x;
  }
  return s;
}

/// Variance of the kernel averaged over all offsets: the continuous variance.
double variance(const Kernel& kernel) {
  const int samples = 1000;
  double sum = 0.0;
  for (int n = 0; n < samples; ++n) sum += sums(kernel, (n + 0.5) / samples - 0.5).second;
  return sum / samples;
}

TEST(Kernel, RomasKernelHasItsKnownValues) {
  // R(0) = 2/3, R(1/2) = 1/2, R(1) = 1/6, R(3/2) = 0 from eq. 22 of Roma et al.; exact up to a few roundings.
  EXPECT_NEAR(roma(0.0), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(roma(0.5), 0.5, 1e-15);
  EXPECT_NEAR(roma(-1.0), 1.0 / 6.0, 1e-15);
  EXPECT_EQ(roma(1.5), 0.0);
  EXPECT_EQ(roma(7.0), 0.0);
}

TEST(Kernel, SumsAreOneAndTheFirstMomentVanishesAtEveryOffsetAndWidth) {
  // Both are identities of the kernel: only rounding remains, about 30 terms of size <= 10 cells times 1e-16.
  for (const double ratio : {0.0, 0.3, 0.65, 1.0, 1.01, 1.5, 2.7, 6.0})
    for (double offset = -0.5; offset <= 0.5; offset += 0.01) {
      const Sums s = sums(Kernel(ratio), offset);
      EXPECT_NEAR(s.zeroth, 1.0, 1e-14) << ratio << ' ' << offset;
      EXPECT_NEAR(s.first, 0.0, 1e-13) << ratio << ' ' << offset;
    }
}

TEST(Kernel, RomasVarianceIsTheStatedOne) {
  // Midpoint rule over a function with bounded second derivative (|.| < 10): error < 10/(24 * 1000^2) = 4e-7.
  EXPECT_NEAR(variance(Kernel(0.5)), roma_variance, 1e-6);
}

TEST(Kernel, VarianceStaysThatOfTheDiameterWhenCellsShrink) {
  // variance dx^2 = V d^2 for every d/dx >= 1; midpoint error as above.
  for (const double ratio : {1.0, 1.2, 2.0, 3.5, 8.0})
    EXPECT_NEAR(variance(Kernel(ratio)) / (ratio * ratio), roma_variance, 1e-6) << ratio;
}

TEST(Kernel, ChangesContinuouslyWhereTheBumpSetsIn) {
  // The bump's width is B = d sqrt(7 V (1 - (dx/d)^2)) ~ 2.04 eps^(1/2) at d/dx = 1 + eps. Roma's slope is below 1, so
  // an even average over +-B changes no weight by more than B; in fact by about the variance V 2 eps times the
  // curvature.
  const Kernel below(1.0);
  for (const double eps : {1e-3, 1e-5, 1e-7}) {
    const Kernel above(1.0 + eps);
    for (double offset = -0.5; offset <= 0.5; offset += 0.05) {
      std::vector<double> a(2 * below.reach() + 1), b(2 * above.reach() + 1);
      below.weights(offset, a.data());
      above.weights(offset, b.data());
      for (int j = -above.reach(); j <= above.reach(); ++j) {
        const double old = std::abs(j) <= below.reach() ? a[j + below.reach()] : 0.0;
        EXPECT_NEAR(b[j + above.reach()], old, 2.1 * std::sqrt(eps)) << eps << ' ' << offset;
      }
    }
  }
}

TEST(Kernel, HalfWidthStaysBetweenTheStatedDiameters) {
  for (const double ratio : {1.0, 1.5, 3.0, 8.0}) {
    const Kernel kernel(ratio);
    EXPECT_LE(kernel.reach(), std::ceil(1.55 * ratio + 0.5)) << ratio;
    EXPECT_GE(kernel.reach(), std::floor(1.40 * ratio - 0.5)) << ratio;
  }
}

TEST(Kernel, RefusesBodiesThatTheLatticeResolves) {
  EXPECT_THROW(Kernel(9.5), std::invalid_argument);
  EXPECT_THROW(Kernel(-1.0), std::invalid_argument);
  EXPECT_THROW(Kernel(std::nan("")), std::invalid_argument);
}
}  // namespace
