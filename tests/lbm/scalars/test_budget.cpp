#include <gtest/gtest.h>

#include <cmath>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

/// A duct with a step, flow along x from patch 0 to patch 1, all of it through the openings, and eddies on top.
Scene duct() {
  const auto is_air = [](int i, int j, int) { return i < 12 || j > 2; };
  Scene s = make_scene({30, 8, 6}, {false, false, false}, true, is_air);
  set_curl(s, [](int d, int i, int j, int k) { return 0.02 * noise(5, d, i, j, k); });
  const Scene& c = s;
  // A straight part above the step.
  const auto eddies = c.fluxes.mass;
  set_flow(s, [](int d, int, int j, int) { return d == 0 && j > 2 ? 0.08 : 0.0; });
  for (int d = 0; d < 3; ++d)
    for (std::size_t n = 0; n < eddies[d].size(); ++n) s.fluxes.mass[d][n] += eddies[d][n];
  return s;
}

class BudgetIn : public testing::TestWithParam<bool> {};  // single: in float, and as exact
INSTANTIATE_TEST_SUITE_P(Numbers, BudgetIn, testing::Bool());

TEST_P(BudgetIn, a_closed_box_keeps_its_amount) {
  Scene s = make_scene({16, 12, 10}, {false, true, false});
  set_curl(s, [](int d, int i, int j, int k) { return 0.06 * noise(3, d, i, j, k); });
  ScalarFields f = s.fields(2);
  ScalarBudget b = s.budget(2);
  f.amount[0][s.at(4, 4, 4)] = 1000.0;
  f.amount[1][s.at(10, 4, 4)] = 1e-3;
  ScalarOptions o{{{Scheme::mc, 1e-3}, {Scheme::van_leer, 0.3}}};  // the second needs implicit lines
  o.single = GetParam();
  for (int n = 0; n < 400; ++n) advance_scalars(s.rows, s.fluxes, 3.0, o, f, b);
  // Rounding of one cell: 1e-16 of what it holds; random over 1e6 cell updates: 1e-16 of the total. 1e-13 is generous.
  EXPECT_NEAR(total(f, 0) / 1000.0, 1.0, 1e-13);
  EXPECT_NEAR(total(f, 1) / 1e-3, 1.0, 1e-13);
  EXPECT_EQ(gone(b, 0), 0.0);
  // Well stirred: the same everywhere, 1/1920 of the total.
  EXPECT_NEAR(f.amount[1][s.at(0, 0, 0)], 1e-3 / 1920, 1e-2 * 1e-3 / 1920);
}

TEST_P(BudgetIn, what_is_missing_has_left_through_the_outlet) {
  Scene s = duct();
  ScalarFields f = s.fields(3);
  ScalarBudget b = s.budget(3);
  ScalarOptions o{{{Scheme::upwind, 0.0}, {Scheme::mc, 1e-4}, {Scheme::mc, 0.5}}};
  o.single = GetParam();
  double given = 0.0;
  for (int n = 0; n < 600; ++n) {
    if (n < 50) {
      for (int k = 0; k < 3; ++k) f.amount[k][s.at(14, 4, n % 6)] += 2.0;
      given += 2.0;
    }
    advance_scalars(s.rows, s.fluxes, 4.0, o, f, b);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR((total(f, k) + gone(b, k)) / given, 1.0, 1e-12) << n;
  }
  for (int k = 0; k < 2; ++k) {
    EXPECT_LT(total(f, k), 1e-3 * given);  // it did leave
    EXPECT_NEAR(b.left[k][1].value() / given, 1.0, 1e-3);
    EXPECT_EQ(b.entered[k][0].value(), 0.0);
  }
}

TEST(Budget, books_inflow_and_outflow_to_the_last_amount) {
  // Plug flow that brings Y = 2: after one update of n steps, n * flux * faces * Y has entered, and all of it is in the
  // first cells.
  Scene s = make_scene({10, 3, 2}, {false, false, false}, true);
  set_flow(s, [](int d, int, int, int) { return d == 0 ? 0.125 : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  ScalarOptions o{{{}}};
  o.scalar[0].fixed = {2.0};
  advance_scalars(s.rows, s.fluxes, 4.0, o, f, b);
  EXPECT_DOUBLE_EQ(b.entered[0][0].value(), 4.0 * 0.125 * 6 * 2.0);
  EXPECT_DOUBLE_EQ(f.amount[0][s.at(0, 1, 1)], 1.0);
  EXPECT_EQ(f.amount[0][s.at(1, 1, 1)], 0.0);
  for (int n = 0; n < 100; ++n) advance_scalars(s.rows, s.fluxes, 4.0, o, f, b);
  EXPECT_NEAR(total(f, 0), 60 * 2.0, 1e-9);  // the duct is full, at the value of the inlet
  EXPECT_NEAR(b.entered[0][0].value() - b.left[0][1].value(), 120.0, 1e-9);
}

TEST(Budget, back_flow_through_the_outlet_brings_nothing_and_is_no_outflow) {
  Scene s = make_scene({10, 2, 2}, {false, false, false}, true);
  set_flow(s, [](int d, int, int, int) { return d == 0 ? -0.1 : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  f.amount[0][s.at(5, 1, 1)] = 1.0;
  for (int n = 0; n < 100; ++n) advance_scalars(s.rows, s.fluxes, 5.0, {{{}}}, f, b);
  EXPECT_NEAR(b.left[0][0].value(), 1.0, 1e-12);
  EXPECT_EQ(b.left[0][1].value(), 0.0);
}

TEST(Budget, absorbing_walls_book_what_they_take_by_cell) {
  Scene s = make_scene({6, 6, 6}, {false, false, false});
  for (const double diffusivity : {0.01, 2.0}) {  // in the sweeps, and by lines
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    f.amount[0][s.at(1, 2, 3)] = 5.0;
    ScalarOptions o{{{Scheme::mc, diffusivity, WallRule::absorb}}};
    for (int n = 0; n < 200; ++n) {
      advance_scalars(s.rows, s.fluxes, 1.0, o, f, b);
      ASSERT_NEAR(total(f, 0) + absorbed(b, 0), 5.0, 5e-12);
    }
    EXPECT_GT(absorbed(b, 0), 0.1);
    EXPECT_EQ(b.absorbed_at[0][s.at(2, 2, 2)], 0.0);  // not beside a wall
    EXPECT_GT(b.absorbed_at[0][s.at(0, 2, 3)], b.absorbed_at[0][s.at(5, 2, 3)]);
  }
}

TEST(Budget, compensated_sums_keep_what_plain_sums_lose) {
  CompensatedSum sum;
  double plain = 0.0;
  for (const double x : {1e16, 1.0, 1.0, -1e16}) sum.add(x), plain += x;
  EXPECT_EQ(sum.value(), 2.0);
  EXPECT_NE(plain, 2.0);
  const CompensatedSum copy = CompensatedSum::restored(sum.sum(), sum.lost());
  EXPECT_EQ(copy.value(), 2.0);
}

}  // namespace
}  // namespace puffin::lbm
