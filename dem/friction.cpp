#include "dem/friction.hpp"

#include <algorithm>
#include <cmath>

namespace puffin::dem {

using Eigen::Vector3d;

double slip_dashpot(const SurfaceLaw& law, bool rotation, double mass, double slip_stiffness) {
  const double slip_mass = rotation ? 2.0 / 7.0 * mass : mass;  // of a solid sphere at its surface
  return 2.0 * law.zeta * std::sqrt(slip_mass * slip_stiffness);
}

Vector3d slip_force(const Meeting& m, double step, double limit_force, const SurfaceLaw& law, Touch& touch,
                    const Body& a, const Body* b) {
  Contact& c = touch.memory;
  const double k = c.slip_stiffness;
  Vector3d half = surface_velocity(m, a, b, false);
  half -= m.normal * m.normal.dot(half);
  Vector3d end = surface_velocity(m, a, b, true);
  end -= m.normal * m.normal.dot(end);
  c.slip -= m.normal * m.normal.dot(c.slip);
  c.slip += step * half;
  Vector3d force = -k * c.slip - touch.eta_slip * end;
  const double limit = law.friction(law.slip_speed > 0.0 ? end.norm() : 0.0) * limit_force;
  const double size2 = force.squaredNorm();
  if (size2 > limit * limit) force *= limit / std::sqrt(size2);
  const double stretch2 = k * k * c.slip.squaredNorm();
  if (stretch2 > limit * limit) c.slip *= limit / std::sqrt(stretch2);
  c.use = limit > 0.0 ? std::min(1.0, force.norm() / limit) : 1.0;
  c.hold = limit;
  return force;
}

Vector3d rolling_moment(const Meeting& m, double step, double limit_force, const SurfaceLaw& law, Touch& touch,
                        const Body& a, const Body* b) {
  Contact& c = touch.memory;
  const double k = c.slip_stiffness * touch.pair.radius * touch.pair.radius;
  Vector3d half = a.w, end = a.w + a.twist;
  double inverse = a.inverse_inertia;
  if (b != nullptr) half -= b->w, end -= b->w + b->twist, inverse += b->inverse_inertia;
  half -= m.normal * m.normal.dot(half);
  end -= m.normal * m.normal.dot(end);
  c.roll -= m.normal * m.normal.dot(c.roll);
  c.roll += step * half;
  Vector3d moment = -k * c.roll - 2.0 * std::max(law.zeta, 0.1) * std::sqrt(k / inverse) * end;
  const double limit = law.rolling * touch.pair.radius * limit_force;
  const double size = moment.norm(), stretch = k * c.roll.norm();
  if (size > limit) moment *= limit / size;
  if (stretch > limit) c.roll *= limit / stretch;
  if (limit > 0.0) c.use = std::max(c.use, std::min(1.0, moment.norm() / limit));
  return moment;
}

}  // namespace puffin::dem
