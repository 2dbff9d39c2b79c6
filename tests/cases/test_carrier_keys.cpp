// Keys of [carriers] with several forms: sizes, spread surface energies, elasticity, friction.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "cases/build.hpp"
#include "cases/fill.hpp"
#include "cases/size_distribution.hpp"
#include "cases/write_case.hpp"
#include "coupling/near_wall.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

using test::parse;
using test::problems_of;
using test::replaced;
using test::sample;

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const auto& line : lines) all += line + "\n";
  return all;
}

}  // namespace

TEST(CarrierKeys, FormsAreReadAndComeBackFromTheResolvedCase) {
  const Case c = parse(sample, {{"carriers.diameter", "{ law = \"log-normal\", median = \"70 um\", sigma = 0.3 }"},
                                {"carriers.adhesion.surface_energy", "{ median = \"3.6e-3 J/m^2\", sigma = 0.5 }"},
                                {"carriers.contact.friction",
                                 "{ law = \"velocity\", stick = 0.5, slip = 0.2, slip_speed = \"1 m/s\", limit = 0.1, "
                                 "limit_speed = \"10 m/s\" }"},
                                {"carriers.contact.rolling_friction", "0.05"},
                                {"carriers.contact.model", "\"hertz\""},
                                {"carriers.contact.youngs_modulus", "\"24 GPa\""},
                                {"carriers.contact.poisson", "0.3"},
                                {"carriers.walls.contact.youngs_modulus", "\"2.5 GPa\""},
                                {"carriers.lift", "\"saffman-magnus\""},
                                {"carriers.near_wall", "true"},
                                {"carriers.pressure_gradient", "true"}});
  EXPECT_EQ(c.carriers->adhesion.sigma, 0.5);
  EXPECT_EQ(c.carriers->wall_adhesion.sigma, 0.5);  // as the carriers'
  EXPECT_EQ(c.carriers->wall_contact.youngs_modulus, 2.5e9);
  EXPECT_EQ(std::get<VelocityFriction>(c.carriers->wall_contact.friction).slip, 0.2);
  EXPECT_TRUE(c.carriers->near_wall && c.carriers->pressure_gradient);
  const Case again = parse(write_resolved(c));
  EXPECT_EQ(again.carriers, c.carriers);
}

TEST(CarrierKeys, MistakesNameTheirRemedy) {
  EXPECT_NE(
      joined(problems_of(sample, {{"carriers.adhesion.model", "\"jkr\""}})).find("give youngs_modulus and poisson"),
      std::string::npos);
  // Walls have the carriers' elasticity unless told otherwise, whatever contact law stands beside the adhesion.
  const Case jkr = parse(sample, {{"carriers.adhesion.model", "\"jkr\""},
                                  {"carriers.contact.youngs_modulus", "\"24 GPa\""},
                                  {"carriers.contact.poisson", "0.3"}});
  EXPECT_EQ(jkr.carriers->wall_contact.youngs_modulus, 24e9);
  EXPECT_EQ(jkr.carriers->wall_contact.poisson, 0.3);
  EXPECT_NE(joined(problems_of(sample, {{"carriers.contact.model", "\"hertz\""}})).find("youngs_modulus"),
            std::string::npos);
  EXPECT_NE(joined(problems_of(sample, {{"carriers.diameter",
                                         "{ law = \"log-normal\", median = \"70 um\", sigma = 0.3, by = \"mass\" }"}}))
                .find("\"volume\" or \"number\""),
            std::string::npos);
  EXPECT_NE(
      joined(problems_of(sample, {{"carriers.diameter",
                                   "{ law = \"log-normal\", median = \"70 um\", sigma = 0.3, largest = \"1 um\" }"}}))
          .find("nothing of the distribution"),
      std::string::npos);
}

