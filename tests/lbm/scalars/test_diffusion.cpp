#include <gtest/gtest.h>

#include <cmath>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

/// Variance along x of a scalar in a line of cells.
double variance(const Scene& s, const ScalarFields& f, int n) {
  double m0 = 0.0, m1 = 0.0, m2 = 0.0;
  for (int i = 0; i < n; ++i) {
    const double c = f.amount[0][s.at(i)];
    m0 += c, m1 += c * i, m2 += c * i * i;
  }
  return m2 / m0 - m1 * m1 / (m0 * m0);
}

TEST(Diffusion, grows_the_variance_by_2_D_t_exactly) {
  // For every weight of old and new values the second moment of a discrete cloud grows by exactly 2 D n per
  // update, far from walls. Rounding: moments of order 100^2 from numbers near 1, 1e-12.
  for (const double diffusivity : {0.01, 0.2, 3.0}) {
    Scene s = make_scene({401, 1, 1}, {false, true, true});
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    f.amount[0][s.at(200)] = 1.0;
    ScalarOptions o{{{Scheme::mc, diffusivity}}};
    for (int n = 0; n < 20; ++n) advance_scalars(s.rows, s.fluxes, 1.0, o, f, b);
    EXPECT_NEAR(variance(s, f, 401), 2.0 * diffusivity * 20, 1e-9) << diffusivity;
  }
}

TEST(Diffusion, acts_on_what_the_air_has_carried_on) {
  // In one sweep air takes a cells' worth of Y = x^3 along and gamma is exchanged: to second order, and for a cubic
  // exactly, diffusion adds gamma times the second difference of (x - a)^3, 6 gamma (x - a). (Of the profile half-way,
  // as it once did, it adds 3 gamma a more, 0.045.) Periodic: the jump at the ends is felt in the three cells beside
  // it. Rounding: 52^3 = 1.4e5 times 1e-16, 1e-10.
  const double a = 0.3, gamma = 0.05;
  const int n = 32;
  Scene s = make_scene({n, 1, 1}, {true, true, true});
  set_flow(s, [&](int d, int, int, int) { return d == 0 ? a : 0.0; });
  std::array<ScalarFields, 2> f{s.fields(), s.fields()};
  ScalarBudget b = s.budget();
  for (int which = 0; which < 2; ++which) {
    for (int i = 0; i < n; ++i) f[which].amount[0][s.at(i)] = std::pow(i + 20.0, 3);
    advance_scalars(s.rows, s.fluxes, 1.0, {{{Scheme::mc, which == 0 ? 0.0 : gamma}}}, f[which], b);
  }
  ASSERT_EQ(b.sub_steps, 2);
  for (int i = 3; i < n - 3; ++i)
    EXPECT_NEAR(f[1].amount[0][s.at(i)] - f[0].amount[0][s.at(i)], 6.0 * gamma * (i + 20.0 - a), 1e-8) << i;
}

TEST(Diffusion, decays_a_wave_across_a_periodic_box_at_the_rate_of_its_wave_number) {
  // One update multiplies cos(k x) by (1 - e c)/(1 + (1 - e) c), c = 4 D n sin^2(k/2), exactly; e = 1/(4 D n) here,
  // half of what empties a cell through its two faces. This checks the closed lines. 10 cells.
  Scene s = make_scene({1, 10, 1}, {true, true, true});
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  const double k = 2.0 * M_PI / 10.0, diffusivity = 5.0;
  for (int j = 0; j < 10; ++j) f.amount[0][s.at(0, j)] = 1.0 + 0.5 * std::cos(k * j);
  advance_scalars(s.rows, s.fluxes, 1.0, {{{Scheme::mc, diffusivity}}}, f, b);
  const double c = 4.0 * diffusivity * std::pow(std::sin(k / 2), 2), e = 0.25 / diffusivity;
  const double factor = (1.0 - e * c) / (1.0 + (1.0 - e) * c);
  for (int j = 0; j < 10; ++j) EXPECT_NEAR(f.amount[0][s.at(0, j)], 1.0 + 0.5 * factor * std::cos(k * j), 1e-14);
}

