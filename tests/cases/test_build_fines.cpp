// Fines that no carrier brings: clouds at the start, frozen air that carries them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "coupling/checkpoint/checkpoint.hpp"
#include "lbm/scalars/run_faces.hpp"
#include "tests/cases/fines_scene.hpp"

namespace puffin::cases {
namespace {

// The map of the walls adds up to what walls took, to rounding of 250 summands of the amount.
TEST(WallMap, KnowsFinesThatNoCarrierBrought) {
  auto s = scene(uniform, around, std::string("wall = \"absorb\"\n") + cloud);
  for (int n = 0; n < 20; ++n) coupling::advance(s->models, 1.0, s->state);
  const auto map = coupling::wall_map(s->state.fines, s->state.budget, 0, s->models.triangle_of_slot);
  ASSERT_EQ(map.size(), s->surface.mesh.triangles.size());
  double stuck = 0.0, absorbed = 0.0;
  for (const double m : map) stuck += m;
  for (int m = 0; m < coupling::mechanisms; ++m) absorbed += lbm::absorbed(s->state.budget, m);
  EXPECT_GT(absorbed, 1.0);
  EXPECT_NEAR(stuck, absorbed, 1e-10);
}

// Half of this cloud lies below the floor: what is above is scaled to the amount. Rounding of 250 summands.
TEST(Clouds, AreCutAtWallsAndHoldTheirAmount) {
  const auto s = scene(uniform, around, cloud);
  EXPECT_NEAR(lbm::total(s->state.scalars, 0), 1000.0, 1e-10);
  EXPECT_EQ(lbm::total(s->state.scalars, 1), 0.0);
  const auto& rows = s->state.air->rows;
  const double near = s->state.scalars.amount[0][rows.active_slot(1, 2, 0)];
  const double far = s->state.scalars.amount[0][rows.active_slot(3, 2, 0)];
  EXPECT_NEAR(far / near, std::exp(-0.5 * (1.5 * 1.5 - 0.5 * 0.5)), 1e-12) << "cells at -0.5 and 1.5 sigma in x";
}

// Uniform air takes the cloud with it: after 0.1 ms its middle is 0.2 mm further, mixed by the scheme but unshifted.
// The box is 10 sigma long and periodic; one cell is the tolerance of a mean over it. The ledger closes to rounding.
TEST(Clouds, TravelWithFrozenAirAndStayInTheBooks) {
  const auto s = scene(uniform, around, cloud);
  while (s->state.time < 1e-4 * (1 - 1e-12)) coupling::advance(s->models, 1e-4, s->state);
  EXPECT_NEAR(s->state.time, 1e-4, s->state.scale.dt);
  double mean = 0.0;
  const auto& rows = s->state.air->rows;
  for (std::size_t n = 0; n < rows.slots(); ++n)
    if (rows.is_active(static_cast<std::ptrdiff_t>(n)))
      mean += s->state.scalars.amount[0][n] * rows.centre(static_cast<std::ptrdiff_t>(n)).x() / 1000.0;
  EXPECT_NEAR(mean, 4e-4, 0.5e-4);
  const coupling::Ledger books = coupling::ledger(s->state.fines, s->state.scalars, s->state.budget, 0);
  EXPECT_NEAR(books.loaded, 1000.0, 1e-10);
  EXPECT_LT(std::abs(books.error()), 1e-12);
}

// What walls take is shown on walls, not on the periodic ends beside them.
TEST(WallMap, ShowsNothingOnPeriodicPatches) {
  auto s = scene(uniform, around, std::string("wall = \"absorb\"\n") + cloud);
  for (int n = 0; n < 20; ++n) coupling::advance(s->models, 1.0, s->state);
  const auto map = coupling::wall_map(s->state.fines, s->state.budget, 0, s->models.triangle_of_slot);
  double on_walls = 0.0;
  for (std::size_t t = 0; t < map.size(); ++t) {
    const std::string& patch = s->surface.patches.names[s->surface.patches.of_triangle[t]];
    if (patch == "x-min" || patch == "x-max") {
      EXPECT_EQ(map[t], 0.0);
    }
    on_walls += map[t];
  }
  EXPECT_GT(on_walls, 1.0);
}

// As long as a scalar holds no more than this, it rests: the three of a set together stay below the millionth of the
// dose at which a run counts as empty. What a case puts into the air itself is watched more closely.
TEST(RestingScalars, HoldLessThanWhatCountsAsEmpty) {
  const auto released =
      scene(uniform, around,
            "[carriers]\nfines_each = 2000\nlist = [ { position = [5e-4, 2.5e-4, 2.5e-4], velocity = [0.0, "
            "0.0, 0.0], diameter = 7e-5, density = 1520 } ]\n[carriers.contact]\nrestitution = 0.6\n"
            "friction = 0.3\n",
            "micromodels = \"lactose-3.6e-3.toml\"\n");
  EXPECT_DOUBLE_EQ(released->state.fines.loaded, 2000.0);
  EXPECT_DOUBLE_EQ(released->models.scalars.negligible, 3e-7 * 2000.0);
  EXPECT_LT(coupling::mechanisms * released->models.scalars.negligible, 1e-6 * 2000.0);
  EXPECT_DOUBLE_EQ(scene(uniform, around, cloud)->models.scalars.negligible, 1e-9 * 1000.0);
}

/// A box of 1 mm without air; the carrier hits the floor once, at 2 m/s, within the 0.2 ms that are run.
Simulation& dry(std::unique_ptr<Simulation>& s) {
  const std::string text = R"toml(
schema = 1
name = "dry"
geometry = { generator = "box", box = { x = "1 mm", y = "1 mm", z = "1 mm" } }
air = { model = "none" }
[carriers]
list = [
  { position = [5e-4, 5e-4, 1.35e-4], velocity = [0.0, 0.0, -2.0], diameter = 7e-5, density = 1520 },
  { position = [5e-4, 2e-4, 5e-4], velocity = [0.0, 0.0, 0.0], diameter = 5e-5, density = 1000 } ]
fines_each = 2000
gravity = [0.0, 0.0, 0.0]
[fines]
micromodels = "lactose-3.6e-3.toml"
[[fines.scalar]]
name = "a"
[stop]
time = "0.2 ms"
)toml";
  s = build(parse_case(text, "dry.toml", {}));
  while (s->state.time < s->description.stop.time * (1.0 - 1e-12))
    coupling::advance(s->models, s->description.stop.time, s->state);
  return *s;
}

// Nothing about the fines need be said that the list says. What the hit takes is what the law says of 2 m/s.
TEST(DryFines, LeaveTheirCarrierAndStayInTheBooks) {
  std::unique_ptr<Simulation> owner;
  const Simulation& s = dry(owner);
  EXPECT_NEAR(s.description.fines->diameter, 7e-5 * std::cbrt(2e-5), 1e-12);
  EXPECT_EQ(s.description.fines->density, 1520.0);
  EXPECT_EQ(s.description.fines->scalars[0].diffusion, 1e-6);
  const auto taken = micromodels::impact_on_wall(*s.models.fines, 2.0, 90.0, 2000.0, 2000.0);
  ASSERT_GT(taken.to_air, 0.0);
  const coupling::Ledger books = coupling::ledger(s.state.fines, s.state.scalars, s.state.budget, 0);
  EXPECT_NEAR(books.loaded, 4000.0, 1e-9);
  EXPECT_NEAR(books.in_air, taken.to_air, 1e-6 * taken.to_air);
  EXPECT_NEAR(books.on_walls, taken.to_wall, 1e-6 * taken.to_air);
  EXPECT_NEAR(books.error(), 0.0, 1e-14);
}

// A rotation about z has no divergence; per face it varies in the other directions alone: cells without a closed face
// balance to rounding of four numbers below 1.
TEST(FrozenAir, TurningAsASolidBalancesInEveryInnerCell) {
  const auto s = scene("field = \"solid-body\"\naxis = [0, 0, 1]\ncenter = [4e-4, 2e-4, 0]\nomega = 1000\n", "", cloud);
  const auto& rows = s->state.air->rows;
  const auto& mass = s->state.fluxes.mass;
  int inner = 0;
  for (int k = 0; k < 5; ++k)
    for (int j = 1; j < 4; ++j)
      for (int i = 1; i < 9; ++i) {
        const auto at = [&](int d, int a, int b, int c) { return mass[d][rows.slot(a, b, c)]; };
        const double net = at(0, i, j, k) - at(0, i - 1, j, k) + at(1, i, j, k) - at(1, i, j - 1, k);
        EXPECT_NEAR(net, 0.0, 1e-15);
        ++inner;
      }
  EXPECT_EQ(inner, 120);
  // Where such a field crosses the closed sides, it is said of each; floor and roof it only slides along.
  int told = 0;
  for (const std::string& text : s->warnings) told += text.find("air.field blows through the patch '") == 0;
  EXPECT_EQ(told, 4);
  // Face between cells 5 and 6 at x = 0.6 mm, y = 0.35 mm: u = -omega (y - 0.2 mm) = -0.15 m/s.
  EXPECT_NEAR(mass[0][rows.slot(5, 3, 2)], -0.15 * s->state.scale.dt / 1e-4, 1e-12);
}

// A retreat makes the steps shorter, here by eight: the fines go on at 2 m/s and settle as before, and so it is told.
TEST(FrozenAir, CarriesAsFarInShorterSteps) {
  const std::string inertial =
      "wall_deposition = \"inertial\"\ngravity = [0.0, 0.0, -4000.0]\ndiameter = \"2 um\"\ndensity = 1500\n";
  const auto start = [&] {
    auto s = scene(uniform, around, cloud, inertial);
    s->state.step_factor = 0.125;
    return s;
  };
  const auto advance_to = [](Simulation& s, double end) {
    while (s.state.time < end * (1 - 1e-12)) coupling::advance(s.models, end, s.state);
  };
  const auto whole = scene(uniform, around, cloud, inertial), cut = start();
  coupling::Checkpoint middle;
  advance_to(*whole, 0.3e-3);
  advance_to(*cut, 0.15e-3);
  coupling::save(cut->state, middle);
  advance_to(*cut, 0.3e-3);
  ASSERT_LT(cut->state.scale.dt, 0.13 * whole->state.scale.dt);
  const auto books = [](const Simulation& s) {
    return coupling::ledger(s.state.fines, s.state.scalars, s.state.budget, 0);
  };
  const auto place = [](const Simulation& s) {  // of the airborne fines, by angle around the periodic box
    double x = 0.0, y = 0.0;
    const auto& rows = s.state.air->rows;
    for (const auto& run : rows.runs())
      for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) {
        const double angle = 2.0 * std::numbers::pi * rows.centre(slot)[0] / 1e-3;
        x += s.state.scalars.amount[0][slot] * std::cos(angle);
        y += s.state.scalars.amount[0][slot] * std::sin(angle);
      }
    return std::atan2(y, x) / (2.0 * std::numbers::pi) * 1e-3;
  };
  // Steps of another length cut the cloud's flanks otherwise: a tenth of a cell, and some per cent of what settles.
  for (const Simulation* sim : {whole.get(), cut.get()})
    EXPECT_NEAR(place(*sim), 2e-4 + 2.0 * sim->state.time - 1e-3, 1e-5);
  EXPECT_GT(books(*whole).on_walls, 100.0);
  EXPECT_NEAR(books(*cut).on_walls / books(*whole).on_walls, 1.0, 0.05);
  // And from a checkpoint to the same bits.
  const auto resumed = start();
  coupling::restore(middle, resumed->state);
  advance_to(*resumed, 0.3e-3);
  EXPECT_EQ(resumed->state.scalars.amount, cut->state.scalars.amount);
  EXPECT_EQ(resumed->state.budget.absorbed_at, cut->state.budget.absorbed_at);
}

