// Walls that act on whole cells leak where they are thinner than two: said before the run.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cases/assessment.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases {
namespace {

/// A cube of 1.2 mm in a duct.
bool warned_of_a_thin_wall(const std::string& wall, const std::string& dx) {
  const Case c = parse_case("name = \"x\"\nnumerics = { dx = \"" + dx + "\", wall = \"" + wall + R"(" }
stop = { time = "1 ms" }
geometry = { generator = "obstacle", obstacle = { shape = "cube", diameter = "1.2 mm", length = "12 mm", width = "6 mm", height = "6 mm" } }
[air]
density = 1.2
viscosity = 1.8e-5
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
velocity = "1 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
)",
                            "x.toml");
  const Assessment a = assess(c, load_surface(c));
  EXPECT_NEAR(a.thinnest_wall, 1.2e-3, 1e-9);
  return std::any_of(a.warnings.begin(), a.warnings.end(),
                     [](const std::string& w) { return w.find("the thinnest wall") == 0; });
}

TEST(ThinWalls, OfLessThanTwoCellsAreToldWhereWholeCellsAct) {
  EXPECT_TRUE(warned_of_a_thin_wall("ibm", "0.75 mm"));  // 1.6 cells
  EXPECT_TRUE(warned_of_a_thin_wall("psm", "0.75 mm"));
  EXPECT_FALSE(warned_of_a_thin_wall("bouzidi", "0.75 mm"));
  EXPECT_FALSE(warned_of_a_thin_wall("ibm", "0.5 mm"));  // 2.4 cells
}

}  // namespace
}  // namespace puffin::cases
