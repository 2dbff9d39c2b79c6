#include "lbm/inlet_gains.hpp"

#include "lbm/d3q19.hpp"

namespace puffin::lbm {

using geometry::Vec3;

double gain_of(int direction, const Vec3& u) {
  const auto& c = d3q19::velocity[direction];
  return -6.0 * d3q19::weight[direction] * Vec3(c[0], c[1], c[2]).dot(u);
}

double cubic_gain_of(int direction, const Vec3& u) {
  const auto& c = d3q19::velocity[direction];
  double sum = 0.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (a != b && c[a] != 0) sum += (c[b] == 0 ? 0.0 : -0.5) * c[a] * u[a] * u[b] * u[b];
  if (direction > 6) return sum;
  for (int a = 0; a < 3; ++a) sum += c[a] * u[a] * (u.squaredNorm() - u[a] * u[a]);
  return sum;
}

}  // namespace puffin::lbm
