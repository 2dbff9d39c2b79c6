#include "micromodels/derivation/one_fine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puffin::micromodels::derivation {
namespace {

/// Whether the fine is gone at the end. Overlap d: m d'' = -(contact force) - m a.
bool lifts_off(PairContact contact, double pull, double mass, const Motion& motion) {
  contact.pull = pull;
  double overlap = std::pow(0.75 * pull / (contact.modulus * std::sqrt(contact.radius)), 2.0 / 3.0), rate = 0.0;
  for (const MotionSample& m : motion) {
    const double slope = 2.0 * std::max(contact.stiffness(std::max(overlap, 1e-12)), 2.0 * pull / contact.gap);
    const int steps = std::max(1, static_cast<int>(std::ceil(m.duration * std::sqrt(slope / mass) / 0.2)));
    const double dt = m.duration / steps;
    for (int n = 0; n < steps; ++n) {
      rate -= (contact.normal_force(overlap, rate) / mass + m.acceleration.z()) * dt;
      overlap += rate * dt;
      if (overlap < -50.0 * contact.gap) return true;
    }
  }
  return false;
}

}  // namespace

void MotionRecorder::add(double dt, const Vector3d& acceleration, const Grain& carrier) {
  now_.duration += dt;
  now_.acceleration += acceleration * dt;
  now_.velocity = carrier.velocity;
  now_.spin = carrier.spin;
  now_.height = carrier.position.z();
  if (now_.duration < interval_) return;
  now_.acceleration /= now_.duration;
  motion_.push_back(now_);
  now_ = MotionSample{};
}

Motion MotionRecorder::finish() {
  if (now_.duration > 0.0) {
    now_.acceleration /= now_.duration;
    motion_.push_back(now_);
  }
  now_ = MotionSample{};
  return std::move(motion_);
}

double lift_off_ratio(const PairContact& contact, double mass, const Motion& motion) {
  double peak = 0.0;
  for (const MotionSample& m : motion) peak = std::max(peak, m.acceleration.z());
  if (!(peak > 0.0)) return 1.0;
  double low = 0.25, high = 4.0;  // of F0 / (m_f a_max): lifts off at low, stays at high
  for (int n = 0; n < 9; ++n) {
    const double middle = std::sqrt(low * high);
    (lifts_off(contact, middle * mass * peak, mass, motion) ? low : high) = middle;
  }
  return 1.0 / std::sqrt(low * high);
}

double capture_speed(const PairContact& c) {
  const double work = c.pull / (2.0 * std::numbers::pi * c.radius);
  return std::sqrt(14.18 / c.mass) *
         std::cbrt(std::sqrt(std::pow(work, 5) * std::pow(c.radius, 4) / (c.modulus * c.modulus)));
}

}  // namespace puffin::micromodels::derivation
