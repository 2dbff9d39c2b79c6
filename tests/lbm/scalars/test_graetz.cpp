#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

/// Sherwood number on D_h = 2 h of fully developed flow between absorbing plates h cells apart (catalogue S05).
double sherwood(int h) {
  const int length = 8 * h;
  const double mean = 0.1, peclet = 100.0, diffusivity = mean * 2.0 * h / peclet;
  Scene s = make_scene({length, h, 1}, {false, false, true}, true);
  const auto u = [&](int j) {
    const auto integral = [&](double y) {
      return mean * (3.0 * y * y / h - 2.0 * y * y * y / (static_cast<double>(h) * h));
    };
    return integral(j + 1.0) - integral(j);
  };
  set_flow(s, [&](int d, int, int j, int) { return d == 0 ? u(j) : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  ScalarOptions o{{{Scheme::mc, diffusivity, WallRule::absorb}}};
  o.scalar[0].fixed = {1.0};
  // The slowest cells move at u(0), about 3 U/h: four times their passage, in which diffusion mixes them many times
  // over.
  for (double t = 0.0; t < 4.0 * length / u(0); t += 4.0) advance_scalars(s.rows, s.fluxes, 4.0, o, f, b);
  const int i = 6 * h;
  double bulk = 0.0;
  for (int j = 0; j < h; ++j) bulk += u(j) * f.amount[0][s.at(i, j)] / (mean * h);
  const double flux =
      2.0 * diffusivity * 0.5 * (f.amount[0][s.at(i, 0)] + f.amount[0][s.at(i, h - 1)]);  // half a cell away
  return flux / (diffusivity * bulk) * 2.0 * h;
}

TEST(Graetz, between_absorbing_plates_tends_to_7_541) {
  // Plates, constant wall value: Sh = 7.541 (R-high; Shah & London 1978). The wall flux by a one-sided half-cell
  // difference and the first-order upwind along x make an error that shrinks with the cells; axial diffusion at Pe 100
  // adds of order 1e-3.
  const double coarse = sherwood(10), fine = sherwood(20);
  std::cout << "Sh " << coarse << " at 10 cells, " << fine << " at 20\n";
  EXPECT_LT(std::abs(fine - 7.541), 0.6 * std::abs(coarse - 7.541));
  EXPECT_NEAR(fine, 7.541, 0.01 * 7.541);
}

}  // namespace
}  // namespace puffin::lbm
