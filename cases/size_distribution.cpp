#include "cases/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

namespace puffin::cases {
namespace {

constexpr int classes = 2000;
constexpr double tail = 1e-3;  // of the volume, beyond the cuts that nobody gave

/// Standard normal distribution and its inverse (by bisection; called twice a case).
double normal(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }
double normal_quantile(double p) {
  double low = -10.0, high = 10.0;
  for (int n = 0; n < 100; ++n) (normal(0.5 * (low + high)) < p ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

/// Share below the diameter d, of volume or of number as the distribution says.
struct Curve {
  std::vector<double> diameter, share;  // of a table
  SizeDistribution d;

  double below(double x) const {
    if (d.law == SizeLaw::log_normal) return d.sigma > 0.0 ? normal(std::log(x / d.median) / d.sigma) : x >= d.median;
    if (d.law == SizeLaw::rosin_rammler) return -std::expm1(-std::pow(x / d.scale, d.exponent));
    if (x <= diameter.front()) return x < diameter.front() ? 0.0 : share.front();
    if (x >= diameter.back()) return 1.0;
    const auto k = std::upper_bound(diameter.begin(), diameter.end(), x) - diameter.begin();
    return share[k - 1] + (share[k] - share[k - 1]) * (x - diameter[k - 1]) / (diameter[k] - diameter[k - 1]);
  }
  double quantile(double p) const {
    if (d.law == SizeLaw::log_normal) return d.median * std::exp(d.sigma * normal_quantile(p));
    if (d.law == SizeLaw::rosin_rammler) return d.scale * std::pow(-std::log1p(-p), 1.0 / d.exponent);
    return p < 0.5 ? diameter.front() : diameter.back();
  }
};

void read_table(const std::string& file, Curve& curve) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    throw std::runtime_error(file + " is not a regular file");  // a pipe would be waited for
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot open " + file);
  std::string line;
  bool first = true;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[line.find_first_not_of(" \t")] == '#') continue;
    std::istringstream row(line);
    double diameter = 0.0, share = 0.0;
    char comma = 0;
    const bool good = static_cast<bool>(row >> diameter >> comma >> share) && comma == ',';
    if (!good && first) {  // a header
      first = false;
      continue;
    }
    first = false;
    const bool rising = curve.diameter.empty() || (diameter > curve.diameter.back() && share >= curve.share.back());
    if (!good || !(diameter > 0.0) || share < 0.0 || share > 1.0 || !rising)
      throw std::runtime_error(file + ":" + std::to_string(number) +
                               ": expected 'diameter [m], share below it', both rising, the share from 0 to 1");
    curve.diameter.push_back(diameter);
    curve.share.push_back(share);
  }
  if (curve.diameter.size() < 2 || curve.share.back() < 1.0 - 1e-9)
    throw std::runtime_error(file + ": needs two rows at least, and the last share must be 1");
}

}  // namespace

SizeTable size_table(const SizeDistribution& distribution) {
  Curve curve;
  curve.d = distribution;
  if (distribution.law == SizeLaw::table) read_table(distribution.file, curve);
  const double low = distribution.smallest > 0.0 ? distribution.smallest : curve.quantile(tail);
  const double high = distribution.largest > 0.0 ? distribution.largest : curve.quantile(1.0 - tail);
  SizeTable table;
  if (low == high) return {{low}, {1.0}};
  if (!(high > low) || !(curve.below(high) > curve.below(low)))
    throw std::invalid_argument("carriers.diameter: nothing of the distribution lies between its cuts");
  const double step = std::log(high / low) / classes;
  double sum = 0.0;
  if (!curve.share.empty() && low == curve.diameter.front() && curve.share.front() > 0.0) {
    sum = curve.share.front();  // what a table says to be no larger than its smallest has that size
    table.diameter.push_back(low);
    table.cumulative.push_back(sum);
  }
  for (int k = 0; k < classes; ++k) {
    const double from = low * std::exp(k * step), to = low * std::exp((k + 1) * step), middle = std::sqrt(from * to);
    const double share = curve.below(to) - curve.below(from);
    if (share <= 0.0) continue;
    sum += distribution.by_volume ? share * std::pow(low / middle, 3) : share;
    table.diameter.push_back(middle);
    table.cumulative.push_back(sum);
  }
  for (double& c : table.cumulative) c /= sum;
  table.cumulative.back() = 1.0;
  return table;
}

double mean_volume_diameter(const SizeTable& table) {
  double volume = 0.0, before = 0.0;
  for (std::size_t k = 0; k < table.diameter.size(); ++k) {
    volume += (table.cumulative[k] - before) * std::pow(table.diameter[k], 3);
    before = table.cumulative[k];
  }
  return std::cbrt(volume);
}

std::vector<double> draw_diameters(const SizeTable& table, std::int64_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed ^ 0x5eed0f512e5u);
  std::vector<double> diameters(static_cast<std::size_t>(count));
  for (std::int64_t n = 0; n < count; ++n) {
    const double share =
        (static_cast<double>(n) + std::ldexp(static_cast<double>(generator() >> 11), -53)) / static_cast<double>(count);
    const auto k = std::lower_bound(table.cumulative.begin(), table.cumulative.end(), share) - table.cumulative.begin();
    diameters[n] = table.diameter[k];
  }
  for (std::size_t n = diameters.size(); n > 1; --n)  // Fisher & Yates; std::shuffle differs between libraries
    std::swap(diameters[n - 1], diameters[generator() % n]);
  return diameters;
}

}  // namespace puffin::cases
