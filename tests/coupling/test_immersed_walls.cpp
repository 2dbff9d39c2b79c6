// Immersed boundaries have cells of air behind them: no fines get there.

#include <gtest/gtest.h>

#include "tests/coupling/checkpoint/coupled_scene.hpp"

namespace puffin::coupling {
namespace {

struct Behind {
  double amount = 0.0;
  int cells = 0;
};
Behind behind_walls(const State& s) {
  Behind found;
  for (const auto& run : s.air->rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) {
      if (s.air->is_fluid(slot)) continue;
      ++found.cells;
      found.amount += s.scalars.amount[0][slot];
    }
  return found;
}

TEST(ImmersedWalls, let_no_fines_behind_them) {
  const auto simulation = coupled_simulation({{"numerics.wall", "\"ibm\""}, {"fines.wall_deposition", "\"none\""}});
  State& s = simulation->state;
  const auto until = [&](double time) {
    while (s.time < time) advance(simulation->models, time, s);
  };
  until(0.5e-3);
  double given = 0.0;
  for (const auto& run : s.air->rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot)
      if (s.air->is_fluid(slot)) {
        s.scalars.amount[0][slot] += 1000.0;
        given += 1000.0;
      }
  s.airborne = true;
  until(1.5e-3);
  const Behind behind = behind_walls(s);
  EXPECT_GT(behind.cells, 1000);
  EXPECT_EQ(behind.amount, 0.0);  // their faces are closed: not little, nothing
  EXPECT_GT(s.budget.sub_steps, 100);
  EXPECT_GT(lbm::gone(s.budget, 0), 0.01 * given);  // it was carried: a hundredth and more is out
  given += s.fines.to_air[0].value();               // of the carriers
  EXPECT_NEAR((lbm::total(s.scalars, 0) + lbm::gone(s.budget, 0)) / given, 1.0, 1e-12);
}

}  // namespace
}  // namespace puffin::coupling
