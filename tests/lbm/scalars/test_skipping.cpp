#include <gtest/gtest.h>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

Scene stirred() {
  Scene s = make_scene({40, 30, 12}, {false, true, false});
  set_curl(s, [](int d, int i, int j, int k) { return 0.06 * noise(11, d, i, j, k); });
  return s;
}

TEST(Skipping, nothing_is_computed_while_everything_is_empty) {
  Scene s = stirred();
  ScalarFields f = s.fields(3);
  ScalarBudget b = s.budget(3);
  for (int n = 0; n < 5; ++n) advance_scalars(s.rows, s.fluxes, 4.0, {{{}, {}, {}}}, f, b);
  EXPECT_EQ(b.sub_steps, 0);
  EXPECT_EQ(b.cells_computed, 0);
}

class SkippingIn : public testing::TestWithParam<bool> {};  // single: in float
INSTANTIATE_TEST_SUITE_P(Numbers, SkippingIn, testing::Bool());

TEST_P(SkippingIn, changes_no_bit) {
  Scene s = stirred();
  const double steps = max_steps(s.rows, s.fluxes, 0.8);
  ScalarFields f[2] = {s.fields(2), s.fields(2)};
  ScalarBudget b[2] = {s.budget(2), s.budget(2)};
  for (int n = 0; n < 40; ++n) {
    for (int skip = 0; skip < 2; ++skip) {
      if (n == 0) f[skip].amount[0][s.at(3, 3, 3)] = 7.0;
      if (n == 10) f[skip].amount[1][s.at(30, 29, 10)] = 1.0;
      ScalarOptions o{{{Scheme::mc, 0.0}, {Scheme::van_leer, 1e-5}}};
      o.skip_empty = skip;
      o.single = GetParam();
      advance_scalars(s.rows, s.fluxes, steps, o, f[skip], b[skip]);
    }
    // Cells with less than 1e-30 of the total rest, whether their run is computed or not.
    for (int k = 0; k < 2; ++k) ASSERT_EQ(f[0].amount[k], f[1].amount[k]) << n;
  }
  EXPECT_GT(b[1].cells_skipped, 0);
  EXPECT_EQ(b[0].cells_skipped, 0);
  EXPECT_EQ(b[0].cells_computed, b[1].cells_computed + b[1].cells_skipped);
}

TEST(Skipping, one_of_many_scalars_has_the_bits_it_has_alone) {
  Scene s = stirred();
  const double steps = 2.5 * max_steps(s.rows, s.fluxes, 0.8);  // several sub-steps
  ScalarFields together = s.fields(11), alone = s.fields(1);
  ScalarBudget b11 = s.budget(11), b1 = s.budget(1);
  ScalarOptions many, one{{{Scheme::mc, 1e-5}}};
  many.scalar.assign(11, one.scalar[0]);
  many.scalar[3].scheme = Scheme::upwind;
  for (int k = 0; k < 11; ++k) together.amount[k][s.at(3 + k, 3, 3)] = 1.0 + k;
  alone.amount[0][s.at(13, 3, 3)] = 11.0;
  for (int n = 0; n < 5; ++n) {
    advance_scalars(s.rows, s.fluxes, steps, many, together, b11);
    advance_scalars(s.rows, s.fluxes, steps, one, alone, b1);
  }
  EXPECT_EQ(together.amount[10], alone.amount[0]);
  EXPECT_EQ(b11.air_mismatch, b1.air_mismatch);
}

TEST(Skipping, a_scalar_of_next_to_nothing_rests_until_there_is_more) {
  Scene s = stirred();
  const double steps = max_steps(s.rows, s.fluxes, 0.8);
  ScalarFields together = s.fields(2), alone = s.fields(1);
  ScalarBudget b2 = s.budget(2), b1 = s.budget(1);
  ScalarOptions both{{{Scheme::mc, 1e-5}, {Scheme::mc, 0.0}}}, one{{{Scheme::mc, 1e-5}}};
  both.negligible = 1e-9;
  together.amount[0][s.at(3, 3, 3)] = alone.amount[0][s.at(3, 3, 3)] = 1.0;
  together.amount[1][s.at(9, 9, 6)] = 1e-10;
  for (int n = 0; n < 5; ++n) {
    advance_scalars(s.rows, s.fluxes, steps, both, together, b2);
    advance_scalars(s.rows, s.fluxes, steps, one, alone, b1);
  }
  EXPECT_EQ(together.amount[0], alone.amount[0]);  // to the bit
  EXPECT_EQ(together.amount[1][s.at(9, 9, 6)], 1e-10);

  together.amount[1][s.at(9, 9, 6)] += 1.0;
  for (int n = 0; n < 5; ++n) advance_scalars(s.rows, s.fluxes, steps, both, together, b2);
  EXPECT_LT(together.amount[1][s.at(9, 9, 6)], 0.9);
  EXPECT_NEAR(total(together, 1), 1.0 + 1e-10, 1e-14);
}

TEST(Skipping, forgets_a_cloud_that_has_left) {
  Scene s = make_scene({30, 4, 4}, {false, false, false}, true);
  set_flow(s, [](int d, int, int, int) { return d == 0 ? 0.1 : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  f.amount[0][s.at(2, 2, 2)] = 1.0;
  for (int n = 0; n < 400; ++n) advance_scalars(s.rows, s.fluxes, 8.0, {{{}}}, f, b);
  // It is gone but for the tail of the scheme; a second cloud elsewhere finds clean cells.
  f.amount[0][s.at(2, 0, 0)] = 1.0;
  advance_scalars(s.rows, s.fluxes, 8.0, {{{}}}, f, b);
  EXPECT_NEAR(total(f, 0) + gone(b, 0), 2.0, 1e-12);
}

}  // namespace
}  // namespace puffin::lbm
