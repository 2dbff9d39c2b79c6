// A diffusivity that differs from face to face, and walls that take.

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/scalars/wall_sinks.hpp"
#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

TEST(Eddy, a_uniform_one_is_the_same_as_the_scalars_own) {
  // The same arithmetic in another order of adding: rounding.
  Scene own = make_scene({24, 9, 7}, {true, false, false}), eddy = make_scene({24, 9, 7}, {true, false, false});
  for (int d = 0; d < 3; ++d) eddy.fluxes.eddy[d].assign(eddy.rows.slots(), 0.02);
  ScalarFields a = own.fields(), b = eddy.fields();
  ScalarBudget ba = own.budget(), bb = eddy.budget();
  a.amount[0][own.at(3, 4, 2)] = b.amount[0][eddy.at(3, 4, 2)] = 1.0;
  for (int n = 0; n < 30; ++n) {
    advance_scalars(own.rows, own.fluxes, 1.0, {{{Scheme::mc, 0.03}}}, a, ba);
    advance_scalars(eddy.rows, eddy.fluxes, 1.0, {{{Scheme::mc, 0.01}}}, b, bb);
  }
  double difference = 0.0;
  for (std::size_t s = 0; s < own.rows.slots(); ++s)
    difference = std::max(difference, std::abs(a.amount[0][s] - b.amount[0][s]));
  EXPECT_LT(difference, 1e-14);
  EXPECT_GT(a.amount[0][own.at(10, 4, 2)], 1e-8);  // it has spread
}

TEST(Eddy, keeps_the_amount_and_its_bounds_where_it_jumps) {
  Scene s = make_scene({20, 20, 6}, {false, false, true});
  set_curl(s, [](int d, int i, int j, int k) { return 0.05 * noise(3, d, i, j, k); });
  for (int d = 0; d < 3; ++d) {
    s.fluxes.eddy[d].assign(s.rows.slots(), 0.0);
    for (std::size_t n = 0; n < s.rows.slots(); ++n)
      if (s.fluxes.open[d][n] == 1 && s.rows.cell(n)[0] > 9) s.fluxes.eddy[d][n] = 0.2;
    for (const auto& [ghost, cell] : s.rows.periodic_images()) s.fluxes.eddy[d][ghost] = s.fluxes.eddy[d][cell];
  }
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 6; ++k) f.amount[0][s.at(i, j, k)] = 1.0;
  for (int n = 0; n < 200; ++n) advance_scalars(s.rows, s.fluxes, 4.0, {{{Scheme::mc, 0.0}}}, f, b);
  EXPECT_NEAR(total(f, 0), 1200.0, 1e-9);
  for (const double a : f.amount[0]) EXPECT_TRUE(a >= 0.0 && a <= 1.0 + 1e-12) << a;
}

TEST(WallSinks, take_the_exponential_part_and_book_it) {
  Scene s = make_scene({3, 1, 1}, {false, true, true});
  s.fluxes.sinks = {{s.at(0), 0.2}, {s.at(2), 0.0}};
  ScalarFields f = s.fields(2);
  ScalarBudget b = s.budget(2);
  f.amount[0][s.at(0)] = 5.0;
  f.amount[1][s.at(0)] = 1e-7;
  f.amount[0][s.at(2)] = 4.0;
  take_at_walls(s.fluxes, 3.0, {0, 1}, f, b);
  EXPECT_DOUBLE_EQ(f.amount[0][s.at(0)], 5.0 * std::exp(-0.6));
  EXPECT_EQ(f.amount[0][s.at(2)], 4.0);
  EXPECT_EQ(f.amount[0][s.at(0)] + b.absorbed_at[0][s.at(0)], 5.0);
  take_at_walls(s.fluxes, 1e6, {0, 1}, f, b);  // never more than there is
  EXPECT_GE(f.amount[1][s.at(0)], 0.0);
  EXPECT_NEAR(absorbed(b, 1), 1e-7, 1e-22);
}

}  // namespace
}  // namespace puffin::lbm
