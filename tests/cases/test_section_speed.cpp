// The largest section-mean speed: where the passage is narrowest, whichever way it turns.

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <string>

#include "cases/assessment.hpp"
#include "cases/derived.hpp"
#include "cases/read_case.hpp"
#include "cases/section_speed.hpp"
#include "lbm/geometry/voxelize.hpp"

namespace puffin::cases {
namespace {

Case scene(const std::string& geometry, const std::string& dx, const std::string& in, const std::string& out,
           const std::string& more = "") {
  return parse_case("name = \"x\"\nnumerics = { dx = \"" + dx + "\" }\nstop = { time = \"1 ms\" }\ngeometry = { " +
                        geometry + " }\n[air]\ndensity = 1.2\nviscosity = 1.8e-5\n[[air.boundary]]\npatch = \"" + in +
                        "\"\ntype = \"velocity-inlet\"\nvelocity = \"10 m/s\"\n[[air.boundary]]\npatch = \"" + out +
                        "\"\ntype = \"pressure-outlet\"\n" + more,
                    "x.toml");
}

double ratio_of(const Case& c) {
  const Surface s = load_surface(c);
  const lbm::geometry::TriangleTree tree(s.mesh);
  lbm::geometry::VoxelizeOptions options;
  options.periodic = periodic_directions(c, s);
  return section_ratio(c, s, tree, lbm::geometry::voxelize(tree, *c.numerics.dx, options));
}

constexpr const char* duct = R"(generator = "duct", duct = { length = "20 mm", width = "3 mm", height = "2 mm" })";
constexpr const char* pipe = R"(generator = "pipe", pipe = { length = "20 mm", diameter = "4 mm" })";
constexpr const char* bend = R"(generator = "bend", bend = { width = "4 mm", height = "4 mm", radius = "6 mm" })";
constexpr const char* step =
    R"(generator = "step", step = { inlet_height = "3 mm", step_height = "6 mm", width = "2 mm", inlet_length = "12 mm", outlet_length = "20 mm", periodic = true })";
constexpr const char* across = R"([[air.boundary]]
patch = "y-min"
type = "periodic"
with = "y-max"
)";

TEST(SectionSpeed, IsThatOfTheInletWhereNothingIsNarrower) {
  EXPECT_EQ(ratio_of(scene(duct, "0.25 mm", "inlet", "outlet")), 1.0);
  EXPECT_EQ(ratio_of(scene(pipe, "0.25 mm", "inlet", "outlet")), 1.0);
  EXPECT_EQ(ratio_of(scene(step, "0.25 mm", "inlet", "outlet", across)), 1.0);  // a widening
}

// From 9 to 3 mm: 3 on cells that fit, but for the curved sections at the step, in blocks of a twelfth of the passage:
// (1/12)^2 of it.
TEST(SectionSpeed, OfANarrowingIsThatOfContinuity) {
  EXPECT_NEAR(ratio_of(scene(step, "0.25 mm", "outlet", "inlet", across)), 3.0, 3.0 / 144.0);
  // 7.5 and 22.5 cells: each section is found to half of one.
  EXPECT_NEAR(ratio_of(scene(step, "0.4 mm", "outlet", "inlet", across)), 3.0, 3.0 * 0.5 * (1.0 / 7.5 + 1.0 / 22.5));
}

// A cylinder of 2 mm across a channel of 5 mm leaves 3: 5/3, found to one of 12 cells of each gap, and the sections,
// which bow out from the gap, are longer than it.
TEST(SectionSpeed, SeesAnObstacleInTheWay) {
  const Case c = scene(
      R"(generator = "obstacle", obstacle = { shape = "cylinder", length = "20 mm", width = "5 mm", height = "0.5 mm", diameter = "2 mm", center = ["8 mm", "2.5 mm", "0.25 mm"] })",
      "0.125 mm", "inlet", "outlet", "[[air.boundary]]\npatch = \"z-min\"\ntype = \"periodic\"\nwith = \"z-max\"\n");
  EXPECT_NEAR(ratio_of(c), 5.0 / 3.0, 5.0 / 3.0 / 12.0);
}

// There, back and there again through three channels side by side, parted by walls of one cell in blocks of four; half
// of the middle one is closed for a while: 20 cells' flow through 10. Leaks through the walls would pass it by.
TEST(SectionSpeed, WallsThinnerThanABlockPartIt) {
  const Case c = scene(duct, "0.05 mm", "inlet", "outlet");
  const Surface s = load_surface(c);
  const lbm::geometry::TriangleTree tree(s.mesh);
  lbm::geometry::Voxels v = lbm::geometry::voxelize(tree, *c.numerics.dx);
  const int nx = v.size[0], ny = v.size[1];
  ASSERT_EQ(ny, 60);
  v.fill([&](int i, int j, int) {
    if (j == 20 && i < nx - 80) return false;
    if (j == 40 && i >= 80) return false;
    if (i < 4 && j > 20) return false;        // the inlet is the first channel's
    if (i >= nx - 4 && j < 40) return false;  // the outlet the third's
    return !(std::abs(i - nx / 2) < 20 && j > 30 && j < 40);
  });
  EXPECT_NEAR(section_ratio(c, s, tree, v), 2.0, 2.0 / 10.0);  // of 10 cells, found to one
}

// A fluid cell at the inlet that touches no other has no way out; what else there is does.
TEST(SectionSpeed, AStrayCellAtAnInletIsLeftOut) {
  const Case c = scene(step, "0.25 mm", "outlet", "inlet", across);
  const Surface s = load_surface(c);
  const lbm::geometry::TriangleTree tree(s.mesh);
  lbm::geometry::Voxels v = lbm::geometry::voxelize(tree, *c.numerics.dx);
  const lbm::geometry::Voxels all = v;
  const int last = v.size[0] - 1;
  v.fill([&](int i, int j, int k) {
    const bool beside = j < 3 && k < 3 && i >= last - 1 && !(i == last && j == 0 && k == 0);
    return all.is_fluid(i, j, k) && !beside;
  });
  EXPECT_NEAR(section_ratio(c, s, tree, v), 3.0,
              3.0 * 9.0 / 288.0);  // of 8 x 36 faces of the inlet 9 are closed or stray
}

TEST(SectionSpeed, TheStepIsSizedForItAndFollowsTheInlet) {
  Case c = scene(step, "0.25 mm", "outlet", "inlet", across);
  const Assessment a = assess(c, load_surface(c));
  EXPECT_NEAR(a.reference_speed, 30.0, 30.0 / 144.0);
  EXPECT_NEAR(a.lattice->mach, 0.1 * std::numbers::sqrt3, 1e-12);
  // A speed that is given is taken; the air that is faster than it shows in the Mach number.
  c.numerics.reference_speed = 10.0;
  const Assessment given = assess(c, load_surface(c));
  EXPECT_EQ(given.reference_speed, 10.0);
  EXPECT_NEAR(given.lattice->mach, 0.3 * std::numbers::sqrt3, 0.3 / 144.0 * std::numbers::sqrt3);
}

}  // namespace
}  // namespace puffin::cases
