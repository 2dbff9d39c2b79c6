#include "cases/sweep.hpp"

#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "cases/units.hpp"

namespace puffin::cases {
namespace {

constexpr std::size_t most_points = 100000;

std::string text_between(const SweepRange& r, double part) {
  const double value = std::lerp(r.numbers[0], r.numbers[1], part);  // the ends themselves at 0 and 1
  return r.whole ? std::to_string(std::llround(value)) : shortest(value);
}

void need_ends(const SweepRange& r) {
  if (r.numbers.size() != 2 || r.numbers[0] == r.numbers[1])
    throw std::invalid_argument(r.key + ": points in between need two numbers that differ, [lowest, highest]");
}

std::vector<std::vector<std::string>> together(const std::vector<SweepRange>& ranges) {
  std::vector<std::vector<std::string>> points(ranges.front().texts.size());
  for (const SweepRange& r : ranges) {
    if (r.texts.size() != points.size())
      throw std::invalid_argument(r.key + ": has " + std::to_string(r.texts.size()) + " values, " + ranges.front().key +
                                  " has " + std::to_string(points.size()) +
                                  "; a list takes the n-th of all together, so give the same number");
    for (std::size_t n = 0; n < points.size(); ++n) points[n].push_back(r.texts[n]);
  }
  return points;
}

std::vector<std::vector<std::string>> combined(const std::vector<SweepRange>& ranges, std::int64_t samples) {
  std::vector<std::vector<std::string>> points(1);
  for (const SweepRange& r : ranges) {
    std::vector<std::string> levels = r.texts;
    if (samples > 0) {
      need_ends(r);
      if (samples < 2) throw std::invalid_argument("samples: a factorial needs at least 2 a range");
      levels.clear();
      for (std::int64_t n = 0; n < samples; ++n)
        levels.push_back(text_between(r, static_cast<double>(n) / static_cast<double>(samples - 1)));
    }
    if (points.size() * levels.size() > most_points)
      throw std::invalid_argument("the sweep has more than 100000 points");
    std::vector<std::vector<std::string>> longer;
    for (const auto& point : points)
      for (const std::string& level : levels) {
        longer.push_back(point);
        longer.back().push_back(level);
      }
    points = std::move(longer);
  }
  return points;
}

std::vector<std::vector<std::string>> latin_hypercube(const std::vector<SweepRange>& ranges, std::int64_t samples,
                                                      std::uint64_t seed) {
  if (samples < 1) throw std::invalid_argument("samples: a Latin hypercube needs their number");
  const auto n = static_cast<std::size_t>(samples);
  std::mt19937_64 random(seed);  // the same numbers everywhere; the library's distributions and shuffle are not
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<std::vector<std::string>> points(n);
  for (const SweepRange& r : ranges) {
    need_ends(r);
    std::vector<std::size_t> part(n);
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) std::swap(part[i - 1], part[static_cast<std::size_t>(uniform() * double(i))]);
    for (std::size_t i = 0; i < n; ++i)
      points[i].push_back(text_between(r, (static_cast<double>(part[i]) + uniform()) / static_cast<double>(n)));
  }
  return points;
}

}  // namespace

std::vector<std::vector<std::string>> sweep_points(SweepMethod method, const std::vector<SweepRange>& ranges,
                                                   std::int64_t samples, std::uint64_t seed) {
  if (ranges.empty()) throw std::invalid_argument("a sweep needs at least one key in [sweep.range]");
  if (samples > static_cast<std::int64_t>(most_points)) throw std::invalid_argument("samples: at most 100000");
  if (method == SweepMethod::lhs) return latin_hypercube(ranges, samples, seed);
  if (method == SweepMethod::factorial) return combined(ranges, samples);
  if (samples > 0) throw std::invalid_argument("samples: a list has its own number of points; leave samples out");
  return together(ranges);
}

}  // namespace puffin::cases
