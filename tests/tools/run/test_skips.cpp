// What a run leaves out of the motion of its carriers, put back in: the answer stays.

#include "tests/tools/run/air_scene.hpp"

namespace puffin::test {
namespace {

/// A carrier that adheres to the floor of a duct, until the flow, which grows for 4 ms, takes it along.
const std::string held_carrier = R"toml(
schema = 1
name = "held carrier"
[geometry]
generator = "duct"
[geometry.duct]
length = "4 mm"
width = "1 mm"
height = "1 mm"
)toml" + air + R"toml(
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "0 L/min"], ["4 ms", "1.2 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.1 mm"
time_step = "fixed"
[carriers]
list = [{ position = [0.0012, 0.0005, 0.00005], velocity = [0.0, 0.0, 0.0], diameter = "100 um", density = "1520 kg/m^3" }]
gravity = [0.0, 0.0, -9.81]
rotation = false
[carriers.contact]
model = "linear"
restitution = 0.6
friction = 0.4
[carriers.adhesion]
model = "dmt"
surface_energy = "1.8e-3 J/m^2"
[stop]
time = "6 ms"
[output]
statistics = "1 ms"
carriers = "0.5 ms"
)toml";

// A sleeper wakes in the exchange in which its load has changed by a part of what holds it, and friction lets it go at
// the same load whether it slept or not. While all sleep the air is asked every 16 steps, so it can go 16 steps late at
// most, and is then that part of its speed behind.
TEST_F(AirScene, ASleeperLeavesWithTheAirAsIfItHadNotSlept) {
  const std::string skip = "--no-report --threads 1 --set numerics.skip.";
  ASSERT_EQ(run("skipped", held_carrier, "--no-report --threads 1"), 0) << text("skipped.log");
  ASSERT_EQ(run("asked", held_carrier, skip + "resting_exchange=false"), 0) << text("asked.log");
  ASSERT_EQ(run("awake", held_carrier, skip + "resting_exchange=false --set numerics.skip.sleeping_carriers=false"), 0)
      << text("awake.log");
  const output::CsvTable awake = table("awake/tracks.csv"), asked = table("asked/tracks.csv"),
                         skipped = table("skipped/tracks.csv");
  const double x = awake.numbers("x").back(), speed = awake.numbers("u").back();
  ASSERT_GT(x, 0.0012 + 5e-4) << "it has left its place";
  ASSERT_LT(awake.numbers("x")[3], 0.0012 + 1e-6) << "but not at once";
  const double dt = output::read_summary(folder_ / "awake/summary.json").dt_max;
  EXPECT_NEAR(asked.numbers("x").back(), x, 5 * dt * speed) << "an exchange every 5 steps";
  EXPECT_NEAR(skipped.numbers("x").back(), x, 16 * dt * speed);
  const auto times = [&](const std::string& run, const std::string& name) {
    for (const auto& s : output::read_summary(folder_ / run / "summary.json").skipped)
      if (s.name == name) return s.times;
    return std::int64_t{0};
  };
  EXPECT_GT(times("skipped", "exchanges with the air while every carrier sleeps"), 100);
  EXPECT_EQ(times("asked", "exchanges with the air while every carrier sleeps"), 0);
  EXPECT_GT(times("asked", "steps of sleeping carriers"), 300);
  EXPECT_EQ(times("awake", "steps of sleeping carriers"), 0);
}

/// A carrier thrown through a duct at its floor, which it hits after 0.4 ms; it stays in sight.
const std::string thrown_carrier = R"toml(
schema = 1
name = "thrown carrier"
[geometry]
generator = "duct"
[geometry.duct]
length = "8 mm"
width = "1 mm"
height = "1 mm"
[air]
model = "frozen"
field = "uniform"
velocity = [2.0, 0.0, 0.0]
density = "1.204 kg/m^3"
viscosity = "1.806e-5 Pa s"
[numerics]
time_step = "10 us"
[carriers]
list = [{ position = [0.001, 0.0005, 0.00045], velocity = [1.0, 0.0, -1.0], diameter = "100 um", density = "1520 kg/m^3" }]
gravity = [0.0, 0.0, -9.81]
rotation = false
[carriers.contact]
model = "linear"
restitution = 0.6
friction = 0.0
[stop]
time = "1 ms"
[output]
statistics = "1 ms"
carriers = "0.5 ms"
)toml";

// Between contacts the closed form is exact, and an impact returns its speed within 0.1 % (dem/linear_contact.hpp): two
// runs differ by at most 0.2 % of 1 m/s, for as long as they have flown since.
TEST_F(AirScene, ACarrierInFreeFlightArrivesByContactStepsToo) {
  const std::string off = "--no-report --threads 1 --set numerics.skip.free_flight=false";
  ASSERT_EQ(run("closed", thrown_carrier, "--no-report --threads 1"), 0) << text("closed.log");
  ASSERT_EQ(run("stepped", thrown_carrier, off), 0) << text("stepped.log");
  const output::CsvTable closed = table("closed/tracks.csv"), stepped = table("stepped/tracks.csv");
  ASSERT_EQ(closed.rows.size(), stepped.rows.size());
  EXPECT_GT(closed.numbers("w").back(), 0.5) << "it has hit the floor";
  for (const char* speed : {"u", "v", "w"})
    EXPECT_NEAR(stepped.numbers(speed).back(), closed.numbers(speed).back(), 2e-3) << speed;
  for (const char* place : {"x", "y", "z"})
    EXPECT_NEAR(stepped.numbers(place).back(), closed.numbers(place).back(), 2e-3 * 0.6e-3) << place;
}

}  // namespace
}  // namespace puffin::test
