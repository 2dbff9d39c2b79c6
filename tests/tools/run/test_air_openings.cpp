// Openings of whole scenes: what passes through planes beside a plug, air that is drawn in, outlets of two faces.

#include "tests/tools/run/air_scene.hpp"

namespace puffin::test {
namespace {

std::string box(const std::string& name, const std::string& x, const std::string& y, const std::string& z) {
  return "schema = 1\nname = \"" + name + "\"\n[geometry]\ngenerator = \"box\"\nbox = { x = \"" + x + "\", y = \"" + y +
         "\", z = \"" + z + "\" }\n";
}
std::string boundary(const std::string& patch, const std::string& rest) {
  return "[[air.boundary]]\npatch = \"" + patch + "\"\n" + rest + "\n";
}
const std::string outlet = "type = \"pressure-outlet\"";

// Air whose plug the walls let go of over six cells flows through every plane as it came in; at rest after 40 ms, the
// planes differ by rounding. With the release counted as a flow along the walls the plane two cells behind the inlet
// read 3.7 % too much, that behind the fourth 1.9 %.
TEST_F(AirScene, BesideAPlugEveryPlaneReadsTheInletsFlow) {
  ASSERT_EQ(run("plug", box("plug", "8 mm", "3 mm", "3 mm") + air + boundary("x-min", R"toml(type = "velocity-inlet"
velocity = "2 m/s")toml") + boundary("x-max", outlet) +
                            R"toml(
[numerics]
dx = "0.25 mm"
lattice_speed = 0.05
les = "none"
[stop]
time = "40 ms"
[output]
plane = [{ name = "a", normal = "x", at = "0.5 mm" }, { name = "b", normal = "x", at = "1 mm" },
         { name = "c", normal = "x", at = "6 mm" }]
)toml"),
            0)
      << text("plug.log");
  const auto planes = table("plug/planes.csv");
  for (const char* name : {"a", "b", "c"})
    EXPECT_NEAR(last(planes, "plane", name, "flow_rate") / 1.8e-5, 1.0, 1e-4) << name;
}

// A lid between two openings of one pressure draws air in through one of them: u = U z/h everywhere, whatever the
// length. Where air came in the pressure was less by its momentum, rho u^2, and 18 % of the flow were missing. What is
// left, 3.1 % here and 3.5 % with half the cell size, is no error of the cells: air enters with the stress of none.
TEST_F(AirScene, ALidDrawsAirThroughOpeningsOfOnePressure) {
  const std::string lid = box("lid", "4 mm", "0.0625 mm", "1 mm") + air +
                          boundary("y-max", "type = \"periodic\"\nwith = \"y-min\"") + boundary("x-min", outlet) +
                          boundary("x-max", outlet) +
                          boundary("z-max", "type = \"moving-wall\"\nvelocity = [0.3, 0.0, 0.0]") + numerics +
                          R"toml(
[stop]
time = "60 ms"
[output]
plane = [{ name = "middle", normal = "x", at = "2 mm" }]
)toml";
  ASSERT_EQ(run("lid", lid), 0) << text("lid.log");
  EXPECT_NEAR(last(table("lid/planes.csv"), "plane", "middle", "flow_rate") / (0.15e-3 * 6.25e-5), 1.0, 0.05);
}

// The same with a body force: G h^2/(12 mu) = 0.2 m/s, Re 13. 1.1 % are missing (18 % were).
TEST_F(AirScene, AForceDrawsAirThroughOpeningsOfOnePressure) {
  const std::string force = box("force", "6 mm", "0.0625 mm", "1 mm") + air +
                            "body_force = [43.344, 0.0, 0.0]\nboundary = [\n"
                            "{ patch = \"y-max\", type = \"periodic\", with = \"y-min\" },\n"
                            "{ patch = \"x-min\", type = \"pressure-outlet\" }, { patch = \"x-max\", type = "
                            "\"pressure-outlet\" }]\n" +
                            numerics + R"toml(
[stop]
time = "60 ms"
[output]
plane = [{ name = "middle", normal = "x", at = "3 mm" }]
)toml";
  ASSERT_EQ(run("force", force), 0) << text("force.log");
  EXPECT_NEAR(last(table("force/planes.csv"), "plane", "middle", "flow_rate") / (0.2e-3 * 6.25e-5), 1.0, 0.03);
}

// Both ends of a T bear one name: half of the air leaves through each, by symmetry to rounding of float populations.
TEST_F(AirScene, AnOutletMayHaveTwoOppositeFaces) {
  const std::string tee =
      "schema = 1\nname = \"tee\"\n[geometry]\ngenerator = \"box\"\nbox = { x = \"4 mm\", y = \"1 mm\", z "
      "= \"1 mm\" }\n[[geometry.patch]]\nname = \"ends\"\nselect = \"plane:x-min\"\n"
      "[[geometry.patch]]\nname = \"ends\"\nselect = \"plane:x-max\"\n" +
      air + boundary("z-min", "type = \"velocity-inlet\"\nvelocity = \"0.5 m/s\"") + boundary("ends", outlet) + R"toml(
[numerics]
dx = "0.125 mm"
les = "none"
[stop]
time = "10 ms"
[output]
plane = [{ name = "left", normal = "x", at = "0.5 mm" }, { name = "right", normal = "x", at = "3.5 mm" }]
)toml";
  ASSERT_EQ(run("tee", tee), 0) << text("tee.log");
  const auto planes = table("tee/planes.csv");
  const double right = last(planes, "plane", "right", "flow_rate"), left = last(planes, "plane", "left", "flow_rate");
  EXPECT_NEAR(right / -left, 1.0, 1e-3);
  EXPECT_NEAR(right / (0.5 * 0.5 * 4e-6 * 0.75), 1.0,
              0.01);  // less what enters beyond the planes, an eighth at each end
}

}  // namespace
}  // namespace puffin::test
