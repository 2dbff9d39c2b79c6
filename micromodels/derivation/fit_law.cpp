#include "micromodels/derivation/fit_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace puffin::micromodels::derivation {
namespace {

void check_points(std::span<const Point> points) {
  if (points.size() < 5)
    throw std::invalid_argument("a fit needs at least 5 points; there are " + std::to_string(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    if (!(p.speed > 0.0) || !std::isfinite(p.speed) || (i > 0 && !(p.speed > points[i - 1].speed)))
      throw std::invalid_argument("the speeds of a fit must be positive and rise");
    if (!(p.fraction >= 0.0) || !std::isfinite(p.fraction) || !(p.error > 0.0))
      throw std::invalid_argument("a fit needs fractions >= 0 and errors > 0");
  }
}

/// One branch a v^b.
struct Branch {
  Estimate factor{0.0, 0.0, 0.0}, power{1.0, 1.0, 1.0};
  double sum_of_squares = 0.0;
  double at(double v) const { return factor.value * std::pow(v, power.value); }
};

/// Straight line through the logarithms of the positive points.
Eigen::VectorXd first_guess(std::span<const Point> points) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Point& p : points) {
    if (p.fraction <= 0.0) continue;
    const double x = std::log(p.speed), y = std::log(p.fraction);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double det = n * sxx - sx * sx;
  const double b = det > 1e-12 * sxx * n ? std::max(0.0, (n * sxy - sx * sy) / det) : 1.0;
  Eigen::VectorXd guess(2);
  guess << (sy - b * sx) / n, b;
  return guess;
}

/// Parameters: ln of the value at the middle speed, which is little correlated with the second, the power (its
/// absolute value: more speed cannot take less).
Branch fit_branch(std::span<const Point> points) {
  Branch branch;
  if (std::all_of(points.begin(), points.end(), [](const Point& p) { return p.fraction == 0.0; })) return branch;
  const double middle = std::sqrt(points.front().speed * points.back().speed);
  Eigen::VectorXd start = first_guess(points);
  start[0] += start[1] * std::log(middle);
  const auto residuals = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double value = std::exp(std::min(x[0] + std::abs(x[1]) * std::log(points[i].speed / middle), 300.0));
      r[static_cast<Eigen::Index>(i)] = (value - points[i].fraction) / points[i].error;
    }
  };
  LeastSquares fit = least_squares(residuals, static_cast<int>(points.size()), start);
  const double sign = fit.x[1] < 0.0 ? -1.0 : 1.0;
  Eigen::VectorXd to_factor(2);
  to_factor << 1.0, -sign * std::log(middle);
  const Estimate ln = fit.estimate_of(to_factor);
  branch.factor = {std::exp(ln.value), std::exp(ln.low), std::exp(ln.high)};
  const Estimate power = fit.estimate(1);
  branch.power = sign > 0 ? Estimate{power.value, std::max(0.0, power.low), power.high}
                          : Estimate{-power.value, std::max(0.0, -power.high), -power.low};
  branch.sum_of_squares = fit.sum_of_squares;
  return branch;
}

/// Where the branches meet, if between a and b; else the geometric middle.
double meeting(const Branch& low, const Branch& high, double a, double b) {
  if (low.factor.value > 0.0 && high.factor.value > 0.0 && low.power.value != high.power.value) {
    const double v = std::exp(std::log(high.factor.value / low.factor.value) / (low.power.value - high.power.value));
    if (v > a && v <= b) return v;
  }
  return std::sqrt(a * b);
}

}  // namespace

double misfit(const PowerLaw& law, std::span<const Point> points) {
  double sum = 0.0;
  for (const Point& p : points) sum += std::pow((law.value(p.speed) - p.fraction) / p.error, 2);
  return std::sqrt(sum / static_cast<double>(points.size()));
}

PowerFit fit_power(std::span<const Point> points) {
  check_points(points);
  std::vector<double> sums;
  PowerFit best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t split = 2; split + 2 <= points.size(); ++split) {
    const Branch low = fit_branch(points.first(split)), high = fit_branch(points.subspan(split));
    const double sum = low.sum_of_squares + high.sum_of_squares;
    sums.push_back(sum);
    if (sum >= least) continue;
    least = sum;
    const double a = points[split - 1].speed, b = points[split].speed;
    best.A = {low.factor, low.power, Estimate{meeting(low, high, a, b), a, b}, high.factor, high.power};
  }
  const int freedom = static_cast<int>(points.size()) - 5;
  const double t = student_95(std::max(1, freedom));
  const double tolerated = least + t * t * least / std::max(1, freedom);
  for (std::size_t k = 0; k < sums.size(); ++k)
    if (sums[k] <= tolerated) {
      best.A[2].low = std::min(best.A[2].low, points[k + 1].speed);
      best.A[2].high = std::max(best.A[2].high, points[k + 2].speed);
    }
  best.rms = std::sqrt(least / static_cast<double>(points.size()));
  return best;
}

WeibullFit fit_weibull(std::span<const Point> points, double carrier_mass, double adhesion_energy, bool fix_limit) {
  check_points(points);
  if (!(carrier_mass > 0.0) || !(adhesion_energy > 0.0))
    throw std::invalid_argument("a Weibull fit needs the carrier's mass and its adhesion energy, both > 0");
  double highest = 0.0;
  for (const Point& p : points) highest = std::max(highest, p.fraction);
  if (highest == 0.0) throw std::invalid_argument("a Weibull fit needs points with a fraction above 0");
  // The speed at 63 % of the highest value is close to v0.
  double v0 = points.back().speed;
  for (const Point& p : points)
    if (p.fraction >= 0.632 * highest) {
      v0 = p.speed;
      break;
    }
  // x = ln v0, ln k, and the logit of the limit.
  const auto limit_of = [&](const Eigen::VectorXd& x) { return fix_limit ? 1.0 : 1.0 / (1.0 + std::exp(-x[2])); };
  const auto residuals = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r) {
    const double k = std::exp(std::min(x[1], 5.0));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double value =
          -limit_of(x) * std::expm1(-std::exp(std::min(2.0 * k * (std::log(points[i].speed) - x[0]), 50.0)));
      r[static_cast<Eigen::Index>(i)] = (value - points[i].fraction) / points[i].error;
    }
  };
  Eigen::VectorXd start(fix_limit ? 2 : 3);
  start[0] = std::log(v0), start[1] = 0.0;
  if (!fix_limit) start[2] = highest < 0.98 ? std::log(highest / (1.0 - highest)) : 4.0;
  const LeastSquares fit = least_squares(residuals, static_cast<int>(points.size()), start);
  WeibullFit result;
  result.carrier_mass = carrier_mass;
  result.adhesion_energy = adhesion_energy;
  const auto ratio = [&](double ln_v0) { return 0.5 * carrier_mass * std::exp(2.0 * ln_v0) / adhesion_energy; };
  const Estimate v = fit.estimate(0), k = fit.estimate(1);
  result.energy_ratio = {ratio(v.value), ratio(v.low), ratio(v.high)};
  result.shape = {std::exp(k.value), std::exp(k.low), std::exp(k.high)};
  result.limit = {1.0, 1.0, 1.0};
  if (!fix_limit) {
    const Estimate q = fit.estimate(2);
    const auto logistic = [](double x) { return 1.0 / (1.0 + std::exp(-x)); };
    result.limit = {logistic(q.value), logistic(q.low), logistic(q.high)};
  }
  result.rms = std::sqrt(fit.sum_of_squares / static_cast<double>(points.size()));
  return result;
}

}  // namespace puffin::micromodels::derivation
