// Where the kernel looks at no population, none may be near zero.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lbm/collision_regularised.hpp"

using namespace puffin::lbm;

namespace {

/// A random direction in the space of deviatoric stresses (all nine components count) and of velocities.
void random_directions(std::mt19937& random, double (&u)[3], double (&p)[6]) {
  std::normal_distribution<double> normal;
  double length2 = 0.0;
  for (double& v : u) v = normal(random), length2 += v * v;
  for (double& v : u) v /= std::sqrt(length2);
  for (double& v : p) v = normal(random);
  const double mean = (p[0] + p[1] + p[2]) / 3.0;
  for (int d = 0; d < 3; ++d) p[d] -= mean;
  const double size = std::sqrt(square_of(p));
  for (double& v : p) v /= size;
}

// The kernel looks at no population of a cell near rest: it must be that none can be negative there (the limiter's
// floor is w_i/10). States on the surface of that region, a third of them with the flow along a diagonal and its stress
// against it, which is the worst there is.
TEST(Rr3, HasNoPopulationBelowATenthOfItsWeightNearRest) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0.0, 0.5 * M_PI);
  double lowest = 1.0;
  for (int n = 0; n < 300000; ++n) {
    double u[3], p[6];
    random_directions(random, u, p);
    if (n % 3 == 0) {
      for (double& v : u) v *= 0.1;
      u[0] = u[1] = std::sqrt(0.5);
      for (double& v : p) v *= 0.3;
      p[0] = p[1] = -0.3, p[2] = 0.6, p[3] = -0.4;
      const double size = std::sqrt(square_of(p)), mean = (p[0] + p[1] + p[2]) / 3.0;
      for (int d = 0; d < 3; ++d) p[d] -= mean;
      for (double& v : p) v /= size;
    }
    const double drho = n % 2 == 0 ? -0.1 * std::sin(angle(random)) : 0.0, left = std::sqrt(1.0 - 100.0 * drho * drho);
    const double share = angle(random);
    CellState<double> s;
    s.drho = drho;
    for (int d = 0; d < 3; ++d) s.u[d] = u[d] * 0.3 * left * std::cos(share), s.j[d] = (1.0 + drho) * s.u[d];
    for (int k = 0; k < 6; ++k) s.p[k] = p[k] * 0.02 * left * std::sin(share);
    const double speed2 = s.u[0] * s.u[0] + s.u[1] * s.u[1] + s.u[2] * s.u[2];
    ASSERT_LE(distance_from_rest(drho, speed2, square_of(s.p)), 1.05);
    const double none[3] = {0, 0, 0};
    Rr3::assemble<false>(s, none, [&](auto i, double g) { lowest = std::min(lowest, 1.0 + g / d3q19::weight[i]); });
  }
  EXPECT_GT(lowest, 0.1);
  EXPECT_LT(lowest, 0.3) << "the region is smaller than it need be, or the states do not reach its edge";
}

}  // namespace
