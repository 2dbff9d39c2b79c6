#pragma once
// One fine on a carrier that decelerates.

#include <vector>

#include "micromodels/derivation/grains.hpp"

namespace puffin::micromodels::derivation {

/// Motion of a carrier, averaged over a short interval.
struct MotionSample {
  double duration = 0.0;                                          // [s]
  Vector3d acceleration = Vector3d::Zero();                       // mean [m/s^2]
  Vector3d velocity = Vector3d::Zero(), spin = Vector3d::Zero();  // at its end
  double height = 0.0;                                            // of its centre, at its end [m]
};
using Motion = std::vector<MotionSample>;

class MotionRecorder {
 public:
  explicit MotionRecorder(double interval) : interval_(interval) {}  // [s]
  void add(double dt, const Vector3d& acceleration, const Grain& carrier);
  Motion finish();

 private:
  double interval_;
  MotionSample now_;
  Motion motion_;
};

/// m_f a_max / F0 at which a fine of mass m_f [kg] at the pole (z < 0 of the carrier) lifts off: below 1 where its
/// contact vibrates, above where the push is too short. By bisection in F0 of its resolved normal motion.
double lift_off_ratio(const PairContact& contact, double mass, const Motion& motion);

/// v_s = sqrt(14.18/m*) (W^5 R*^4/E*^2)^(1/6), W = F0/(2 pi R*): slower, a sphere sticks [m/s].
/// Source: Thornton & Ning, Powder Technol. 99 (1998) 154.
double capture_speed(const PairContact& contact);

}  // namespace puffin::micromodels::derivation
