#include <gtest/gtest.h>

#include <cmath>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

TEST(StepLimit, is_the_courant_number_in_a_uniform_flow) {
  Scene s = make_scene({8, 8, 8}, {true, true, true});
  set_flow(s, [](int d, int, int, int) { return d == 0 ? 0.1 : d == 1 ? -0.2 : 0.05; });
  EXPECT_NEAR(max_steps(s.rows, s.fluxes, 0.8), 4.0, 1e-12);
}

TEST(StepLimit, is_infinite_in_air_at_rest) {
  Scene s = make_scene({4, 4, 4}, {true, true, true});
  EXPECT_TRUE(std::isinf(max_steps(s.rows, s.fluxes, 0.8)));
}

TEST(StepLimit, ignores_what_is_said_of_closed_faces) {
  Scene s = make_scene({4, 4, 4}, {false, false, false});
  s.fluxes.mass[0][s.at(3, 2, 2)] = 0.4;
  EXPECT_TRUE(std::isinf(max_steps(s.rows, s.fluxes, 0.8)));
}

TEST(StepLimit, minds_the_air_that_earlier_sweeps_took) {
  // After the x sweep of the jet 1 - 0.2 n is left, from which 0.2 n leaves in y: n 0.2 (1 + cfl) <= cfl. And after x
  // and y together at least half must be left: n 0.4 <= 0.5.
  const Scene s = make_jet();
  EXPECT_NEAR(max_steps(s.rows, s.fluxes, 0.3), 0.3 / 0.26, 1e-12);
  EXPECT_NEAR(max_steps(s.rows, s.fluxes, 0.5), 1.25, 1e-12);
}

TEST(StepLimit, longer_updates_are_divided) {
  Scene s = make_scene({16, 4, 4}, {true, true, true});
  set_flow(s, [](int d, int, int, int) { return d == 0 ? 0.1 : 0.0; });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  f.amount[0][s.at(2, 2, 2)] = 1.0;
  advance_scalars(s.rows, s.fluxes, 40.0, {{{}}}, f, b);  // 4 cells at 0.8 of a cell each: 5, in pairs 3
  EXPECT_EQ(b.sub_steps, 3);
}

TEST(StepLimit, an_emptied_cell_is_an_error_with_a_hint) {
  Scene s = make_scene({4, 4, 4}, {false, false, false});
  s.fluxes.mass[0][s.at(1, 1, 1)] = 0.4;  // and nothing comes in
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  f.amount[0][s.at(1, 1, 1)] = 1.0;
  EXPECT_THROW(advance_scalars(s.rows, s.fluxes, 3.0, {{{}}}, f, b), std::runtime_error);
}

}  // namespace
}  // namespace puffin::lbm
