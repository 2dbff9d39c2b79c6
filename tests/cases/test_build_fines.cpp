// Fines that no carrier brings: clouds at the start, values held on openings and walls, frozen air that carries them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "cases/build.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases {
namespace {

/// A box of 1.0 x 0.5 x 0.5 mm in cells of 0.1 mm with frozen air; `more` goes to the end, `fines` to [fines].
std::unique_ptr<Simulation> scene(const std::string& field, const std::string& sides, const std::string& more,
                                  const std::string& fines = "", const std::string& dx = "0.1 mm") {
  const std::string text = R"toml(
schema = 1
name = "scene"
[geometry]
generator = "box"
[geometry.box]
x = "1 mm"
y = "0.5 mm"
z = "0.5 mm"
[numerics]
dx = ")toml" + dx + R"toml("
[stop]
time = "1 ms"
when_empty = false
[air]
model = "frozen"
density = "1.2 kg/m^3"
viscosity = "1.8e-5 Pa s"
)toml" + field + sides + "\n[fines]\n" +
                           fines + "[[fines.scalar]]\nname = \"cloud\"\n" + more;
  return build(parse_case(text, "scene.toml"));
}

constexpr const char* uniform = "field = \"uniform\"\nvelocity = [2.0, 0.0, 0.0]\n";
constexpr const char* through =
    "[[air.boundary]]\npatch = \"x-min\"\ntype = \"velocity-inlet\"\nvelocity = \"2 m/s\"\n"
    "[[air.boundary]]\npatch = \"x-max\"\ntype = \"pressure-outlet\"\n";
constexpr const char* around = "[[air.boundary]]\npatch = \"x-min\"\ntype = \"periodic\"\nwith = \"x-max\"\n";
constexpr const char* cloud =
    "diffusion = \"1.2e-6 kg/(m s)\"\n[fines.scalar.initial]\nshape = \"gaussian\"\ncenter = [2e-4, 2.5e-4, 0.0]\n"
    "sigma = \"0.1 mm\"\namount = 1000.0\n";

double sum_of_parts(const coupling::Ledger& l) {
  return l.on_carriers + l.on_emitted_carriers + l.on_walls + l.in_air + l.emitted;
}

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

// Air at 2 m/s brings 5e9 fines per m^3 through 0.25 mm^2: 2.5 in 1 ms. Diffusion from the face half a cell away brings
// 2 D/(U dx) = 0.01 of that besides, and takes as much back. The books hold what came in and what left.
TEST(HeldValues, BringFinesInWithTheAir) {
  const auto s = scene(
      uniform, through,
      "diffusion = \"1.2e-6 kg/(m s)\"\n[[fines.boundary]]\npatch = \"x-min\"\nscalar = \"cloud\"\nvalue = 5e9\n");
  while (s->state.time < 1e-3 * (1 - 1e-12)) coupling::advance(s->models, 1e-3, s->state);
  const coupling::Ledger books = coupling::ledger(s->state.fines, s->state.scalars, s->state.budget, 0);
  EXPECT_NEAR(books.loaded, 2.5 * 1.01 * s->state.time / 1e-3, 1e-9);
  EXPECT_NEAR(sum_of_parts(books), books.loaded, 1e-10 * books.loaded);
  // 0.5 ms to cross: the box is full, 5e9 per m^3 over 0.25 mm^3 but for the layer at the outlet, which holds nothing
  // back.
  EXPECT_NEAR(books.in_air, 5e9 * 0.25e-9, 1e-3 * 1.25);
}

// Air at rest between a floor that holds 8e9 fines per m^3, a ceiling that holds 2e9 and sides that hold nothing: 12
// diffusion times of the height, pi^2 a time in the exponent, lead to the straight profile, on cells exactly so. What
// the floor gives the ceiling takes, D (8e9 - 2e9)/h over the area, and nothing is lost.
TEST(HeldValues, OfWallsLeadToTheStraightProfile) {
  const auto s = scene("field = \"uniform\"\nvelocity = [0.0, 0.0, 0.0]\n", "",
                       "diffusion = \"1.2e-3 kg/(m s)\"\n"
                       "[[fines.boundary]]\npatch = \"z-min\"\nscalar = \"cloud\"\nvalue = 8e9\n"
                       "[[fines.boundary]]\npatch = \"z-max\"\nscalar = \"cloud\"\nvalue = 2e9\n");
  const auto run_to = [&](double end) {
    while (s->state.time < end * (1 - 1e-12)) coupling::advance(s->models, end, s->state);
    return coupling::ledger(s->state.fines, s->state.scalars, s->state.budget, 0);
  };
  const coupling::Ledger before = run_to(3e-3);  // h^2/D = 0.25 ms
  const double begin = s->state.time;
  const coupling::Ledger after = run_to(4e-3);
  const auto& rows = s->state.air->rows;
  for (int k = 0; k < 5; ++k)
    for (int i = 0; i < 10; ++i)
      EXPECT_NEAR(s->state.scalars.amount[0][rows.active_slot(i, 2, k)], (8e9 - 6e9 * (k + 0.5) / 5.0) * 1e-12, 1e-11)
          << i << ", " << k;
  // The books hold both ways of each wall: it gives 2 D/dx of its value through 0.5 mm^2, and takes what lies beside
  // it.
  const double floor_gives = 2.0 * 1e-3 / 1e-4 * 8e9 * 5e-7 * (s->state.time - begin),
               ceiling_gives = floor_gives / 4.0;
  EXPECT_NEAR(after.loaded - before.loaded, floor_gives + ceiling_gives, 1e-9 * floor_gives);
  EXPECT_NEAR(after.on_walls - before.on_walls, floor_gives + ceiling_gives, 1e-9 * floor_gives);
  EXPECT_NEAR(sum_of_parts(after), after.loaded, 1e-10 * after.loaded);
  const auto map = coupling::wall_map(s->state.fines, s->state.budget, 0, s->models.triangle_of_slot);
  EXPECT_NEAR(std::accumulate(map.begin(), map.end(), 0.0), after.on_walls, 1e-10 * after.on_walls);
}

