#include <gtest/gtest.h>

#include <cmath>

#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

template <class Change>
void expect_refused(Change change) {
  Scene s = make_scene({6, 4, 4}, {false, true, false}, true);
  ScalarOptions o{{{}}};
  double steps = 1.0;
  ScalarBudget b = s.budget();
  change(s, o, steps, b);
  ScalarFields f = s.fields();
  EXPECT_THROW(advance_scalars(s.rows, s.fluxes, steps, o, f, b), std::invalid_argument);
}

TEST(Refusals, options_out_of_range) {
  expect_refused([](Scene&, ScalarOptions& o, double&, ScalarBudget&) { o.cfl = 1.0; });
  expect_refused([](Scene&, ScalarOptions& o, double&, ScalarBudget&) { o.cfl = 0.0; });
  expect_refused([](Scene&, ScalarOptions& o, double&, ScalarBudget&) { o.scalar.clear(); });
  expect_refused([](Scene&, ScalarOptions& o, double&, ScalarBudget&) { o.scalar[0].diffusivity = -1.0; });
  expect_refused([](Scene&, ScalarOptions& o, double&, ScalarBudget&) { o.scalar[0].diffusivity = NAN; });
  expect_refused([](Scene&, ScalarOptions& o, double&, ScalarBudget&) { o.scalar[0].fixed = {-1.0}; });
  expect_refused([](Scene&, ScalarOptions&, double& steps, ScalarBudget&) { steps = -1.0; });
  expect_refused([](Scene&, ScalarOptions&, double& steps, ScalarBudget&) { steps = NAN; });
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget& b) { b = ScalarBudget(s.rows, 1, 1); });
}

TEST(Refusals, fluxes_that_do_not_fit_the_rows) {
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget&) { s.fluxes.mass[1].pop_back(); });
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget&) { s.fluxes.density.clear(); });
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget&) { s.fluxes.density[s.at(1, 1, 1)] = 0.0; });
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget&) { s.fluxes.open[2][s.at(1, 1, 3)] = 1; });
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget&) { s.fluxes.open[0][s.at(5, 1, 1)] = 1; });
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget&) { s.opening_patch.assign(s.rows.slots(), -1); });
  expect_refused([](Scene& s, ScalarOptions&, double&, ScalarBudget&) { s.fluxes.mass[1][s.at(2, 3, 1)] = 0.1; });
}

}  // namespace
}  // namespace puffin::lbm
