#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

/// Relative L2 error of a Gaussian hill (catalogue S01, in two dimensions) of `nodes` cells to a sigma that crosses a
/// periodic box of 10 sigma once, obliquely, at Pe = U sigma/D = 100.
double hill_error(int nodes, Scheme scheme) {
  const int n = 10 * nodes;
  Scene s = make_scene({n, n, 1}, {true, true, true});
  const double u = 0.1, v = 0.05, diffusivity = u * nodes / 100.0;
  set_flow(s, [&](int d, int, int, int) { return d == 0 ? u : d == 1 ? v : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  // Periodic images one box away are exp(-25) small at the start; the sum over neighbours keeps them out of the error.
  const auto exact = [&](int i, int j, double t) {
    const double variance = static_cast<double>(nodes) * nodes + 2.0 * diffusivity * t;
    double sum = 0.0;
    for (int p = -3; p <= 3; ++p)
      for (int q = -3; q <= 3; ++q) {
        const double x = i - 0.5 * n - u * t + p * n, y = j - 0.5 * n - v * t + q * n;
        sum += std::exp(-0.5 * (x * x + y * y) / variance);
      }
    return sum * nodes * nodes / variance;
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) f.amount[0][s.at(i, j)] = exact(i, j, 0.0);
  const double start = total(f, 0), time = n / u;
  ScalarOptions o{{{scheme, diffusivity}}};
  const int updates = n / 0.25;  // CFL 0.25 at every resolution
  for (int m = 0; m < updates; ++m) advance_scalars(s.rows, s.fluxes, time / updates, o, f, b);
  EXPECT_NEAR(total(f, 0) / start, 1.0, 1e-12);
  double error = 0.0, norm = 0.0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double e = exact(i, j, time);
      error += std::pow(f.amount[0][s.at(i, j)] - e, 2);
      norm += e * e;
    }
  return std::sqrt(error / norm);
}

TEST(GaussianHill, is_second_order_with_van_leer_and_mc) {
  // Second order but for the cells at the extremum, where the slope is cut to 0: a first-order error on a patch that
  // shrinks with the cells. In the L2 norm that leaves an order between 1.5 and 2.
  for (const Scheme scheme : {Scheme::van_leer, Scheme::mc}) {
    const double coarse = hill_error(5, scheme), middle = hill_error(10, scheme), fine = hill_error(20, scheme);
    std::cout << "L2 errors at 5, 10, 20 cells a sigma: " << coarse << " " << middle << " " << fine << '\n';
    EXPECT_GT(std::log2(coarse / middle), 1.5);
    EXPECT_GT(std::log2(middle / fine), 1.5);
  }
}

TEST(GaussianHill, upwind_has_the_diffusion_that_theory_gives_it) {
  // First-order upwind adds U dx (1 - CFL)/2 to D in each direction (modified equation). Peak of the hill at 10 cells a
  // sigma after one box: 1/sqrt((1 + 2 (D + D_x) t/s^2)(1 + 2 (D + D_y) t/s^2)), s = 10, t = 1000, D = 0.01; D_x = 0.1
  // (1 - 0.4)/2, D_y = 0.05 (1 - 0.2)/2. Higher terms of the modified equation are of relative order (dx/s)^2 = 1e-2.
  Scene s = make_scene({200, 200, 1}, {true, true, true});
  set_flow(s, [](int d, int, int, int) { return d == 0 ? 0.1 : d == 1 ? 0.05 : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  for (int j = 0; j < 200; ++j)
    for (int i = 0; i < 200; ++i)
      f.amount[0][s.at(i, j)] = std::exp(-0.5 * (std::pow(i - 50, 2) + std::pow(j - 100, 2)) / 100.0);
  ScalarOptions o{{{Scheme::upwind, 0.01}}};
  for (int n = 0; n < 250; ++n) advance_scalars(s.rows, s.fluxes, 4.0, o, f, b);
  const double growth_x = 1.0 + 2.0 * (0.01 + 0.03) * 1000 / 100, growth_y = 1.0 + 2.0 * (0.01 + 0.02) * 1000 / 100;
  EXPECT_NEAR(f.amount[0][s.at(150, 150)] * std::sqrt(growth_x * growth_y), 1.0, 1e-2);
}

}  // namespace
}  // namespace puffin::lbm
