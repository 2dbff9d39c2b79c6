// Whole runs of the program on scenes with exact solutions: boundaries, fields and samplers of the air.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tools/output/csv_file.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/vtk_series.hpp"

namespace {

using namespace puffin;

const std::string air = R"toml(
[air]
density = "1.204 kg/m^3"
viscosity = "1.806e-5 Pa s"
)toml";
const std::string numerics = R"toml(
[numerics]
dx = "0.0625 mm"
lattice_speed = 0.05
time_step = "fixed"
les = "none"
precision = "double"
)toml";

/// Plane channel 1 mm high, 3 mm long, one cell wide: parabolic inlet of mean 0.5 m/s, Re 33.
const std::string channel = R"toml(
schema = 1
name = "channel"
[geometry]
generator = "duct"
[geometry.duct]
length = "3 mm"
width = "0.0625 mm"
height = "1 mm"
)toml" + air + R"toml(
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
profile = "parabolic"
velocity = "0.5 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[[air.boundary]]
patch = "y-max"
type = "periodic"
with = "y-min"
)toml" + numerics + R"toml(
[stop]
time = "40 ms"
[output]
statistics = "4 ms"
force = ["wall"]
line = [{ name = "across", from = [0.0015, 3e-5, 0.0], to = [0.0015, 3e-5, 0.001], points = 41 }]
plane = [
  { name = "first", normal = "x", at = "1 mm" },
  { name = "second", normal = "x", at = "2.02 mm" },
  { name = "end", normal = "x", at = "3 mm" },
]
probe = [{ name = "wall", at = [0.0015, 3e-5, 1e-5] }]
fields = [{ what = ["velocity"], region = "all", every = "20 ms" }]
)toml";

class AirScene : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("puffin-air-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  int run(const std::string& name, const std::string& text, const std::string& more = "") const {
    std::ofstream(folder_ / (name + ".toml")) << text;
    const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin run " +
                                (folder_ / (name + ".toml")).string() + " --out " + (folder_ / name).string() +
                                " --quiet " + more + " >/dev/null 2>" + (folder_ / (name + ".log")).string();
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    std::stringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  output::CsvTable table(const std::string& name) const { return output::read_csv(folder_ / name); }
  std::filesystem::path folder_;
};

/// Last value of a column among the rows whose `key` column is `name`.
double last(const output::CsvTable& t, const std::string& key, const std::string& name, const std::string& column) {
  double value = std::nan("");
  const auto numbers = t.numbers(column);
  for (std::size_t n = 0; n < t.rows.size(); ++n)
    if (t.rows[n][t.find(key)] == name) value = numbers[n];
  return value;
}

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
    EXPECT_NEAR(u[n], 3.0 * s * (1.0 - s), 0.006 * 0.75) << "z = " << s;
  }
  EXPECT_NEAR(u.front(), 0.0, 1e-12);
  EXPECT_NEAR(u.back(), 0.0, 1e-12);
  EXPECT_NEAR(last(table("channel/probes.csv"), "probe", "wall", "u"), 3.0 * 0.01 * 0.99, 0.006 * 0.75);

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
  // Friction on both walls over 3 mm = pressure drop times the section.
  const auto force = table("channel/forces.csv");
  EXPECT_NEAR(last(force, "patch", "wall", "fx"), slope * 3e-3 * 6.25e-8, 0.01 * slope * 3e-3 * 6.25e-8);
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
)toml" + air + R"toml(
[[air.boundary]]
patch = "x-min"
type = "periodic"
with = "x-max"
[[air.boundary]]
patch = "y-min"
type = "periodic"
with = "y-max"
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
)toml";
  ASSERT_EQ(run("couette", couette), 0) << text("couette.log");
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
[[air.boundary]]
patch = "x-min"
type = "periodic"
with = "x-max"
[[air.boundary]]
patch = "y-min"
type = "periodic"
with = "y-max"
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
  EXPECT_NEAR(probes.numbers("u").back(), (0.5 * 1000e-3 + 1000 * 0.5e-3) / 1.204, 1e-4);
  EXPECT_NEAR(probes.numbers("w").back(), 10 * 1.5e-3 / 1.204, 1e-5);
}

