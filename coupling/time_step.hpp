#pragma once
// How long an air step is: constant, or following the speed of the ramp so that the lattice speed stays what it is.

#include <functional>

namespace puffin::coupling {

/// The largest section-mean speed of the air at time t [m/s].
using SpeedOfTime = std::function<double(double)>;

/// dt = u_lb dx / U. In a ramp U(t) grows; a step sized for the final speed would be needlessly short before. The step
/// follows in jumps of about 5 % (`window`), each a rescaling of the populations (numerics: Thuerey's idea for free
/// surfaces), and is at most `longest` times the one at the reference speed.
struct TimeStepRule {
  bool follow = false;
  double reference_dt = 0.0;     // [s] at the reference speed
  double reference_speed = 0.0;  // [m/s] the largest that `speed` takes
  SpeedOfTime speed;             // used if follow
  double window = 0.05;
  double longest = 4.0;

  /// The step that suits time t.
  double wanted(double t) const {
    if (!follow || !(reference_speed > 0.0)) return reference_dt;
    const double u = speed(t);
    return reference_dt * (u > reference_speed / longest ? reference_speed / u : longest);
  }
  /// The step to use from time t on, if the present one is `dt`: kept while it is within the window of the wanted one.
  /// `factor`: of every step; below 1 after a retreat from a failure.
  double next(double t, double dt, double factor = 1.0) const {
    const double best = factor * wanted(t);
    if (dt > best * (1.0 + 0.5 * window) || dt < best * (1.0 - 1.5 * window)) return best * (1.0 - 0.5 * window);
    return dt;
  }
  /// The step to start with at time t.
  double first(double t) const { return follow ? wanted(t) * (1.0 - 0.5 * window) : reference_dt; }
};

}  // namespace puffin::coupling
