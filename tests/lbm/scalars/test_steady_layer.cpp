#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

/// Steady advection and diffusion between Y = 0 at the inlet and Y = 1 at the outlet (catalogue S03), n cells,
/// in sub-steps of `steps` air steps.
std::vector<double> steady(int n, double peclet, Scheme scheme, double steps = 4.0) {
  Scene s = make_scene({n, 1, 1}, {false, true, true}, true);
  const double u = 0.1;
  set_flow(s, [&](int d, int, int, int) { return d == 0 ? u : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  ScalarOptions o{{{scheme, u * n / peclet}}};
  o.scalar[0].fixed = {0.0, 1.0};
  std::vector<double> y(n);
  for (double change = 1.0; change > 1e-13;) {
    for (int m = 0; m < 100; ++m) advance_scalars(s.rows, s.fluxes, steps, o, f, b);
    change = 0.0;
    for (int i = 0; i < n; ++i) {
      change = std::max(change, std::abs(f.amount[0][s.at(i)] - y[i]));
      y[i] = f.amount[0][s.at(i)];
    }
  }
  return y;
}

double error(const std::vector<double>& y, double peclet) {
  double sum = 0.0;
  const int n = static_cast<int>(y.size());
  for (int i = 0; i < n; ++i) {
    // Mean of phi = (exp(Pe x) - 1)/(exp(Pe) - 1) over the cell.
    const double mean = (std::exp(peclet * (i + 1.0) / n) - std::exp(peclet * i / n)) * n / peclet - 1.0;
    sum += std::abs(y[i] - mean / std::expm1(peclet)) / n;
  }
  return sum;
}

TEST(SteadyLayer, tends_to_the_exact_solution) {
  // At the outlet the face value is first order; it acts over the layer of width 1/Pe: L1 error below cell Pe / 2 x
  // 1/Pe = 1/(2n), and it must fall at least linearly with n (a tenth of the exponent for higher terms). Diffusion
  // comes after the advection, with the part 1 - e of its own new values, e = 1/(4 r), r = 0.4 n/Pe cells^2 a step: the
  // error of this order is proportional to 1 - e, which is larger on the finer grid.
  const auto new_share = [](int n, double peclet) { return 1.0 - std::min(0.5, 0.25 * peclet / (0.4 * n)); };
  // The grids are fine enough that diffusion always comes last (r above 1.6).
  for (const auto& [peclet, n] : {std::pair{1.0, 40}, std::pair{10.0, 80}}) {
    const double coarse = error(steady(n, peclet, Scheme::mc), peclet),
                 fine = error(steady(2 * n, peclet, Scheme::mc), peclet);
    std::cout << "Pe " << peclet << ": L1 errors " << coarse << " " << fine << '\n';
    EXPECT_LT(coarse, 0.5 / n);
    EXPECT_GT(std::log2(coarse / fine), 0.9 - std::log2(new_share(2 * n, peclet) / new_share(n, peclet)));
  }
}

TEST(SteadyLayer, depends_on_the_sub_steps_by_the_diffusion_that_they_add_alone) {
  // Advection to the middle of the sub-step, then diffusion of what it left: between held values the balance is that of
  // the diffusivity D + dt u^2/2, 1 + CFL Pe/(2 n) times D. With Pe = 1 the profile moves by at most x (1 - x)/2 = 1/8
  // of that part; a tenth for the part squared and for what the half cells at the ends add.
  const int n = 50;
  const double cfl = 0.8, short_cfl = 0.1;
  const std::vector<double> long_steps = steady(n, 1.0, Scheme::mc, cfl / 0.1),
                            short_steps = steady(n, 1.0, Scheme::mc, short_cfl / 0.1);
  double largest = 0.0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(long_steps[i] - short_steps[i]));
  EXPECT_LT(largest, 1.1 * (cfl - short_cfl) / (2.0 * n) / 8.0);
}

TEST(SteadyLayer, neither_overshoots_nor_undershoots_at_a_cell_peclet_number_of_100) {
  for (const Scheme scheme : {Scheme::upwind, Scheme::minmod, Scheme::van_leer, Scheme::mc}) {
    const std::vector<double> y = steady(20, 2000.0, scheme);
    for (std::size_t i = 0; i < y.size(); ++i) {
      EXPECT_GE(y[i], 0.0);
      EXPECT_LE(y[i], 1.0);
      EXPECT_GE(y[i], (i > 0 ? y[i - 1] : 0.0) - 1e-15);
    }
    // Last cell: what the half cell to the outlet lets in, u Y = 2 D (1 - Y) but for the little that diffuses on
    // upstream: 2/102.
    EXPECT_NEAR(y.back(), 2.0 / 102.0, 0.02 * 2.0 / 102.0);
  }
}

}  // namespace
}  // namespace puffin::lbm
