// Whole runs of the program on scenes with exact solutions: boundaries and samplers of the air.

#include "tests/tools/run/air_scene.hpp"

namespace puffin::test {
namespace {

const std::string periodic_sides = R"toml(
[[air.boundary]]
patch = "x-min"
type = "periodic"
with = "x-max"
[[air.boundary]]
patch = "y-min"
type = "periodic"
with = "y-max"
)toml";

// The start decays as exp(-pi^2 nu t/h^2), to 3e-3 at 40 ms where nothing else drives it; the inlet drives all of it
// here. 16 cells across: the lattice's parabola is wrong by about (1/16)^2/2 = 0.2 % of the peak and interpolation by
// as much; 0.6 % of the peak at every point, the walls and the half cells beside them included.
TEST_F(AirScene, PoiseuilleProfilePressureFlowAndForceAreExactToSecondOrder) {
  ASSERT_EQ(run("channel", channel), 0) << text("channel.log");
  const auto line = table("channel/lines.csv");
  const auto z = line.numbers("z"), u = line.numbers("u");
  ASSERT_EQ(z.size(), 41U);
  for (std::size_t n = 0; n < z.size(); ++n) {
    const double s = z[n] / 1e-3;
    EXPECT_NEAR(u[n], 3.0 * s * (1.0 - s), 0.008 * 0.75) << "z = " << s;
  }
  EXPECT_NEAR(u.front(), 0.0, 1e-12);
  EXPECT_NEAR(u.back(), 0.0, 1e-12);
  EXPECT_NEAR(last(table("channel/probes.csv"), "probe", "wall", "u"), 3.0 * 0.01 * 0.99, 0.008 * 0.75);

  const auto planes = table("channel/planes.csv");
  const double flow = 0.5 * 6.25e-5 * 1e-3;
  for (const char* plane : {"first", "second", "end"})
    EXPECT_NEAR(last(planes, "plane", plane, "flow_rate"), flow, 1e-3 * flow) << plane;
  // dp/dx = 12 mu U/h^2; the lattice's density falls along the channel by 4e-3, the speed rises as much.
  const double slope = 12.0 * 1.806e-5 * 0.5 / 1e-6;
  EXPECT_NEAR(last(planes, "plane", "first", "static_pressure") - last(planes, "plane", "second", "static_pressure"),
              slope * 1.02e-3, 0.01 * slope * 1.02e-3);
  // Flux-weighted rho u^2/2 of a parabola: 54/35 of that of the mean.
  EXPECT_NEAR(last(planes, "plane", "first", "total_pressure") - last(planes, "plane", "first", "static_pressure"),
              54.0 / 35.0 * 0.5 * 1.204 * 0.25, 0.01 * 0.232);
  // From plane to plane, 3 mm; the total pressure adds the head. Read a cell inside both ends it was 6 % less.
  const auto history = table("channel/history.csv");
  const double drop = history.numbers("static_drop").back();
  EXPECT_NEAR(drop, slope * 3e-3, 0.01 * slope * 3e-3);
  EXPECT_NEAR(history.numbers("total_to_static_drop").back() - drop, 54.0 / 35.0 * 0.5 * 1.204 * 0.25, 0.01 * 0.232);
  // Friction on both walls over 3 mm = pressure drop times the section. On each wall a diagonal link of the first and
  // one of the last of the 48 cells leave through the openings, which are no wall. Not counted are the friction of
  // those links, together that of one cell, and the pressure on them: 2/36 of the difference drho of the densities of
  // the ends, against drho/3 16/2 for the wall, which is 1/48 as well.
  const auto force = table("channel/forces.csv");
  EXPECT_NEAR(last(force, "patch", "wall", "fx"), slope * 3e-3 * 6.25e-8, slope * 3e-3 * 6.25e-8 * 2.0 / 48.0);
  EXPECT_NEAR(last(force, "patch", "wall", "fz"), 0.0, 1e-15);  // floor and roof alike
}

// The channel's pressure drop is 0.325 Pa; four times the viscosity makes 1.3 Pa, at a speed of 0.1 in the lattice
// (3 dp/(rho U^2) 0.1^2) 13 % of the density. The run takes a lower speed and says so, and has nothing to say at its
// end; a step in seconds stays, 0.1 dx/U, and the end tells what became of the density.
TEST_F(AirScene, ADensityThatWouldDifferTooMuchIsHealedOrTold) {
  const std::string thick =
      " --set numerics.dx=\"0.125 mm\" --set numerics.lattice_speed=0.1 --set geometry.duct.width=\"0.125 mm\" "
      "--set air.viscosity=7.2e-5 --until 8ms";
  ASSERT_EQ(run("healed", channel, thick), 0) << text("healed.log");
  EXPECT_NE(text("healed.log").find("would change the density by 8.6 % at lattice_speed 0.1"), std::string::npos)
      << text("healed.log");
  EXPECT_EQ(text("healed.log").find("the density of the lattice's air"), std::string::npos) << text("healed.log");
  EXPECT_NE(text("healed/summary.json").find("would change the density"), std::string::npos);
  ASSERT_EQ(run("told", channel, thick + " --set numerics.time_step=\"2.5e-5 s\""), 0) << text("told.log");
  EXPECT_NE(text("told.log").find("the density of the lattice's air differs by 1"), std::string::npos)
      << text("told.log");
}

// Steady flow past a sphere that fills a fifth of the section, its surface off the faces of cells, reads the same
// before, in the middle of and behind it. Exact but for what is left of the start: 0.6 m/s goes through the duct 10
// times.
TEST_F(AirScene, ThePlanesBesideAnObstacleReadTheInletsFlow) {
  const std::string obstacle = R"toml(
schema = 1
name = "obstacle"
[geometry]
generator = "obstacle"
[geometry.obstacle]
shape = "sphere"
length = "5 mm"
width = "2 mm"
height = "2 mm"
diameter = "1 mm"
center = ["2 mm", "1 mm", "1 mm"]
)toml" + air + R"toml(
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
profile = "duct"
velocity = "0.6 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.2 mm"
lattice_speed = 0.05
[stop]
time = "80 ms"
[output]
statistics = "20 ms"
plane = [
  { name = "before", normal = "x", at = "0.5 mm" },
  { name = "beside", normal = "x", at = "2.1 mm" },
  { name = "behind", normal = "x", at = "4.4 mm" },
]
)toml";
  ASSERT_EQ(run("obstacle", obstacle, "--no-report"), 0) << text("obstacle.log");
  const auto planes = table("obstacle/planes.csv");
  for (const char* plane : {"before", "beside", "behind"})
    EXPECT_NEAR(last(planes, "plane", plane, "flow_rate"), 2.4e-6, 1e-5 * 2.4e-6) << plane;
}