const std::string carrier = R"toml(
[carriers]
list = [{ position = [0.0005, 3e-5, 0.0005], velocity = [0.0, 0.0, 0.0], diameter = "2 um", density = "1000 kg/m^3" }]
gravity = [0.0, 0.0, 0.0]
rotation = false
[stop]
time = "1 ms"
[output]
carriers = "0.25 ms"
)toml";
const std::string frozen_channel = R"toml(
schema = 1
name = "frozen"
[geometry]
generator = "duct"
[geometry.duct]
length = "3 mm"
width = "0.0625 mm"
height = "1 mm"
[air]
model = "frozen"
density = "1.204 kg/m^3"
viscosity = "1.806e-5 Pa s"
)toml";

// Stokes time of a carrier of 2 um: 12 us. In the stored field of the channel it soon has the speed of the air, 0.75
// m/s in the middle (to the 0.6 % of the field).
TEST_F(AirScene, AFrozenFieldMayBeThatOfAnotherRun) {
  ASSERT_EQ(run("channel", channel), 0) << text("channel.log");
  const std::string field = "field = { run = \"channel\", at = \"40 ms\" }\n";
  ASSERT_EQ(run("frozen", frozen_channel + field + carrier), 0) << text("frozen.log");
  EXPECT_NEAR(table("frozen/tracks.csv").numbers("u").back(), 0.75, 0.006);
  const std::string late = "field = { run = \"channel\", at = \"70 ms\" }\n";
  EXPECT_EQ(run("late", frozen_channel + late + carrier), 3);
  EXPECT_NE(text("late.log").find("has no field at 70 ms"), std::string::npos) << text("late.log");
}

TEST_F(AirScene, AFrozenFieldMayComeFromATable) {
  std::ofstream(folder_ / "field.csv") << "x,y,z,u,v,w\n0,0,0,0,0,0\n0,0,0.001,2,0,0\n";
  ASSERT_EQ(run("table", frozen_channel + "field = { file = \"field.csv\" }\n" + carrier), 0) << text("table.log");
  EXPECT_NEAR(table("table/tracks.csv").numbers("u").back(), 1.0, 1e-6);
  std::ofstream(folder_ / "field.csv") << "x,y,z,u,v\n0,0,0,0,0\n";
  EXPECT_EQ(run("bad", frozen_channel + "field = { file = \"field.csv\" }\n" + carrier), 3);
  EXPECT_NE(text("bad.log").find("lacks the columns w"), std::string::npos) << text("bad.log");
}

TEST_F(AirScene, SamplersOutsideTheFluidAreRefusedAtTheirPlace) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string t = channel;
    return t.replace(t.find(from), from.size(), to);
  };
  EXPECT_EQ(run("probe", with("at = [0.0015, 3e-5, 1e-5]", "at = [0.0015, 3e-5, 2.0]")), 3);
  EXPECT_NE(text("probe.log").find("probe.toml:"), std::string::npos) << text("probe.log");
  EXPECT_NE(text("probe.log").find("'wall' lies outside the fluid"), std::string::npos) << text("probe.log");
  EXPECT_EQ(run("plane", with("at = \"3 mm\"", "at = \"3.2 mm\"")), 3);
  EXPECT_EQ(run("slice", with("region = \"all\"", "region = \"slice:z=2mm\"")), 3);
}

TEST_F(AirScene, AnInletMayBeTurbulentAndKeepsItsFlow) {
  std::string t = channel;
  const std::string anchor = "velocity = \"0.5 m/s\"";
  t.replace(t.find(anchor), anchor.size(), anchor + "\nturbulence = 0.1");
  ASSERT_EQ(run("calm", channel, "--until 8ms"), 0) << text("calm.log");
  ASSERT_EQ(run("rough", t, "--until 8ms"), 0) << text("rough.log");
  const double calm = last(table("calm/planes.csv"), "plane", "first", "flow_rate"),
               rough = last(table("rough/planes.csv"), "plane", "first", "flow_rate");
  EXPECT_NEAR(rough, calm, 2e-3 * calm);
  EXPECT_NE(last(table("calm/probes.csv"), "probe", "wall", "u"),
            last(table("rough/probes.csv"), "probe", "wall", "u"));
}

}  // namespace
