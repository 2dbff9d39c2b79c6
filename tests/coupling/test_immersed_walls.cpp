// Immersed boundaries have cells of air behind them: no fines get there.

#include <gtest/gtest.h>

#include "cases/build.hpp"
#include "cases/read_case.hpp"
#include "coupling/advance_together.hpp"

namespace puffin::cases {
namespace {

/// The L-bend: flow along walls, into them and back.
constexpr const char* duct = R"CASE(
schema = 1
name = "duct"
[geometry]
generator = "l-bend"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "0 L/min"], ["1 ms", "18 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.5 mm"
reference_speed = "40 m/s"
wall = "ibm"
[carriers]
diameter = "70 um"
density = "1520 kg/m^3"
fines_each = 2000
fine_mass_ratio = 2e-5
list = [{ position = [0.03, 0.0, 0.0015], velocity = [10, 0, 0] }]
[fines]
micromodels = "cases/micromodels/lactose-3.6e-3.toml"
[[fines.scalar]]
name = "fines"
diffusion = "1e-6 kg/(m s)"
[stop]
time = "1 s"
)CASE";

struct Amounts {
  double before_walls = 0.0, behind = 0.0;
  std::size_t cells_behind = 0;
};
Amounts amounts(const coupling::State& s, int scalar) {
  Amounts found;
  for (const auto& run : s.air->rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) {
      const bool fluid = s.air->is_fluid(slot);
      found.cells_behind += !fluid;
      (fluid ? found.before_walls : found.behind) += s.scalars.amount[scalar][slot];
    }
  return found;
}

TEST(ImmersedWalls, let_no_fines_behind_them) {
  const auto simulation = build(parse_case(duct, PUFFIN_SOURCE_DIR "/duct.toml"));
  coupling::State& s = simulation->state;
  const auto until = [&](double time) {
    while (s.time < time) coupling::advance(simulation->models, time, s);
  };
  until(2e-3);
  double given = 0.0;
  for (const auto& run : s.air->rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot)
      if (s.air->is_fluid(slot)) {
        s.scalars.amount[0][slot] += 1000.0;
        given += 1000.0;
      }
  s.airborne = true;
  until(3e-3);
  const Amounts now = amounts(s, 0);
  EXPECT_GT(now.cells_behind, 1000U);
  EXPECT_EQ(now.behind, 0.0);  // their faces are closed: not little, nothing
  EXPECT_GT(s.budget.sub_steps, 100);
  EXPECT_GT(lbm::gone(s.budget, 0), 0.01 * given);  // it was carried: a hundredth and more is out
  given += s.fines.to_air[0].value();               // of the one carrier
  EXPECT_NEAR((lbm::total(s.scalars, 0) + lbm::gone(s.budget, 0)) / given, 1.0, 1e-12);
}

}  // namespace
}  // namespace puffin::cases