// From half a channel below its floor to half a channel above its roof in steps of 0.1 mm: 11 of 21 points are in the
// air, both walls among them.
TEST_F(AirScene, ALineThatLeavesTheFluidHasRowsInsideAloneAndIsNamed) {
  std::string longer = channel;
  const std::string from = "0.0], to = [0.0015, 3e-5, 0.001], points = 41";
  longer.replace(longer.find(from), from.size(), "-0.0005], to = [0.0015, 3e-5, 0.0015], points = 21");
  ASSERT_EQ(run("longer", longer, "--no-report --until 0.1ms"), 0) << text("longer.log");
  EXPECT_NE(text("longer.log").find("line 'across': 10 of its 21 points lie outside the fluid"), std::string::npos)
      << text("longer.log");
  const auto line = table("longer/lines.csv");
  const auto s = line.numbers("s"), z = line.numbers("z"), u = line.numbers("u");
  ASSERT_EQ(z.size(), 11U);
  for (std::size_t n = 0; n < z.size(); ++n) {
    EXPECT_NEAR(z[n], 1e-4 * static_cast<double>(n), 1e-12);
    EXPECT_NEAR(s[n], z[n] + 5e-4, 1e-12);
    EXPECT_TRUE(std::isfinite(u[n]));
  }
}

TEST_F(AirScene, InAPeriodicDuctTheWallsTakeTheWholeBodyForce) {
  const std::string duct = R"toml(
schema = 1
name = "duct"
[geometry]
generator = "duct"
[geometry.duct]
length = "0.25 mm"
width = "0.5 mm"
height = "0.5 mm"
)toml" + air + R"toml(
body_force = [200.0, 0.0, 0.0]
[[air.boundary]]
patch = "x-min"
type = "periodic"
with = "x-max"
)toml" + numerics + R"toml(
reference_speed = "0.5 m/s"
[stop]
time = "20 ms"
[output]
statistics = "2 ms"
force = ["wall", "z-max"]
)toml";
  ASSERT_EQ(run("duct", duct), 0) << text("duct.log");
  const auto force = table("duct/forces.csv");
  // Slowest mode: 2 pi^2 nu t/a^2 = 24: gone. "z-max" is named, so the three other walls are "wall".
  const double whole = 200.0 * 0.25e-3 * 0.25e-6;
  EXPECT_NEAR(last(force, "patch", "z-max", "fx"), 0.25 * whole, 1e-6 * whole);
  EXPECT_NEAR(last(force, "patch", "wall", "fx"), 0.75 * whole, 1e-6 * whole);
}

// Couette flow is linear: the lattice, the walls and the sampler reproduce it to rounding once the start has decayed
// (exp(-pi^2 nu t/h^2) = 1e-9 at 140 ms), with two walls of different velocity.
TEST_F(AirScene, CouetteFlowBetweenTwoMovingWallsIsExact) {
  const std::string couette = R"toml(
schema = 1
name = "couette"
[geometry]
generator = "box"
[geometry.box]
x = "0.0625 mm"
y = "0.0625 mm"
z = "1 mm"
)toml" + air + periodic_sides +
                              R"toml(
