// Openings of whole scenes: what passes through planes beside a plug, air that is drawn in, outlets of two faces.

#include <array>

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

// A duct 8 to 10 cells wide that a plug enters at Re 180 has one drop, whichever way its walls are imposed: `ibm` has
// 6 % more here, 2 % on cells of half the size. While markers near the plug moved with it they pumped the air of the
// band, and the drop was -7 Pa. Between 8 and 16 ms, when the flow is steady.
TEST_F(AirScene, APlugBetweenImmersedWallsHasTheDropOfSharpOnes) {
  const auto drop = [&](const std::string& wall) {
    EXPECT_EQ(run(wall, box(wall, "16 mm", "4 mm", "3.2 mm") + "[air]\ndensity = 1.2\nviscosity = 1.2e-4\n" +
                            boundary("x-min", "type = \"velocity-inlet\"\nvelocity = \"5 m/s\"") +
                            boundary("x-max", outlet) + "[numerics]\ndx = \"0.4 mm\"\nwall = \"" + wall +
                            "\"\n[stop]\ntime = \"16 ms\"\n[output]\npressure_window = [\"8 ms\", \"16 ms\"]\n"),
              0)
        << text(wall + ".log");
    return output::read_summary(folder_ / wall / "summary.json").pressure->total_to_static_drop.mean.value_or(0.0);
  };
  const double sharp = drop("bouzidi");
  EXPECT_NEAR(drop("ibm") / sharp, 1.0, 0.10);
  EXPECT_NEAR(drop("psm") / sharp, 1.0, 0.02);
}

/// Plates 1 mm apart, one cell wide, between two openings of 0 Pa, with more boundaries.
std::string between_openings(const std::string& name, const std::string& length, const std::string& air_and_more) {
  return box(name, length, "0.0625 mm", "1 mm") + air + air_and_more +
         boundary("y-max", "type = \"periodic\"\nwith = \"y-min\"") + boundary("x-min", outlet) +
         boundary("x-max", outlet) + numerics +
         "[stop]\ntime = \"60 ms\"\n[output]\nplane = [{ name = \"middle\", normal = \"x\", at = \"2 mm\" }]\n";
}

// A lid draws air in through one of the openings: u = U z/h everywhere, whatever the length. The same with a force:
// G h^2/(12 mu) = 0.2 m/s, Re 13. Where air came in the pressure was less by its momentum, rho u^2, and 18 % of both
// flows were missing. Of what is left, 3.1 and 1.1 % here, 3.5 and 1.4 % with half the cell size, the cause is not
// known; 5 and 3 % hold it apart from 18.
TEST_F(AirScene, ALidAndAForceDrawAirThroughOpeningsOfOnePressure) {
  const std::string lid = boundary("z-max", "type = \"moving-wall\"\nvelocity = [0.3, 0.0, 0.0]");
  ASSERT_EQ(run("lid", between_openings("lid", "4 mm", lid)), 0) << text("lid.log");
  EXPECT_NEAR(last(table("lid/planes.csv"), "plane", "middle", "flow_rate") / (0.15e-3 * 6.25e-5), 1.0, 0.05);
  ASSERT_EQ(run("force", between_openings("force", "6 mm", "body_force = [43.344, 0.0, 0.0]\n")), 0)
      << text("force.log");
  EXPECT_NEAR(last(table("force/planes.csv"), "plane", "middle", "flow_rate") / (0.2e-3 * 6.25e-5), 1.0, 0.03);
}

// Without a lattice an inlet's flow is what its boundary asks for.
TEST_F(AirScene, AnInletIsReadWithoutALattice) {
  for (const std::string model : {"none", "frozen"}) {
    const std::string still = box(model, "1 mm", "1 mm", "1 mm") + "[air]\nmodel = \"" + model + "\"\n" +
                              (model == "frozen" ? "field = \"uniform\"\nvelocity = [1.0, 0.0, 0.0]\n" : "") +
                              boundary("x-min", "type = \"velocity-inlet\"\nvelocity = \"2 m/s\"") +
                              R"toml(
[carriers]
list = [{ position = [5e-4, 5e-4, 5e-4], diameter = "70 um", density = "1520 kg/m^3" }]
[stop]
time = "0.1 ms"
)toml";
    ASSERT_EQ(run(model, still), 0) << text(model + ".log");
    EXPECT_NEAR(table(model + "/history.csv").numbers("flow_rate").back(), 2e-6, 1e-12) << model;
  }
}

