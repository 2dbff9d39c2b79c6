// Places outside the geometry are named before anything is run.

#include <gtest/gtest.h>

#include "cases/check_places.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases::test {
namespace {

Case scene(const std::string& list, const std::string& output) {
  return parse(R"toml(
schema = 1
name = "scene"
[geometry]
generator = "box"
[geometry.box]
x = "2 mm"
y = "2 mm"
z = "2 mm"
[numerics]
dx = "0.2 mm"
reference_speed = "1 m/s"
[carriers]
list = [
)toml" + list + "\n]\n[stop]\ntime = \"1 ms\"\n[output]\n" +
               output);
}
std::string at(const std::string& place) {
  return "{ position = " + place + ", diameter = \"100 um\", density = 1520 },";
}
lbm::geometry::TriangleTree tree_of(const Case& c) { return lbm::geometry::TriangleTree(load_surface(c).mesh); }

}  // namespace

TEST(Places, AListedCarrierOutsideIsRefusedAtItsPlaceInTheFile) {
  const Case c = scene(at("[1e-3, 1e-3, 1e-3]") + "\n" + at("[1e-3, 1e-3, 5e-3]"), "");
  const auto problems = carrier_place_problems(c, tree_of(c));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].to_string().find(":16:"), std::string::npos) << problems[0].to_string();
  EXPECT_NE(problems[0].text.find("carriers.list[1].position: lies 3 mm outside the geometry"), std::string::npos)
      << problems[0].text;
}

TEST(Places, DeepOverlapsAreSaidAndContactsAreNot) {
  const Case c = scene(at("[1e-3, 1e-3, 1e-5]") + at("[5e-4, 1e-3, 49e-6]") + at("[1.5e-3, 1e-3, 1e-3]") +
                           at("[1.5e-3, 1e-3, 1.03e-3]") + at("[1.5e-3, 1e-3, 0.901e-3]"),
                       "");
  const auto warnings = carrier_place_warnings(c, tree_of(c));
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("carriers.list[0] starts 0.04 mm deep in a wall"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("carriers.list[3] starts 0.07 mm deep in carriers.list[2]"), std::string::npos)
      << warnings[1];
}

TEST(Places, TenOverlapsAreNamedAndTheOthersCounted) {
  std::string places;
  for (int i = 0; i < 15; ++i) places += at("[1e-3, 1e-3, " + std::to_string(1e-3 + 50e-6 * i) + "]");
  const auto warnings = carrier_place_warnings(scene(places, ""), tree_of(scene(places, "")));
  ASSERT_EQ(warnings.size(), 11U);
  EXPECT_EQ(warnings.back(), "carriers.list has 4 more such overlaps");
}

TEST(Places, CarriersAreNoPartOfPeriodicPatchesAndMovingWalls) {
  Case c = scene(at("[1e-3, 1e-3, 1e-3]"), "");
  EXPECT_TRUE(carrier_place_warnings(c, tree_of(c)).empty());
  Boundary periodic, moving;
  periodic.patch = "x-min", periodic.with = "x-max", periodic.type = BoundaryType::periodic;
  moving.patch = "z-max", moving.type = BoundaryType::moving_wall;
  c.air.boundaries = {periodic, moving};
  const auto warnings = carrier_place_warnings(c, tree_of(c));
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("'x-min' and 'x-max'"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("'z-max'"), std::string::npos) << warnings[1];
}

// Without a lattice a tag makes an opening, also of a floor that was tagged to be looked at.
TEST(Places, PatchesThatCarriersLeaveThroughForTheirTagAloneAreNamed) {
  Case c = scene(at("[1e-3, 1e-3, 1e-3]"), "");
  const auto tree = tree_of(c);
  for (const char* name : {"floor", "exit-2", "Outlet", "mouthpiece", "inlet_left", "wall"}) {
    Patch patch;
    patch.name = name;
    c.geometry.patches.push_back(patch);
  }
  EXPECT_TRUE(carrier_place_warnings(c, tree).empty()) << "on a lattice it is a wall";
  for (const AirModel model : {AirModel::none, AirModel::frozen}) {
    c.air.model = model;
    const auto warnings = carrier_place_warnings(c, tree);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0],
              "carriers leave through 'floor': no boundary says what it is; give it type = \"wall\" if it is one");
  }
  Case bouncing = c;
  bouncing.carriers->outside = Outside::bounce;
  EXPECT_TRUE(carrier_place_warnings(bouncing, tree).empty());
  Boundary wall;
  wall.patch = "floor", wall.type = BoundaryType::wall;
  c.air.boundaries = {wall};
  EXPECT_TRUE(carrier_place_warnings(c, tree).empty());
}

TEST(Places, ProbesPlanesSlicesAndBoxesBeyondTheGeometryAreAllNamed) {
  const Case c = scene(at("[1e-3, 1e-3, 1e-3]"), R"toml(
probe = [{ name = "in", at = [1e-3, 1e-3, 1e-3] }, { name = "out", at = [1e-3, 1e-3, 9e-3] }]
plane = [{ name = "end", normal = "x", at = 2e-3 }, { name = "far", normal = "x", at = 0.03 }]
fields = [
  { what = ["velocity"], region = "slice:z=9mm", every = "1 ms" },
  { what = ["velocity"], region = "box:[3e-3, 0, 0, 4e-3, 1e-3, 1e-3]", every = "1 ms" },
  { what = ["velocity"], region = "slice:z=1mm", every = "1 ms" },
])toml");
  const auto problems = output_place_problems(c, tree_of(c), 2e-4);
  ASSERT_EQ(problems.size(), 4U);
  EXPECT_NE(problems[0].text.find("output.probe[1]: 'out' lies outside the fluid"), std::string::npos);
  EXPECT_NE(problems[1].text.find("output.plane[1]: 'far' meets no fluid"), std::string::npos);
  EXPECT_NE(problems[2].text.find("output.fields[0]: the slice lies outside"), std::string::npos);
  EXPECT_NE(problems[3].text.find("output.fields[1]: the box lies outside"), std::string::npos);
}

}  // namespace puffin::cases::test
