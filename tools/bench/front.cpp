#include "tools/bench/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace puffin::bench {

std::vector<bool> on_front(const std::vector<CostAndError>& settings) {
  std::vector<std::size_t> order(settings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto &p = settings[a], &q = settings[b];
    return p.seconds != q.seconds ? p.seconds < q.seconds : p.error < q.error;
  });
  std::vector<bool> front(settings.size(), false);
  double best = std::numeric_limits<double>::infinity(), best_seconds = -best;
  for (const std::size_t n : order) {
    const CostAndError& s = settings[n];
    if (!std::isfinite(s.error) || !std::isfinite(s.seconds)) continue;
    front[n] = s.error < best || (s.error == best && s.seconds == best_seconds);
    if (front[n]) best = s.error, best_seconds = s.seconds;
  }
  return front;
}

std::size_t best_for_cost(const std::vector<CostAndError>& settings, std::size_t which) {
  std::size_t best = which;
  for (std::size_t n = 0; n < settings.size(); ++n) {
    const CostAndError &s = settings[n], &b = settings[best];
    if (!std::isfinite(s.error) || !(s.seconds <= settings[which].seconds)) continue;
    if (!std::isfinite(b.error) || s.error < b.error || (s.error == b.error && s.seconds < b.seconds)) best = n;
  }
  return best;
}

double time_over_front(const std::vector<CostAndError>& settings, std::size_t which, bool certain) {
  const CostAndError& own = settings[which];
  double fastest = own.seconds;
  for (const CostAndError& s : settings) {
    if (!std::isfinite(s.error)) continue;
    const double margin = certain ? std::hypot(s.half_width, own.half_width) : 0.0;
    if (s.error + margin <= own.error) fastest = std::min(fastest, s.seconds);
  }
  return own.seconds / fastest;
}

}  // namespace puffin::bench
