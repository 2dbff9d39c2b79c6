#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

/// Zalesak's disk (catalogue S04; S. T. Zalesak, J. Comput. Phys. 31, 335 (1979)): radius 15, slot 5 x 25, 100 x 100
/// cells, centre (50, 75), one turn about (50, 50). Returns the L1 error over the area of the disk.
double turn(Scheme scheme) {
  Scene s = make_scene({100, 100, 1}, {false, false, true});
  const double omega = 0.002;
  // Solid-body rotation out to r = 49, at rest beyond: stream function at the corners, so the discrete flow has no
  // divergence.
  set_curl(s, [&](int d, int i, int j, int) {
    const double x = i + 1.0 - 50.0, y = j + 1.0 - 50.0;  // corner above cell (i,j); cell centres at i + 1/2
    return d == 2 ? -0.5 * omega * std::min(x * x + y * y - 49.0 * 49.0, 0.0) : 0.0;
  });
  const auto disk = [](int i, int j) {
    const double x = i + 0.5 - 50.0, y = j + 0.5 - 75.0;
    return x * x + y * y < 225.0 && !(std::abs(x) < 2.5 && y < 10.0);
  };
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i) f.amount[0][s.at(i, j)] = disk(i, j);
  const double area = total(f, 0), period = 2.0 * M_PI / omega;
  ScalarOptions o{{{scheme}}};
  const int updates = std::ceil(period / max_steps(s.rows, s.fluxes, 0.8));
  for (int n = 0; n < updates; ++n) advance_scalars(s.rows, s.fluxes, period / updates, o, f, b);
  EXPECT_NEAR(total(f, 0) / area, 1.0, 1e-12);
  double error = 0.0;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i) {
      const double c = f.amount[0][s.at(i, j)];
      EXPECT_GE(c, -1e-13);  // rounding of some 400 updates, each below 1e-15
      EXPECT_LE(c, 1.0 + 1e-12);
      error += std::abs(c - disk(i, j));
    }
  return error / area;
}

TEST(SlottedDisk, turns_once_without_new_extrema_and_sharper_with_better_slopes) {
  const double upwind = turn(Scheme::upwind), minmod = turn(Scheme::minmod), van_leer = turn(Scheme::van_leer),
               mc = turn(Scheme::mc);
  std::cout << "L1 error over area: upwind " << upwind << ", minmod " << minmod << ", van Leer " << van_leer << ", MC "
            << mc << '\n';
  EXPECT_GT(upwind, minmod);
  EXPECT_GT(minmod, van_leer);
  EXPECT_GT(van_leer, mc);
}

}  // namespace
}  // namespace puffin::lbm
