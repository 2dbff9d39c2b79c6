// Values held on openings and walls.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "cases/case_error.hpp"
#include "tests/cases/fines_scene.hpp"

namespace puffin::cases {
namespace {

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
// What carriers set free is held too: nothing of it at the floor, so that the three scalars of the set add up to the
// value. Four diffusion times of the height, pi^2/4 a time in the exponent, leave e^-10 of what was there.
TEST(HeldValues, HoldTheSumOfWhatEveryMechanismBrings) {
  const auto s = scene("field = \"uniform\"\nvelocity = [0.0, 0.0, 0.0]\n", "",
                       "diffusion = \"1.2e-3 kg/(m s)\"\n"
                       "[[fines.boundary]]\npatch = \"z-min\"\nscalar = \"cloud\"\nvalue = 8e9\n");
  const auto& rows = s->state.air->rows;
  for (const auto m : {coupling::Mechanism::particle, coupling::Mechanism::drag})
    for (const auto& run : rows.runs())
      for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot)
        s->state.scalars.amount[coupling::scalar_index(0, m)][slot] = 8e-3;
  while (s->state.time < 1e-3 * (1 - 1e-12)) coupling::advance(s->models, 1e-3, s->state);
  for (int k = 0; k < 5; ++k) {
    double sum = 0.0;
    for (const auto& amount : s->state.scalars.amount) sum += amount[rows.active_slot(5, 2, k)];
    EXPECT_NEAR(sum, 8e-3, 3 * 8e-3 * 1.3 * std::exp(-9.8)) << k;
  }
  for (const auto& taken : s->state.budget.absorbed_at)
    EXPECT_GT(std::accumulate(taken.begin(), taken.end(), 0.0), 0.9 * 8e-3 * 250);
}

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

}  // namespace
}  // namespace puffin::cases
