// Whole runs of the program with fields from files and runs, pressures, misplaced samplers, a turbulent inlet; and what
// a law was not made for.

#include "tests/tools/run/air_scene.hpp"
#include "tools/output/stats_file.hpp"

namespace puffin::test {
namespace {

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
  EXPECT_NE(text("late.log").find("has no field at 0.07 s"), std::string::npos) << text("late.log");
}

TEST_F(AirScene, AFrozenFieldMayComeFromATable) {
  std::ofstream(folder_ / "field.csv") << "x,y,z,u,v,w\n0,0,0,0,0,0\n0,0,0.001,2,0,0\n";
  ASSERT_EQ(run("table", frozen_channel + "field = { file = \"field.csv\" }\n" + carrier), 0) << text("table.log");
  EXPECT_NEAR(table("table/tracks.csv").numbers("u").back(), 1.0, 1e-6);
  std::ofstream(folder_ / "field.csv") << "x,y,z,u,v\n0,0,0,0,0\n";
  EXPECT_EQ(run("bad", frozen_channel + "field = { file = \"field.csv\" }\n" + carrier), 3);
  EXPECT_NE(text("bad.log").find("lacks the columns w"), std::string::npos) << text("bad.log");
}

// Omega times the axis' direction, however long the axis was written: at z = 0.8 mm, 0.3 mm over the centre,
// u = 100/s 0.3 mm. `check` asks for no cells, and probes and lines read the field.
TEST_F(AirScene, AFrozenFieldIsReadByProbesAndNeedsNoCells) {
  const std::string scene =
      frozen_channel +
      "field = \"solid-body\"\naxis = [0.0, 2.0, 0.0]\nomega = 100.0\ncenter = [0.0015, 3e-5, 0.0005]\n" + carrier +
      "statistics = \"0.5 ms\"\nprobe = [{ name = \"p\", at = [0.0015, 3e-5, 0.0008] }]\n"
      "line = [{ name = \"l\", from = [0.0015, 3e-5, 0.0005], to = [0.0015, 3e-5, 0.0009], points = 3 }]\n";
  ASSERT_EQ(run("turning", scene), 0) << text("turning.log");
  EXPECT_NEAR(table("turning/probes.csv").numbers("u").back(), 100.0 * 0.3e-3, 1e-12);
  EXPECT_NEAR(table("turning/lines.csv").numbers("u").back(), 100.0 * 0.4e-3, 1e-12);
  const std::string program = std::string(PUFFIN_BINARY_DIR) + "/puffin check ";
  EXPECT_EQ(std::system((program + (folder_ / "turning.toml").string() + " > /dev/null 2>&1").c_str()), 0);
}

// A cloud in a uniform field of 2 m/s through a duct of 4 mm whose inlet and outlet have no boundary leaves by the
// outlet within 3 ms; were that closed, its cells would fill up. No pressure drops are told of air that has none.
TEST_F(AirScene, FinesInAFrozenFieldLeaveThroughTheOutletWithoutABoundary) {
  ASSERT_EQ(run("cloud", R"toml(
schema = 1
name = "cloud"
[geometry]
generator = "duct"
[geometry.duct]
length = "4 mm"
width = "2 mm"
height = "2 mm"
[air]
model = "frozen"
field = "uniform"
velocity = [2.0, 0.0, 0.0]
[numerics]
dx = "0.25 mm"
[fines]
[[fines.scalar]]
name = "g"
diffusion = 0
initial = { shape = "gaussian", center = [0.002, 0.001, 0.001], sigma = "0.2 mm", amount = 500 }
[stop]
time = "4 ms"
when_empty = false
[output]
statistics = "1 ms"
)toml"),
            0)
      << text("cloud.log");
  EXPECT_GT(table("cloud/history.csv").numbers("FFE").back(), 0.99);
  EXPECT_NE(text("cloud/summary.json").find("\"window\": null"), std::string::npos);
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

// Two hit the floor, at 2 and 10 m/s, under a law for at most 3 m/s: the second is told, once.
TEST_F(AirScene, AnImpactFasterThanItsLawWasMadeForIsTold) {
  std::ofstream(folder_ / "law.toml") << "label = \"given\"\nsource = \"test\"\n[wall_detach]\nlaw = \"power\"\nA = "
                                         "[0.02, 1.5, 2.0, 0.03, 0.8]\nvalid = "
                                         "[0.0, 3.0]\n";
  const std::string scene = R"toml(
schema = 1
name = "fast"
[geometry]
generator = "box"
[geometry.box]
x = "2 mm"
y = "2 mm"
z = "2 mm"
[air]
model = "none"
[carriers]
fines_each = 2000
gravity = [0.0, 0.0, 0.0]
diameter = "70 um"
density = 1520
list = [
  { position = [5e-4, 1e-3, 1e-3], velocity = [0, 0, -2] },
  { position = [15e-4, 1e-3, 1e-3], velocity = [0, 0, -10] },
]
[fines]
micromodels = "law.toml"
[[fines.scalar]]
name = "fines"
[stop]
time = "1 ms"
)toml";
  ASSERT_EQ(run("fast", scene, "--no-report"), 0) << text("fast.log");
  const auto warnings = output::read_summary(folder_ / "fast/summary.json").warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("an impact on a wall, at 10 m/s (t = 9.65e-05 s)"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("made for, 3 m/s"), std::string::npos) << warnings[0];
}

// Only differences of pressure move air: 100 Pa at the outlet, 30 times what the lattice could hold as density, change
// no speed by a bit, and are read everywhere; the floor carries them.
TEST_F(AirScene, APressureThatAllOutletsHaveIsAddedToWhatIsRead) {
  const std::string floor = "[[geometry.patch]]\nname = \"floor\"\nselect = \"plane:z-min\"\n";
  std::string lifted = channel;
  lifted.replace(lifted.find("type = \"pressure-outlet\""), 24, "type = \"pressure-outlet\"\npressure = \"100 Pa\"");
  const std::string more = "--until 1ms --set 'air.initial_velocity=[0.1,0.0,0.0]' --set 'output.force=[\"floor\"]'";
  ASSERT_EQ(run("plain", channel + floor, more), 0) << text("plain.log");
  ASSERT_EQ(run("lifted", lifted + floor, more), 0) << text("lifted.log");
  const auto value = [&](const char* name, const char* of, const char* column) {
    const auto t = table(std::string(name) + "/" + of);
    return t.numbers(column).back();
  };
  for (const char* column : {"static_drop", "total_to_static_drop"})  // of numbers near 100: rounding
    EXPECT_NEAR(value("lifted", "history.csv", column), value("plain", "history.csv", column), 1e-9) << column;
  EXPECT_EQ(value("lifted", "probes.csv", "u"), value("plain", "probes.csv", "u"));
  EXPECT_NEAR(value("lifted", "probes.csv", "p") - value("plain", "probes.csv", "p"), 100.0, 1e-6);
  EXPECT_NEAR(value("lifted", "planes.csv", "static_pressure") - value("plain", "planes.csv", "static_pressure"), 100.0,
              1e-6);
  EXPECT_EQ(value("lifted", "planes.csv", "flow_rate"), value("plain", "planes.csv", "flow_rate"));
  EXPECT_NEAR(value("lifted", "forces.csv", "fz") - value("plain", "forces.csv", "fz"), -100.0 * 3e-3 * 6.25e-5, 1e-12);
}

// P07 through the files of a run: in a closed periodic box the air's momentum, with what the carriers have given and it
// has yet to take, and the carriers' are constant: to 1e-10 of it in double, as the catalogue asks. Without what is on
// its way it was off by 2e-3.
TEST_F(AirScene, TheMomentumOfAirAndCarriersIsConstantInAPeriodicBox) {
  std::string sides;
  for (const char* axis : {"x", "y", "z"})
    sides += std::string("[[air.boundary]]\npatch = \"") + axis + "-min\"\ntype = \"periodic\"\nwith = \"" + axis +
             "-max\"\n";
  const std::string scene =
      "schema = 1\nname = \"box\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\nx = \"2 mm\"\ny = "
      "\"2 mm\"\nz = \"2 mm\"\n[air]\n" +
      sides + R"toml(
[numerics]
dx = "0.1 mm"
reference_speed = "2 m/s"
precision = "double"
[carriers]
gravity = [0.0, 0.0, 0.0]
diameter = "70 um"
density = 1520
list = [
  { position = [0.9e-3, 0.92e-3, 1.13e-3], velocity = [3.0, 0.5, 0.0] },
  { position = [1.05e-3, 1.19e-3, 0.87e-3], velocity = [3.0, 0.5, 0.0] },
]
[stop]
time = "0.1 ms"
[output]
statistics = "0.02 ms"
)toml";
  ASSERT_EQ(run("box", scene, "--no-report"), 0) << text("box.log");
  const auto file = folder_ / "box/stats.h5";
  const double whole = 2.0 * 1520.0 * 3.14159265358979 / 6.0 * 343e-15 * 3.0;
  for (const char* axis : {"x", "y", "z"}) {
    const auto air = output::read_stats(file, std::string("air_momentum_") + axis);
    const auto carriers = output::read_stats(file, std::string("carrier_momentum_") + axis);
    ASSERT_EQ(air.size(), 6U);
    for (std::size_t n = 0; n < air.size(); ++n)
      EXPECT_NEAR(air[n] + carriers[n], air[0] + carriers[0], 1e-10 * whole) << axis << ' ' << n;
    if (*axis == 'x') EXPECT_GT(air.back(), 1e-4 * whole);  // something was exchanged
  }
}

}  // namespace
}  // namespace puffin::test
