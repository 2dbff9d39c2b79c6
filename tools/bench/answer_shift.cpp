#include "tools/bench/answer_shift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace puffin::bench {
namespace {

/// 97.5 % quantile of Student's t, of 1 to 9 degrees of freedom; beyond: that of 9, which is on the safe side.
double student(std::size_t freedom) {
  constexpr std::array quantiles{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262};
  return quantiles[std::min(freedom, quantiles.size()) - 1];
}

double answer(const Answers& run, const std::string& name) {
  const auto found = run.find(name);
  if (found == run.end()) throw std::invalid_argument("a run has no '" + name + "' to compare");
  return found->second;
}

}  // namespace

Answers answers_of(const std::map<std::string, double>& numbers, const std::vector<std::string>& more,
                   const std::string& scalar) {
  Answers answers;
  for (const auto& [key, value] : numbers) {
    const std::size_t dot = key.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string front = key.substr(0, dot), last = key.substr(dot + 1);
    if (key == "carriers.retained_fraction") answers[last] = value;
    const bool share = last == "FFE" || last == "FFW" || last == "FFCR" || last == "FFCE";
    const bool of_scalar = scalar.empty() ? front.starts_with("fines.") : front == "fines." + scalar;
    if (!share || !of_scalar) continue;
    if (!answers.emplace(last, value).second) throw std::invalid_argument("several scalars: say whose " + last);
  }
  for (const std::string& name : more) answers[name] = answer(numbers, name);
  return answers;
}

Answers half_widths(const std::vector<Answers>& replicates, int runs) {
  const std::size_t n = replicates.size();
  if (n < 2) throw std::invalid_argument("one run has no scatter: give two replicates or more");
  Answers widths;
  for (const auto& [name, first] : replicates.front()) {
    double mean = 0.0, square = 0.0;  // from the first, so that equal answers have no scatter at all
    for (const Answers& run : replicates) mean += (answer(run, name) - first) / static_cast<double>(n);
    for (const Answers& run : replicates) square += std::pow(answer(run, name) - first - mean, 2);
    widths[name] = student(n - 1) * std::sqrt(square / static_cast<double>(n - 1) / runs);
  }
  return widths;
}

Answers own_half_widths(const std::map<std::string, double>& numbers, const std::vector<std::string>& names, int runs) {
  Answers widths;
  for (const std::string& name : names) {
    if (!name.ends_with(".mean")) continue;
    const std::string key = name.substr(0, name.size() - 4);  // with its dot
    const auto low = numbers.find(key + "ci_low"), high = numbers.find(key + "ci_high");
    if (low == numbers.end() || high == numbers.end()) continue;
    widths[name] = 0.5 * (high->second - low->second) / std::sqrt(static_cast<double>(runs));
  }
  return widths;
}

Shift farthest_shift(const std::vector<Answers>& with, const std::vector<Answers>& without, const Answers& half_widths,
                     bool exact) {
  if (with.empty() || with.size() != without.size() || half_widths.empty())
    throw std::invalid_argument("nothing to compare");
  Shift farthest;
  for (const auto& [name, half_width] : half_widths) {
    double sum = 0.0, most = 0.0;
    for (std::size_t r = 0; r < with.size(); ++r) {
      const double moved = answer(without[r], name) - answer(with[r], name);
      sum += moved, most = std::max(most, std::abs(moved));
    }
    const double change = exact ? most : std::abs(sum) / static_cast<double>(with.size());
    const double ratio = change == 0.0       ? 0.0
                         : half_width == 0.0 ? std::numeric_limits<double>::infinity()
                                             : change / half_width;
    farthest.within = farthest.within && (exact ? change == 0.0 : ratio <= 1.0);
    if (farthest.answer.empty() || ratio > farthest.ratio) {
      farthest.answer = name;
      farthest.change = change, farthest.half_width = half_width, farthest.ratio = ratio;
    }
  }
  return farthest;
}

}  // namespace puffin::bench
