#pragma once
// When do two freely flying spheres, or a sphere and a plane, first touch?

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace puffin::dem {

/// First time in [0, horizon] at which the gap g + u t + a t^2/2 falls to zero; infinity if it does not.
/// A gap <= 0 that is still closing is touched at once.
inline double first_zero(double gap, double speed, double acceleration, double horizon) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (gap <= 0.0) {
    if (speed < 0.0) return 0.0;
    if (acceleration >= 0.0) return never;
    const double back = -2.0 * speed / acceleration;  // leaves and falls back to where it is
    return back <= horizon ? back : never;
  }
  double time;
  const double root2 = speed * speed - 2.0 * acceleration * gap;
  if (acceleration == 0.0) {
    if (speed >= 0.0) return never;
    time = -gap / speed;
  } else {
    if (root2 < 0.0) return never;
    const double root = std::sqrt(root2);
    if (speed <= 0.0) {
      if (root - speed <= 0.0) return never;
      time = 2.0 * gap / (root - speed);  // the smaller root, without cancellation; also for a < 0
    } else {
      if (acceleration >= 0.0) return never;
      time = -(speed + root) / acceleration;
    }
  }
  return time <= horizon ? time : never;
}

/// First time in [0, horizon] at which |p + w t + a t^2/2| falls to `reach`, for the relative position p, velocity w
/// and acceleration a; infinity if it does not. The straight line or the motion along the line of centres gives the
/// first guess, three Newton steps the rest.
inline double first_touch(const Eigen::Vector3d& p, const Eigen::Vector3d& w, const Eigen::Vector3d& a, double reach,
                          double horizon) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double distance = p.norm(), gap = distance - reach;
  const double w2 = w.squaredNorm(), pw = p.dot(w), a2 = a.squaredNorm();
  if (gap > 0.0 && gap * gap > 2.0 * horizon * horizon * (w2 + 0.25 * a2 * horizon * horizon)) return never;
  double time = never;
  if (gap <= 0.0) {
    if (pw < 0.0) return 0.0;
    time = first_zero(gap, pw / distance, p.dot(a) / distance, horizon);
  } else if (pw < 0.0) {
    const double root2 = pw * pw - w2 * gap * (distance + reach);
    if (root2 >= 0.0) time = gap * (distance + reach) / (std::sqrt(root2) - pw);
  }
  if (a2 * horizon * horizon > 1e-2 * w2) {  // the path bends: the motion along the line of centres as a second guess
    const double speed = pw / distance;
    const double outwards = (w2 - speed * speed) / distance;
    time = std::min(time, first_zero(gap, speed, p.dot(a) / distance + outwards, horizon));
  }
  if (time == never) return never;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d q = p + w * time + a * (0.5 * time * time);
    const double d = q.norm(), slope = q.dot(w + a * time) / d;
    if (slope >= 0.0) return never;
    time -= (d - reach) / slope;
    if (time < 0.0) time = 0.0;
  }
  return time <= horizon ? time : never;
}

}  // namespace puffin::dem
