#pragma once
// Many seeded impacts: fractions over speed, fitted.

#include <functional>
#include <vector>

#include "micromodels/derivation/fit_law.hpp"
#include "micromodels/derivation/impact.hpp"

namespace puffin::micromodels::derivation {

/// Mean over the impacts at one speed and angle, of the fines of a carrier; errors are standard errors of the mean.
struct DerivedPoint {
  double speed = 0.0, angle = 90.0;  // [m/s], [degrees]
  int impacts = 0;
  double detached = 0.0, detached_error = 0.0;
  double attached = 0.0, attached_error = 0.0;
  double rolled = 0.0, redeposited = 0.0;
  double rebound = 0.0, deepest = 0.0, peak = 0.0;  // means of Outcome's
  std::array<double, 2> detached_half{};            // means over the even and the odd seeds
  double seconds = 0.0;                             // of this machine, all threads
};

/// The same bits for every number of threads. Throws as impact().
DerivedPoint derive_point(const Scene& scene, double speed, double angle, int impacts, std::uint64_t seed,
                          Resolve resolve = Resolve::contact);

/// Errors of fractions for a fit: at least one fine of one impact in all, so that points without any loss do not weigh
/// infinitely, and at least `form` of the value, as two power laws are not the true form.
std::vector<Point> detached_points(std::span<const DerivedPoint> points, int fines, double form = 0.02);
std::vector<Point> attached_points(std::span<const DerivedPoint> points, int fines, double form = 0.02);

/// Largest |difference| between what a fit of the even seeds says and what the odd seeds found, as a fraction of the
/// largest fraction.
double half_predicts_half(std::span<const DerivedPoint> points, int fines);

}  // namespace puffin::micromodels::derivation