// Every closed face is of the side that it looks at, also in the corners and where the walls lie within cells.
TEST(HeldValues, BelongToTheWallThatAFaceLooksAt) {
  std::string held = "diffusion = \"1.2e-6 kg/(m s)\"\n";
  for (const std::string side : {"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"})
    held += "[[fines.boundary]]\npatch = \"" + side + "\"\nscalar = \"cloud\"\nvalue = 1.0\n";
  for (const std::string dx : {"0.1 mm", "0.07 mm"}) {
    const auto s = scene("field = \"uniform\"\nvelocity = [0.0, 0.0, 0.0]\n", "", held, "", dx);
    std::array<std::set<int>, 3> places;  // of cells along each direction
    const auto& rows = s->state.air->rows;
    for (const auto& run : rows.runs())
      for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot)
        for (int d = 0; d < 3; ++d) places[d].insert(rows.cell(slot)[d]);
    for (int d = 0; d < 3; ++d) {
      const auto& faces = s->state.scalars.work.held_walls[d];
      EXPECT_EQ(faces.size(), 2 * places[(d + 1) % 3].size() * places[(d + 2) % 3].size()) << dx;
      for (const auto& face : faces)
        EXPECT_EQ(s->surface.patches.names[face.patch], std::string(1, "xyz"[d]) + (face.high ? "-max" : "-min")) << dx;
    }
  }
}

// With immersed walls the cells go on behind the wall: nothing is held there.
TEST(HeldValues, AreNotHeldBehindImmersedWalls) {
  const auto s = build(parse_case(R"toml(
schema = 1
name = "ibm"
geometry = { generator = "pipe", pipe = { diameter = "1 mm", length = "1 mm" } }
[numerics]
dx = "0.1 mm"
wall = "ibm"
reference_speed = 1.0
[[air.boundary]]
patch = "inlet"
type = "periodic"
with = "outlet"
[fines]
[[fines.scalar]]
name = "cloud"
[[fines.boundary]]
patch = "wall"
scalar = "cloud"
value = 1.0
[stop]
time = "1 ms"
)toml",
                                  "ibm.toml"));
  const lbm::Air& air = *s->state.air;
  std::size_t behind = 0, faces = 0;
  for (const auto& run : air.rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot) behind += !air.is_fluid(slot);
  EXPECT_GT(behind, 0u) << "else nothing is tested";
  for (const auto& in_direction : s->state.scalars.work.held_walls)
    for (const auto& face : in_direction) {
      EXPECT_TRUE(air.is_fluid(face.cell));
      ++faces;
    }
  EXPECT_GT(faces, 0u);
}

// What walls take is shown on walls, not on the periodic ends beside them.
TEST(WallMap, ShowsNothingOnPeriodicPatches) {
  auto s = scene(uniform, around, std::string("wall = \"absorb\"\n") + cloud);
  for (int n = 0; n < 20; ++n) coupling::advance(s->models, 1.0, s->state);
  const auto map = coupling::wall_map(s->state.fines, s->state.budget, 0, s->models.triangle_of_slot);
  double on_walls = 0.0;
  for (std::size_t t = 0; t < map.size(); ++t) {
    const std::string& patch = s->surface.patches.names[s->surface.patches.of_triangle[t]];
    if (patch == "x-min" || patch == "x-max") EXPECT_EQ(map[t], 0.0);
    on_walls += map[t];
  }
  EXPECT_GT(on_walls, 1.0);
}

TEST(HeldValues, OfPeriodicPatchesAreRefused) {
  try {
    scene(uniform, around,
          "diffusion = \"1e-6 kg/(m s)\"\n[[fines.boundary]]\npatch = \"x-max\"\nscalar = \"cloud\"\nvalue = 1.0\n");
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("periodic"), std::string::npos) << e.what();
    EXPECT_EQ(e.problems.at(0).key, "fines.boundary[0].patch");
  }
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
  // Face between cells 5 and 6 at x = 0.6 mm, y = 0.35 mm: u = -omega (y - 0.2 mm) = -0.15 m/s.
  EXPECT_NEAR(mass[0][rows.slot(5, 3, 2)], -0.15 * s->state.scale.dt / 1e-4, 1e-12);
}

}  // namespace
}  // namespace puffin::cases
