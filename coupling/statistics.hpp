#pragma once
// The mean of a fluctuating quantity over time, and how far it can be trusted.

#include <span>

namespace puffin::coupling {

/// A mean with the half width of its confidence interval.
struct TimeMean {
  double mean = 0.0;
  double half_width = 0.0;  // 95 %; NaN with fewer than 4 batches
  int batches = 0;
  double correlation = 0.0;  // between neighbouring batch means; the interval is widened by it where it is positive
};

/// Batch means: the record is cut into B pieces of equal duration, whose means b_k are taken as independent normal
/// draws:
///     mean +- t(0.975, B - 1) s / sqrt(B) * sqrt((1 + r)/(1 - r)),   s^2 = sum (b_k - mean)^2 / (B - 1),
/// r = max(0, lag-1 correlation of the b_k), at most 0.9: pieces that are too short for independence widen the
/// interval. Source: Alexopoulos & Seila in Banks (ed.), Handbook of Simulation (1998), ch. 7; the factor is the one of
/// a first-order autoregressive series. Valid: a stationary record, pieces of several correlation times (20 pieces of
/// 20 acoustic periods, say). A trend over the window shows as r near 1 and a wide interval; it is not removed. in:
/// `value` and the `duration` of each sample, same length, durations >= 0 with a positive sum (steps that follow a ramp
/// are not equally long); a sample that straddles the end of a piece counts for both by its parts. `batches`: B; fewer
/// are used if there are not two samples for each.
/// Throws std::invalid_argument if lengths differ, the record is empty, or a duration is negative.
TimeMean batch_means(std::span<const double> value, std::span<const double> duration, int batches = 20);

/// Two-sided 95 % quantile of Student's distribution, t(0.975, nu), nu >= 3, within 0.2 %: expansion in 1/nu,
/// Abramowitz & Stegun 26.7.5.
double student_quantile(int degrees_of_freedom);

}  // namespace puffin::coupling
