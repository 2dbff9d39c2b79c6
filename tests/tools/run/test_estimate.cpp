// What `puffin estimate` says, beside the run that follows.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/sanitized.hpp"
#include "tests/tools/run/small_dose.hpp"
#include "tools/output/summary.hpp"

namespace puffin {
namespace {

using Estimate = SmallDose;

// The rehearsal is the run's own beginning, outputs and a checkpoint included: what a run allocates later are contacts,
// histories and later frames, below a tenth of some 80 MB (the promise of the command is 10 %).
TEST_F(Estimate, MemoryIsThatOfTheRun) {
  const std::string program = std::string(PUFFIN_BINARY_DIR) + "/puffin ";
  const std::string here = "cd " + folder_.string() + " && mkdir -p tmp && ";
  ASSERT_EQ(std::system((here + "TMPDIR=$PWD/tmp " + program + "estimate case.toml --json > e.json").c_str()), 0);
  ASSERT_EQ(std::system((here + program + "run case.toml --quiet --out run").c_str()), 0);
  std::ifstream stream(folder_ / "e.json");
  const auto said = nlohmann::json::parse(stream);
  const double memory = output::read_summary(folder_ / "run/summary.json").memory_peak;
  if (!sanitized) {  // a sanitizer takes memory of its own
    EXPECT_NEAR(said["memory"].get<double>(), memory, 0.1 * memory);
  }
  EXPECT_LT(said["seconds_low"].get<double>(), said["seconds"].get<double>());
  EXPECT_GT(said["seconds_high"].get<double>(), said["seconds"].get<double>());
  EXPECT_GT(said["rehearsed_steps"].get<int>(), 10);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp"));  // nothing is left of the rehearsal
}

// A sphere without fines leaves a duct after 0.01 ms of 1000 s, and with it all that the run is about.
TEST_F(Estimate, ARehearsalThatComesToTheEndOfTheRunIsTheAnswer) {
  std::ofstream(folder_ / "short.toml") << R"toml(
schema = 1
name = "short"
geometry = { generator = "duct", duct = { length = "2 mm", width = "1 mm", height = "1 mm" } }
numerics = { dx = "0.2 mm" }
stop = { time = "1000 s" }
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = "1 L/min"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[carriers]
list = [{ position = [1.8e-3, 5e-4, 5e-4], velocity = [20.0, 0.0, 0.0], diameter = "70 um", density = "1520 kg/m^3" }]
contact = { restitution = 0.6, friction = 0.3 }
)toml";
  const std::string program = "cd " + folder_.string() + " && " + PUFFIN_BINARY_DIR + "/puffin ";
  ASSERT_EQ(std::system((program + "estimate short.toml --json > short.json").c_str()), 0);
  ASSERT_EQ(std::system((program + "run short.toml --quiet --out short").c_str()), 0);
  std::ifstream stream(folder_ / "short.json");
  const auto said = nlohmann::json::parse(stream);
  EXPECT_EQ(said["steps"].get<std::int64_t>(), output::read_summary(folder_ / "short/summary.json").steps);
  EXPECT_EQ(said["steps"].get<std::int64_t>(), said["rehearsed_steps"].get<std::int64_t>());
  EXPECT_LT(said["seconds"].get<double>(), 100.0);
}

// No air step and no carrier is there to be counted, and still the transport takes its time: what is rehearsed in 5 s
// lasts less than 10 s of the cloud's time (400,000 steps of its 2000 cells), so 1000 s take more than 500 s.
TEST_F(Estimate, FinesInFrozenAirAreRehearsedToo) {
  std::ofstream(folder_ / "cloud.toml") << R"toml(
schema = 1
name = "cloud"
geometry = { generator = "box", box = { x = "1 mm", y = "0.5 mm", z = "0.5 mm" } }
numerics = { dx = "0.05 mm" }
stop = { time = "1000 s", when_empty = false }
[air]
model = "frozen"
field = "uniform"
velocity = [2.0, 0.0, 0.0]
boundary = [ { patch = "x-min", type = "periodic", with = "x-max" } ]
[[fines.scalar]]
name = "cloud"
initial = { shape = "gaussian", center = [5e-4, 2.5e-4, 2.5e-4], sigma = "0.1 mm", amount = 1000.0 }
)toml";
  const std::string program = std::string(PUFFIN_BINARY_DIR) + "/puffin ";
  ASSERT_EQ(
      std::system(("cd " + folder_.string() + " && " + program + "estimate cloud.toml --json > cloud.json").c_str()),
      0);
  std::ifstream stream(folder_ / "cloud.json");
  const auto said = nlohmann::json::parse(stream);
  EXPECT_EQ(said["rehearsed_steps"].get<int>(), 0);
  EXPECT_GT(said["seconds"].get<double>(), 500.0);
}

// Plain BGK at the real viscosity diverges with the full flow, whatever the step; the rehearsal is the run's beginning.
TEST_F(Estimate, ARehearsalThatDivergesSaysSo) {
  const std::string command = "cd " + folder_.string() + " && " + PUFFIN_BINARY_DIR + "/puffin estimate " +
                              PUFFIN_SOURCE_DIR +
                              "/cases/stability/step-inlet.toml --set numerics.collision=bgk --json "
                              "> failed.json 2> failed.log";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 5) << text("failed.log");
  std::ifstream stream(folder_ / "failed.json");
  const std::string said = nlohmann::json::parse(stream)["warnings"].dump();
  EXPECT_NE(said.find("the rehearsal failed, as a run would (exit code 5)"), std::string::npos) << said;
}

}  // namespace
}  // namespace puffin
