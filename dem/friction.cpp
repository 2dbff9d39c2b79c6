#include "dem/friction.hpp"

#include <algorithm>
#include <cmath>

namespace puffin::dem {

using Eigen::Vector3d;

double slip_dashpot(const SurfaceLaw& law, bool rotation, double mass, double slip_stiffness) {
  const double slip_mass = rotation ? 2.0 / 7.0 * mass : mass;  // of a solid sphere at its surface
  return 2.0 * law.zeta * std::sqrt(slip_mass * slip_stiffness);
}

void roll(const Vector3d& normal, double step, double pressing, double slip_stiffness, double pair_radius,
          const SurfaceLaw& law, const Body& a, const Body* b, Touch& touch) {
  Vector3d& spring = touch.memory.roll;
  const double k = slip_stiffness * pair_radius * pair_radius;
  Vector3d half = vec(a.w), end = vec(a.w) + vec(a.twist);
  double inverse = a.inverse_inertia;
  if (b != nullptr) half -= vec(b->w), end -= vec(b->w) + vec(b->twist), inverse += b->inverse_inertia;
  half -= normal * normal.dot(half);
  end -= normal * normal.dot(end);
  spring -= normal * normal.dot(spring);
  spring += step * half;
  Vector3d moment = -k * spring - 2.0 * std::max(law.zeta, 0.1) * std::sqrt(k / inverse) * end;
  const double limit = law.rolling * pair_radius * pressing;
  const double size = moment.norm(), stretch = k * spring.norm();
  if (size > limit) moment *= limit / size;
  if (stretch > limit) spring *= limit / stretch;
  touch.rolling_use = limit > 0.0 ? std::min(1.0, moment.norm() / limit) : 0.0;
  touch.rolling_moment = moment;
}

}  // namespace puffin::dem
