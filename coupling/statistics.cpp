#include "coupling/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace puffin::coupling {

double student_quantile(int degrees_of_freedom) {
  const double x = 1.959963984540054, n = degrees_of_freedom;
  const double x2 = x * x;
  const double g1 = (x2 + 1.0) * x / 4.0;
  const double g2 = ((5.0 * x2 + 16.0) * x2 + 3.0) * x / 96.0;
  const double g3 = (((3.0 * x2 + 19.0) * x2 + 17.0) * x2 - 15.0) * x / 384.0;
  const double g4 = ((((79.0 * x2 + 776.0) * x2 + 1482.0) * x2 - 1920.0) * x2 - 945.0) * x / 92160.0;
  return x + g1 / n + g2 / (n * n) + g3 / (n * n * n) + g4 / (n * n * n * n);
}

namespace {

/// Means of `batches` pieces of equal duration.
std::vector<double> piece_means(std::span<const double> value, std::span<const double> duration, double total,
                                int batches) {
  const double piece = total / batches;
  std::vector<double> sums(batches, 0.0);
  double time = 0.0;
  for (std::size_t n = 0; n < value.size(); ++n) {
    const double end = time + duration[n];
    for (int b = std::min(batches - 1, static_cast<int>(time / piece)); b < batches; ++b) {
      const double low = std::max(time, b * piece), high = b + 1 == batches ? end : std::min(end, (b + 1) * piece);
      if (high > low) sums[b] += value[n] * (high - low);
      if (end <= (b + 1) * piece) break;
    }
    time = end;
  }
  for (int b = 0; b < batches; ++b) sums[b] /= b + 1 == batches ? total - b * piece : piece;
  return sums;
}

}  // namespace

TimeMean batch_means(std::span<const double> value, std::span<const double> duration, int batches) {
  if (value.size() != duration.size()) throw std::invalid_argument("each sample of a time mean needs its duration");
  double total = 0.0, integral = 0.0;
  for (std::size_t n = 0; n < value.size(); ++n) {
    if (!(duration[n] >= 0.0)) throw std::invalid_argument("a sample of a time mean has a negative duration");
    total += duration[n];
    integral += value[n] * duration[n];
  }
  if (!(total > 0.0)) throw std::invalid_argument("a time mean needs a record of positive duration");
  TimeMean result;
  result.mean = integral / total;
  result.half_width = std::numeric_limits<double>::quiet_NaN();
  result.batches = std::min(batches, static_cast<int>(std::min<std::size_t>(value.size() / 2, 1000)));
  if (result.batches < 4) return result;

  const std::vector<double> means = piece_means(value, duration, total, result.batches);
  const double count = result.batches;
  const double middle = std::accumulate(means.begin(), means.end(), 0.0) / count;
  double squares = 0.0, neighbours = 0.0;
  for (std::size_t b = 0; b < means.size(); ++b) {
    squares += (means[b] - middle) * (means[b] - middle);
    if (b > 0) neighbours += (means[b] - middle) * (means[b - 1] - middle);
  }
  result.correlation = squares > 0.0 ? neighbours / squares : 0.0;
  const double r = std::clamp(result.correlation, 0.0, 0.9);
  result.half_width = student_quantile(result.batches - 1) * std::sqrt(squares / (count - 1.0) / count) *
                      std::sqrt((1.0 + r) / (1.0 - r));
  return result;
}

}  // namespace puffin::coupling