// Hatch & Choate: a log-normal volume distribution of median m has the number median m exp(-3 s^2) and the mean volume
// diameter m exp(-1.5 s^2). Cuts at 1e-3 of the volume and 2,000 classes: 1 %.
TEST(Sizes, LogNormalFollowsHatchAndChoate) {
  SizeDistribution d;
  d.median = 70e-6, d.sigma = 0.3;
  const SizeTable table = size_table(d);
  EXPECT_NEAR(mean_volume_diameter(table), 70e-6 * std::exp(-1.5 * 0.09), 0.01 * 70e-6);
  std::vector<double> drawn = draw_diameters(table, 10000, 3);
  std::sort(drawn.begin(), drawn.end());
  EXPECT_NEAR(drawn[5000], 70e-6 * std::exp(-3.0 * 0.09), 0.01 * 70e-6);
  // Stratified: 200 carriers have the mean mass within 1 %.
  double volume = 0.0;
  for (const double x : draw_diameters(table, 200, 4)) volume += x * x * x / 200.0;
  EXPECT_NEAR(std::cbrt(volume), mean_volume_diameter(table), 0.01 * 70e-6);
}

// By number nothing is converted: half the carriers are below the median.
TEST(Sizes, SharesOfNumberAreTakenAsTheyAre) {
  SizeDistribution d;
  d.median = 70e-6, d.sigma = 0.3, d.by_volume = false;
  std::vector<double> drawn = draw_diameters(size_table(d), 1001, 3);
  std::sort(drawn.begin(), drawn.end());
  EXPECT_NEAR(drawn[500], 70e-6, 0.01 * 70e-6);
}

// Of the volume, 1 - 1/e lies below the scale.
TEST(Sizes, RosinRammlerHasItsScale) {
  SizeDistribution d;
  d.law = SizeLaw::rosin_rammler;
  d.scale = 80e-6, d.exponent = 4.0, d.smallest = 10e-6;
  const std::vector<double> drawn = draw_diameters(size_table(d), 20000, 3);
  double below = 0.0, all = 0.0;
  for (const double x : drawn) {
    all += x * x * x;
    if (x < 80e-6) below += x * x * x;
  }
  EXPECT_NEAR(below / all, 1.0 - std::exp(-1.0), 0.01);
}

TEST(Sizes, ATableIsFollowedAndItsMistakesNameTheLine) {
  const auto file = std::filesystem::temp_directory_path() / "puffin_sizes_test.csv";
  const auto write = [&](const char* text) { std::ofstream(file) << text; };
  SizeDistribution d;
  d.law = SizeLaw::table, d.by_volume = false, d.file = file.string();
  write("diameter,share\n40e-6,0\n60e-6,0.5\n100e-6,1\n");
  std::vector<double> drawn = draw_diameters(size_table(d), 1000, 3);
  std::sort(drawn.begin(), drawn.end());
  EXPECT_NEAR(drawn[500], 60e-6, 0.5e-6);
  EXPECT_NEAR(drawn[250], 50e-6, 0.5e-6);
  write("50e-6,0.3\n70e-6,1.0\n");  // three of ten are no larger than 50 um: they have that size
  drawn = draw_diameters(size_table(d), 1000, 3);
  EXPECT_NEAR(static_cast<double>(std::count(drawn.begin(), drawn.end(), 50e-6)), 300.0, 1.0);
  write("40e-6,0\n30e-6,1\n");
  try {
    size_table(d);
    ADD_FAILURE();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(".csv:2:"), std::string::npos) << e.what();
  }
  std::filesystem::remove(file);
}

