// Boundaries that contradict each other or the geometry: every one named, at its place in the file.

#include <gtest/gtest.h>

#include "cases/check_boundaries.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases::test {
namespace {

std::string scene(const std::string& geometry, const std::string& boundaries) {
  return "schema = 1\nname = \"scene\"\n[geometry]\n" + geometry + "\n" + boundaries +
         "[numerics]\ndx = \"1 mm\"\nreference_speed = \"1 m/s\"\n[stop]\ntime = \"1 ms\"\n";
}
std::string boundary(const std::string& patch, const std::string& rest) {
  return "[[air.boundary]]\npatch = \"" + patch + "\"\n" + rest + "\n";
}
const std::string box = "generator = \"box\"", duct = "generator = \"duct\"";

/// What the file alone shows, or else what the geometry shows.
std::string first_problem(const std::string& text) {
  if (const auto lines = problems_of(text); !lines.empty()) return lines.front();
  const Case c = parse(text);
  const auto found = boundary_problems(c, load_surface(c));
  return found.empty() ? "" : found.front().to_string();
}

TEST(Boundaries, AFaceOfTheBoxNeedsNoTag) {
  const std::string text = scene(duct, boundary("inlet", "type = \"velocity-inlet\"\nvelocity = 1.0") +
                                           boundary("outlet", "type = \"pressure-outlet\"") +
                                           boundary("y-min", "type = \"periodic\"\nwith = \"y-max\""));
  EXPECT_EQ(first_problem(text), "");
  const Surface s = load_surface(parse(text));
  EXPECT_NEAR(s.area_of("y-min"), 50e-3 * 3.5e-3, 1e-12);
  EXPECT_NEAR(s.area_of("y-max"), 50e-3 * 3.5e-3, 1e-12);
  EXPECT_NEAR(s.area_of("wall"), 2.0 * 50e-3 * 7e-3, 1e-12);
}

TEST(Boundaries, APeriodicPairMayBeNamedFromEitherSideOrBoth) {
  const std::string one = boundary("x-min", "type = \"periodic\"\nwith = \"x-max\""),
                    other = boundary("x-max", "type = \"periodic\"\nwith = \"x-min\"");
  for (const std::string& pair : {one, other, one + other}) EXPECT_EQ(first_problem(scene(box, pair)), "");
}

// The air that a lid drags along behind itself has nowhere to go where walls stand. Between two plates it has.
TEST(Boundaries, ImmersedWallsThatMoveMeetNoStandingOnes) {
  const auto with_walls = [](const std::string& wall, const std::string& boundaries) {
    std::string text = scene(box, boundaries);
    return first_problem(text.replace(text.find("dx ="), 0, "wall = \"" + wall + "\"\n"));
  };
  const auto moving = [](const std::string& patch, const std::string& speed) {
    return boundary(patch, "type = \"moving-wall\"\nvelocity = [" + speed + ", 0.0, 0.0]");
  };
  const std::string across = boundary("y-min", "type = \"periodic\"\nwith = \"y-max\""),
                    along = boundary("x-min", "type = \"periodic\"\nwith = \"x-max\"");
  const std::string cavity = moving("z-max", "1.0") + across, couette = cavity + along;
  EXPECT_NE(with_walls("ibm", cavity).find("air.boundary[0].type: 'z-max' moves and meets"), std::string::npos);
  EXPECT_NE(with_walls("ibm", cavity).find("\"bouzidi\" or \"psm\""), std::string::npos);
  EXPECT_EQ(with_walls("bouzidi", cavity), "");
  EXPECT_EQ(with_walls("ibm", couette), "");
  const std::string sides = moving("y-min", "1.0") + moving("y-max", "1.0");
  EXPECT_EQ(with_walls("ibm", moving("z-max", "1.0") + moving("z-min", "1.0") + sides + along), "") << "all move alike";
  const std::string unlike = moving("y-min", "1.0") + moving("y-max", "0.5");
  EXPECT_NE(with_walls("ibm", moving("z-max", "1.0") + moving("z-min", "1.0") + unlike + along).find("moves and meets"),
            std::string::npos);
}

// A wall of a box of 10 x 10 x 10 mm: along itself, 0.5 % askew (a facet), and by a tenth of its speed away from the
// air.
TEST(Boundaries, AMovingWallSlidesAlongItself) {
  const auto told = [](const std::string& velocity) {
    const Case c = parse(scene(box, boundary("z-max", "type = \"moving-wall\"\nvelocity = [" + velocity + "]")));
    return boundary_warnings(c, load_surface(c));
  };
  EXPECT_TRUE(told("1.0, 0.5, 0.0").empty());
  EXPECT_TRUE(told("1.0, 0.0, 0.005").empty());
  const auto away = told("1.0, 0.0, 0.1");
  ASSERT_EQ(away.size(), 1U);
  EXPECT_EQ(away.front().find("the moving wall 'z-max' has 0.1 m/s along its normal at ("), 0U) << away.front();
}

// 1 m/s through cells of 1 mm: a step of 2e-3 s crosses two of them, one of 0.25 ms a quarter. As `lattice_speed` a 2
// is refused at once; such a run diverged four times before it gave up.
TEST(Boundaries, ATimeStepThatNoSchemeCanTakeIsRefused) {
  const auto with_step = [](const std::string& step) {
    std::string text = scene(duct, boundary("inlet", "type = \"velocity-inlet\"\nvelocity = 1.0") +
                                       boundary("outlet", "type = \"pressure-outlet\""));
    return text.replace(text.find("dx ="), 0, "time_step = \"" + step + "\"\n");
  };
  EXPECT_EQ(first_problem(with_step("0.25 ms")), "");
  const std::string told = first_problem(with_step("2e-3 s"));
  EXPECT_NE(told.find("numerics.time_step: lets air of 1 m/s cross 2 cells a step"), std::string::npos) << told;
  EXPECT_NE(told.find("take 1e-04 s"), std::string::npos) << told;
}

TEST(Boundaries, ContradictionsAreNamedAtTheirPlace) {
  const auto periodic = [](const std::string& a, const std::string& b) {
    return boundary(a, "type = \"periodic\"\nwith = \"" + b + "\"");
  };
  const std::string inlet = boundary("inlet", "type = \"velocity-inlet\"\nvelocity = 1.0"),
                    outlet = boundary("outlet", "type = \"pressure-outlet\"");
  const struct {
    std::string geometry, boundaries, place, text;
  } cases[] = {
      {duct, inlet + inlet + outlet, ":10:", "patch 'inlet' has two boundaries"},
      {box, periodic("x-min", "x-min"), ":8:", "cannot be periodic with itself"},
      {box, periodic("x-min", "x-max") + boundary("x-max", "type = \"wall\""), ":8:", "has another boundary already"},
      {box, periodic("x-min", "x-max") + periodic("y-min", "x-max"), ":8:", "is the partner of 'y-min' already"},
      {box, periodic("x-min", "y-max"), ":8:", "periodic faces are the two ends"},
      {"generator = \"step\"", periodic("inlet", "outlet"), ":8:", "do not cover each other"},
      {"generator = \"bend\"", periodic("inlet", "outlet"), ":8:", "periodic faces are the two ends"},
      {duct, boundary("inlet", "type = \"velocity-inlet\"") + outlet, ":5:", "needs 'flow_rate' or 'velocity'"},
      {duct, inlet + boundary("outlet", "type = \"pressure-outlet\"\nprofile = \"duct\""), ":12:", "profile"},
      {duct, boundary("inlet", "type = \"velocity-inlet\"\nvelocity = [-1.0, 0.0, 0.0]") + outlet,
       ":8:", "does not point into the fluid"},
      {"generator = \"pipe\"", boundary("wall", "type = \"slip\""), ":7:", "must lie along x, y or z"},
      {duct, inlet + outlet + boundary("wal", "type = \"wall\""), ":13:", "did you mean 'wall'?"},
  };
  for (const auto& c : cases) {
    const std::string found = first_problem(scene(c.geometry, c.boundaries));
    EXPECT_NE(found.find(c.place), std::string::npos) << c.text << "\n" << found;
    EXPECT_NE(found.find(c.text), std::string::npos) << c.text << "\n" << found;
  }
}

}  // namespace
}  // namespace puffin::cases::test