// The cells of an oblique outlet have sides that take no flux and are no wall: what absorbs is within reach of one.
TEST(AbsorbingWalls, EndAtAnObliqueOpening) {
  const auto s = build(parse_case(R"toml(
schema = 1
name = "bend"
[geometry]
generator = "bend"
[geometry.bend]
width = "7 mm"
height = "7 mm"
angle = 0.7853982
inlet_length = "4 mm"
outlet_length = "4 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
velocity = "5 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.7 mm"
[fines]
[[fines.scalar]]
name = "one"
diffusion = "1e-5 kg/(m s)"
wall = "absorb"
[[fines.scalar]]
name = "two"
diffusion = "1e-3 kg/(m s)"
wall = "absorb"
[stop]
time = "8 ms"
)toml",
                                  "bend.toml"));
  const auto& rows = s->state.air->rows;
  int passed_over = 0;
  for (const auto& run : rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) {
      for (auto& amount : s->state.scalars.amount) amount[slot] = 1.0;
      for (int d = 0; d < 3; ++d)
        for (const std::ptrdiff_t face : {slot, slot + lbm::offset_low(run, d)}) {
          passed_over += s->state.fluxes.open[d][face] == lbm::passed_over;
          if (s->state.fluxes.open[d][face] == 0) {
            EXPECT_GE(s->models.triangle_of_slot[slot], 0) << slot;
          }
        }
    }
  EXPECT_GT(passed_over, 50);  // ten cells across and ten along: one of the two sides of each, more or less
  s->state.airborne = true;
  for (int n = 0; n < 10; ++n) coupling::advance(s->models, 8e-3, s->state);
  for (int set = 0; set < 2; ++set) {
    const auto map = coupling::wall_map(s->state.fines, s->state.budget, set, s->models.triangle_of_slot);
    const double on_walls = coupling::ledger(s->state.fines, s->state.scalars, s->state.budget, set).on_walls;
    EXPECT_GT(on_walls, 0.0);
    EXPECT_NEAR(std::accumulate(map.begin(), map.end(), 0.0), on_walls, 1e-10 * on_walls);
  }
}

}  // namespace
}  // namespace puffin::cases