TEST(Diffusion, closed_lines_of_two_and_three_cells_are_right_as_well) {
  for (const int n : {2, 3}) {
    Scene s = make_scene({1, 1, n}, {true, true, true});
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    f.amount[0][s.at(0, 0, 0)] = 1.0;
    advance_scalars(s.rows, s.fluxes, 1.0, {{{Scheme::mc, 4.0}}}, f, b);
    // n = 2: both faces join the same pair; n = 3: a, and twice b = (1-a)/2.
    // n = 2: a - b decays by (1 - e c)/(1 + (1 - e) c) with c = 4 D, e = 1/(4 D); n = 3: c = 3 D.
    const double c = (n == 2 ? 4.0 : 3.0) * 4.0, e = 0.25 / 4.0;
    const double difference = (1.0 - e * c) / (1.0 + (1.0 - e) * c);
    EXPECT_NEAR(f.amount[0][s.at(0, 0, 0)] - f.amount[0][s.at(0, 0, 1)], difference, 1e-15) << n;
    EXPECT_NEAR(total(f, 0), 1.0, 1e-15);
  }
}

TEST(Diffusion, does_not_pass_a_closed_face) {
  Scene s = make_scene({10, 1, 1}, {false, true, true});
  s.fluxes.open[0][s.at(4)] = 0;
  for (const double diffusivity : {0.05, 5.0}) {
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    f.amount[0][s.at(4)] = 1.0;
    for (int n = 0; n < 3000; ++n) advance_scalars(s.rows, s.fluxes, 1.0, {{{Scheme::mc, diffusivity}}}, f, b);
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(f.amount[0][s.at(i)], i < 5 ? 0.2 : 0.0, 1e-9) << i;
  }
}

TEST(Diffusion, makes_no_new_extremum_at_any_diffusivity) {
  for (const double diffusivity : {1e-4, 0.02, 0.1, 0.5, 2.0, 100.0}) {
    Scene s = make_scene({12, 9, 7}, {true, false, false});
    set_curl(s, [](int d, int i, int j, int k) { return 0.05 * noise(9, d, i, j, k); });
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    for (const auto& run : s.rows.runs())
      for (int i = 0; i < run.count; ++i) f.amount[0][run.first + i] = noise(4, i, run.y, run.z, 0) > 0.0;
    for (int n = 0; n < 50; ++n) {
      advance_scalars(s.rows, s.fluxes, 5.0, {{{Scheme::mc, diffusivity}}}, f, b);
      for (const auto& run : s.rows.runs())
        for (int i = 0; i < run.count; ++i) {
          ASSERT_GE(f.amount[0][run.first + i], -1e-15) << diffusivity;
          ASSERT_LE(f.amount[0][run.first + i], 1.0 + 1e-13) << diffusivity;
        }
    }
  }
}

TEST(Diffusion, does_not_cost_many_sub_steps) {
  // Whatever the diffusivity, at most half again as many sub-steps as the flow alone needs (rounded up to whole ones).
  Scene s = make_scene({16, 16, 8}, {true, true, true});
  set_curl(s, [](int d, int i, int j, int k) { return 0.05 * noise(2, d, i, j, k); });
  const double steps = 20.0 * max_steps(s.rows, s.fluxes, 0.8);
  for (const double diffusivity : {1e-6, 1e-4, 1e-3, 5.5e-3, 0.02, 0.1, 1.0, 50.0}) {
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    f.amount[0][s.at(3, 3, 3)] = 1.0;
    ScalarOptions o{{{Scheme::mc, diffusivity}}};
    o.skip_empty = false;
    advance_scalars(s.rows, s.fluxes, steps, o, f, b);
    EXPECT_LE(b.sub_steps, 31) << diffusivity;
  }
}

}  // namespace
}  // namespace puffin::lbm