// A passage that widens from 1 to 2 mm, 10 Pa: air cannot be faster than without friction and with all of its speed
// regained, 2 (2 dp/rho)^(1/2) = 8.2 m/s in the narrow part. Brought in with any speed it liked, it reached 400 m/s.
TEST_F(AirScene, NoPassageGainsBySuckingIn) {
  for (const std::string pressure : {"0 Pa", "-10 Pa"}) {
    const std::string wide = R"toml(
schema = 1
name = "wide"
[geometry]
generator = "step"
[geometry.step]
inlet_height = "1 mm"
step_height = "1 mm"
width = "0.1 mm"
inlet_length = "1 mm"
outlet_length = "6 mm"
periodic = true
[air]
density = 1.2
viscosity = 2e-6
initial_velocity = [1.0, 0.0, 0.0]
boundary = [{ patch = "y-max", type = "periodic", with = "y-min" }, { patch = "inlet", type = "pressure-outlet" },
)toml" + ("{ patch = \"outlet\", type = \"pressure-outlet\", pressure = \"" + pressure + "\" }]") +
                             R"toml(
[numerics]
dx = "0.1 mm"
reference_speed = "10 m/s"
lattice_speed = 0.05
time_step = "fixed"
[stop]
time = "20 ms"
[output]
plane = [{ name = "a", normal = "x", at = "0.5 mm" }]
)toml";
    ASSERT_EQ(run("wide", wide, "--no-report"), 0) << text("wide.log");
    const double mean = last(table("wide/planes.csv"), "plane", "a", "flow_rate") / 1e-7;
    if (pressure == "0 Pa")
      EXPECT_LT(std::abs(mean), 1.0) << "nothing drives it";
    else
      EXPECT_TRUE(mean > 0.0 && mean < 8.2) << mean;  // bounded by their difference, not by entering_heads()
    std::filesystem::remove_all(folder_ / "wide");
  }
}

/// A box [mm] as STL; x-min and x-max are one solid, `ends`.
std::string box_with_ends(double x, double y, double z) {
  using Corner = std::array<double, 3>;
  std::string text;
  const auto quad = [&](const Corner& a, const Corner& b, const Corner& c, const Corner& d) {  // seen from outside
    for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const Corner& v : t)
        text += "vertex " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
      text += "endloop\nendfacet\n";
    }
  };
  text += "solid ends\n";
  quad({0, 0, 0}, {0, 0, z}, {0, y, z}, {0, y, 0});
  quad({x, 0, 0}, {x, y, 0}, {x, y, z}, {x, 0, z});
  text += "endsolid ends\nsolid bottom\n";
  quad({0, 0, 0}, {0, y, 0}, {x, y, 0}, {x, 0, 0});
  text += "endsolid bottom\nsolid wall\n";
  quad({0, 0, z}, {x, 0, z}, {x, y, z}, {0, y, z});
  quad({0, 0, 0}, {x, 0, 0}, {x, 0, z}, {0, 0, z});
  quad({0, y, 0}, {0, y, z}, {x, y, z}, {x, y, 0});
  return text + "endsolid wall\n";
}

// Both ends of a T are one outlet: half of the air leaves through each, by symmetry to rounding of float populations.
// Cells at the rim of the inlet bring less, as diagonal links are the walls', and the others more: 1.1 % here.
TEST_F(AirScene, AnOutletMayHaveTwoOppositeFaces) {
  std::ofstream(folder_ / "tee.stl") << box_with_ends(4.0, 1.0, 1.0);
  const std::string tee = "schema = 1\nname = \"tee\"\n[geometry]\nstl = \"" + (folder_ / "tee.stl").string() +
                          "\"\nunit = \"mm\"\n[[geometry.patch]]\nname = \"ends\"\nselect = \"solid:ends\"\n"
                          "[[geometry.patch]]\nname = \"bottom\"\nselect = \"solid:bottom\"\n" +
                          air + boundary("bottom", "type = \"velocity-inlet\"\nvelocity = \"0.5 m/s\"") +
                          boundary("ends", outlet) + R"toml(
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
              0.02);  // less what enters beyond the planes, an eighth at each end
}

}  // namespace
}  // namespace puffin::test