// On a square floor the stack stands in the circle that fits into it, and every sphere is in the fluid (dose_of throws
// otherwise); the circle of the square's area would stick out by 0.064 mm on each side.
TEST(CarrierKeys, ADoseOnASquareFloorStandsWithinItsSides) {
  const Case c = parse(
      "schema = 1\nname = \"square\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\nx = \"1 mm\"\ny = \"1 mm\"\n"
      "z = \"2 mm\"\n[[geometry.patch]]\nname = \"tray\"\nselect = \"plane:z-min\"\n[air]\nmodel = "
      "\"none\"\n[carriers]\n"
      "count = 100\ndensity = 1520\ndiameter = \"100 um\"\nfill = { shape = \"cylinder\", at = \"tray\" "
      "}\n[stop]\ntime = \"1 ms\"\n");
  const Surface surface = load_surface(c);
  const lbm::geometry::TriangleTree tree(surface.mesh);
  const Dose dose = dose_of(c, surface, tree);
  ASSERT_EQ(dose.positions.size(), 100U);
  double reach = 0.0;
  for (const Vec3& p : dose.positions) reach = std::max(reach, std::hypot(p.x() - 0.5e-3, p.y() - 0.5e-3));
  EXPECT_GT(reach, 0.3e-3);  // and uses it
}

// The large one may give by 2 % of 2 mm, ten times the radius of the small one; frozen air has no volume fraction.
TEST(CarrierKeys, WhatTheModelsLeaveOutIsSaidWhenTheSceneIsBuilt) {
  const auto warnings = [](const std::string& diameter, const std::string& drag) {
    return build(
               parse("schema = 1\nname = \"two\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\nx = \"4 mm\"\ny = "
                     "\"4 mm\"\nz = \"4 mm\"\n[air]\nmodel = \"frozen\"\nfield = \"uniform\"\nvelocity = [1.0, 0.0, "
                     "0.0]\n"
                     "[carriers]\ndrag = \"" +
                     drag +
                     "\"\nlist = [{ position = [2e-3, 2e-3, 2e-3], diameter = \"2 mm\", density = 1520 }, { position = "
                     "[5e-4, 5e-4, 5e-4], diameter = \"" +
                     diameter + "\", density = 1520 }]\n[stop]\ntime = \"1 ms\"\n"))
        ->warnings;
  };
  const auto said = warnings("8 um", "beetstra");
  ASSERT_EQ(said.size(), 2U);
  EXPECT_NE(said[0].find("carriers.volume_fraction: in frozen air"), std::string::npos) << said[0];
  EXPECT_NE(said[1].find("give at most 0.002"), std::string::npos) << said[1];
  EXPECT_TRUE(warnings("100 um", "schiller-naumann").empty());
}

// Carriers of 10 um at rest in a stream along the floor: their drag over that of one far away. Faxen's in full to 10
// radii, two fifths of what it adds at 13, nothing from 15 on. Rounding of what comes after six digits of the diameter.
TEST(CarrierKeys, WhatAWallAddsToDragFadesBetween10And15Radii) {
  const std::vector<double> distances{4.0, 9.9, 13.0, 15.1, 100.0};  // radii
  std::string list;
  for (const double d : distances)
    list +=
        "{ position = [1e-3, 1e-3, \"" + std::to_string(5.0 * d) + " um\"], diameter = \"10 um\", density = 1520 },";
  const auto s =
      build(parse("schema = 1\nname = \"wall\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\nx = \"2 mm\"\ny = "
                  "\"2 mm\"\nz = \"2 mm\"\n[air]\nmodel = \"frozen\"\nfield = \"uniform\"\nvelocity = [0.01, 0.0, "
                  "0.0]\n[carriers]\nnear_wall = true\ngravity = [0.0, 0.0, 0.0]\nlist = [" +
                  list + "]\n[stop]\ntime = \"1 ms\"\n"));
  coupling::advance(s->models, 1e-9, s->state);
  const double far = s->state.loads.back().drag;
  const auto along = [](double distance) { return coupling::drag_along_wall(1.0 / distance); };
  for (std::size_t n = 0; n < distances.size(); ++n) {
    const double felt = distances[n] < 10.0 ? 1.0 : distances[n] < 15.0 ? 0.4 : 0.0;
    EXPECT_NEAR(s->state.loads[n].drag / far, 1.0 + felt * (along(distances[n]) - 1.0), 2e-3) << distances[n];
  }
}

}  // namespace puffin::cases
