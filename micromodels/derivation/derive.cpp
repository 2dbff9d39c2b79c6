#include "micromodels/derivation/derive.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace puffin::micromodels::derivation {
namespace {

struct Mean {
  double sum = 0.0, squares = 0.0;
  int n = 0;
  void add(double x) { sum += x, squares += x * x, ++n; }
  double mean() const { return n > 0 ? sum / n : 0.0; }
  double error() const { return n > 1 ? std::sqrt(std::max(0.0, squares / n - mean() * mean()) / (n - 1)) : 0.0; }
};

std::vector<Point> with_errors(std::span<const DerivedPoint> points, int fines, double form,
                               double DerivedPoint::*value, double DerivedPoint::*error) {
  std::vector<Point> out;
  for (const DerivedPoint& p : points) {
    const double one = 1.0 / (static_cast<double>(fines) * p.impacts);
    out.push_back({p.speed, p.*value, std::hypot(std::max(p.*error, one), form * p.*value)});
  }
  return out;
}

}  // namespace

DerivedPoint derive_point(const Scene& scene, double speed, double angle, int impacts, std::uint64_t seed,
                          Resolve resolve) {
  if (impacts < 1) throw std::invalid_argument("derivation: at least one impact a point");
  check(scene);
  const auto start = std::chrono::steady_clock::now();
  std::vector<Outcome> outcomes(static_cast<std::size_t>(impacts));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, outcomes.size(), 1), [&](const auto& range) {
    for (std::size_t n = range.begin(); n < range.end(); ++n)
      outcomes[n] = impact(scene, speed, angle, seed + n, resolve);
  });
  Mean detached, attached, rolled, redeposited, rebound, deepest, peak;
  std::array<Mean, 2> half;
  for (std::size_t n = 0; n < outcomes.size(); ++n) {
    const Outcome& o = outcomes[n];
    detached.add(o.detached / static_cast<double>(scene.fines));
    half[n % 2].add(o.detached / static_cast<double>(scene.fines));
    attached.add(o.to_wall / static_cast<double>(scene.fines));
    rolled.add(o.rolled / static_cast<double>(scene.fines));
    redeposited.add(o.redeposited / static_cast<double>(scene.fines));
    rebound.add(o.rebound);
    deepest.add(o.deepest);
    peak.add(o.peak);
  }
  DerivedPoint p{speed, angle, impacts};
  p.detached = detached.mean(), p.detached_error = detached.error();
  p.attached = attached.mean(), p.attached_error = attached.error();
  p.rolled = rolled.mean(), p.redeposited = redeposited.mean();
  p.rebound = rebound.mean(), p.deepest = deepest.mean(), p.peak = peak.mean();
  p.detached_half = {half[0].mean(), half[1].mean()};
  p.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return p;
}

std::vector<Point> detached_points(std::span<const DerivedPoint> points, int fines, double form) {
  return with_errors(points, fines, form, &DerivedPoint::detached, &DerivedPoint::detached_error);
}

std::vector<Point> attached_points(std::span<const DerivedPoint> points, int fines, double form) {
  return with_errors(points, fines, form, &DerivedPoint::attached, &DerivedPoint::attached_error);
}

double half_predicts_half(std::span<const DerivedPoint> points, int fines) {
  std::vector<Point> even = detached_points(points, fines);
  double largest = 0.0;
  for (std::size_t k = 0; k < even.size(); ++k) {
    even[k].fraction = points[k].detached_half[0];
    largest = std::max(largest, points[k].detached_half[1]);
  }
  if (largest == 0.0) return 0.0;
  const PowerLaw law = fit_power(even).law();
  double worst = 0.0;
  for (const DerivedPoint& p : points)
    worst = std::max(worst, std::abs(std::min(1.0, law.value(p.speed)) - p.detached_half[1]));
  return worst / largest;
}

}  // namespace puffin::micromodels::derivation