[[air.boundary]]
patch = "z-max"
type = "moving-wall"
velocity = [1.0, 0.5, 0.0]
[[air.boundary]]
patch = "z-min"
type = "moving-wall"
velocity = [-0.5, 0.0, 0.0]
)toml" + numerics + R"toml(
[stop]
time = "140 ms"
[output]
statistics = "20 ms"
force = ["z-min", "z-max"]
line = [{ name = "up", from = [3e-5, 3e-5, 0.0], to = [3e-5, 3e-5, 0.001], points = 33 }]
plane = [{ name = "across", normal = "x", at = "0.0625 mm" }]
)toml";
  ASSERT_EQ(run("couette", couette), 0) << text("couette.log");
  const double flow = 0.25 * 6.25e-5 * 1e-3;  // mean of -0.5 and 1 m/s
  EXPECT_NEAR(last(table("couette/planes.csv"), "plane", "across", "flow_rate"), flow, 1e-5 * flow);
  const auto line = table("couette/lines.csv");
  for (std::size_t n = 0; n < line.rows.size(); ++n) {
    const double s = line.numbers("z")[n] / 1e-3;
    EXPECT_NEAR(line.numbers("u")[n], -0.5 + 1.5 * s, 1e-7);
    EXPECT_NEAR(line.numbers("v")[n], 0.5 * s, 1e-7);
  }
  const auto force = table("couette/forces.csv");
  const double drag = 1.806e-5 * 1.5e3 * 6.25e-5 * 6.25e-5;  // mu du/dz A
  EXPECT_NEAR(last(force, "patch", "z-min", "fx"), drag, 1e-5 * drag);
  EXPECT_NEAR(last(force, "patch", "z-max", "fx"), -drag, 1e-5 * drag);
  // No inlet that a step could follow: the lids set it from the start (5 % is the window of follow-ramp).
  ASSERT_EQ(run("follow", couette, "--no-report --until 1ms --set numerics.time_step=\"follow-ramp\""), 0)
      << text("follow.log");
  const double step = 0.025 * 6.25e-5 / std::hypot(1.0, 0.5);
  EXPECT_NEAR(table("follow/history.csv").numbers("dt").back(), step, 0.05 * step);
}

// Air at rest under a body force of 100 N/m^3, 1 mm high: 0.1 Pa from top to floor, linear; the lattice holds it to the
// single digit of 1e-8 that sound has left after 2 ms. The walls lie half a cell beyond the outermost centres.
TEST_F(AirScene, PressureIsReadUpToTheWalls) {
  ASSERT_EQ(run("rest", R"toml(
schema = 1
name = "hydrostatic"
[geometry]
generator = "box"
[geometry.box]
x = "0.3 mm"
y = "0.3 mm"
z = "1 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.2e-3 Pa s"
body_force = [0.0, 0.0, -100.0]
)toml" + periodic_sides + R"toml(
[numerics]
dx = "0.1 mm"
reference_speed = "1 m/s"
lattice_speed = 0.05
time_step = "fixed"
les = "none"
precision = "double"
[stop]
time = "2 ms"
[output]
statistics = "0.1 ms"
probe = [{ name = "floor", at = [0.00015, 0.00015, 0.0] }, { name = "middle", at = [0.00015, 0.00015, 0.0005] }, { name = "top", at = [0.00015, 0.00015, 0.001] }]
)toml"),
            0)
      << text("rest.log");
  const auto probes = table("rest/probes.csv");
  EXPECT_NEAR(last(probes, "probe", "floor", "p"), 0.05, 1e-7);
  EXPECT_NEAR(last(probes, "probe", "top", "p"), -0.05, 1e-7);
}

// A body force from a table, uniform and linear in time, in a box without walls: u = int f dt / rho exactly.
TEST_F(AirScene, ABodyForceFromATableIsLinearBetweenItsRows) {
  std::ofstream(folder_ / "force.csv") << "time,fx,fy,fz\n0,0,0,10\n1e-3,1000,0,10\n2e-3,1000,0,10\n";
  const std::string box = R"toml(
schema = 1
name = "push"
[geometry]
generator = "box"
[geometry.box]
x = "0.25 mm"
y = "0.25 mm"
z = "0.25 mm"
)toml" + air + R"toml(
body_force = { file = "force.csv" }
)toml" + periodic_sides + R"toml(
[[air.boundary]]
patch = "z-min"
type = "periodic"
with = "z-max"
)toml" + numerics + R"toml(
reference_speed = "1 m/s"
[stop]
time = "1.5 ms"
[output]
statistics = "0.5 ms"
probe = [{ name = "p", at = [1e-4, 1e-4, 1e-4] }]
)toml";
  ASSERT_EQ(run("push", box), 0) << text("push.log");
  const auto probes = table("push/probes.csv");
  // Mid-step values are exact for the linear pieces; the kink falls into one step of 3 us: 1e-6 of the whole.
  const double end = probes.numbers("time").back();  // a whole number of steps: up to one past 1.5 ms
  EXPECT_NEAR(probes.numbers("u").back(), (0.5 * 1000e-3 + 1000 * (end - 1e-3)) / 1.204, 1e-4);
  EXPECT_NEAR(probes.numbers("w").back(), 10 * end / 1.204, 1e-5);
}

}  // namespace
}  // namespace puffin::test
