// Whole runs of the program: the ledger closes, the answer does not depend on the threads, failures say where.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tools/output/csv_file.hpp"
#include "tools/output/events_file.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/vtk_series.hpp"

namespace {

using namespace puffin;

/// A small dose in the L-bend, hit at once by air at 36 L/min: in 10 ms carriers leave the pocket and hit walls.
constexpr const char* small_dose = R"toml(
schema = 1
name = "small-dose"
[geometry]
generator = "l-bend"
[geometry.l-bend]
facet_size = "2 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
flow_rate = [["0 s", "0 L/min"], ["4 ms", "40 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.5 mm"
[carriers]
count = 1000
parcel = 10
diameter = "70 um"
density = "1520 kg/m^3"
fines_each = 2000
fine_mass_ratio = 2e-5
gravity = [0.0, 0.0, -9.81]
rotation = false
[carriers.fill]
shape = "cylinder"
at = "pocket"
gap = 0.2
[carriers.contact]
model = "linear"
restitution = 0.6
friction = 0.3
[carriers.adhesion]
model = "hamaker"
surface_energy = "3.6e-3 J/m^2"
cutoff_gap = "0.4 nm"
[fines]
micromodels = "lactose-3.6e-3.toml"
[[fines.scalar]]
name = "fines"
diffusion = "1e-6 kg/(m s)"
[stop]
time = "10 ms"
[output]
statistics = "0.5 ms"
carriers = "2 ms"
fields = [{ what = ["velocity", "fines"], region = "slice:y=0", every = "5 ms" }]
)toml";

class Run : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("puffin-run-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << small_dose;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Exit code of `puffin run case.toml --out NAME` with more arguments; what it says goes to NAME.log.
  int run(const std::string& name, const std::string& arguments) const {
    const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin run " + (folder_ / "case.toml").string() +
                                " --out " + (folder_ / name).string() + " " + arguments + " >/dev/null 2>" +
                                (folder_ / (name + ".log")).string();
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    std::stringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  std::filesystem::path folder_;
};

// The ledger: every event books what it takes to one rounding, sums are compensated: 1e-10 of the dose leaves four
// orders of room. FFE + FFW + FFCR + FFCE + in_air = 1 + that error.
TEST_F(Run, TheLedgerClosesAtEveryOutputAndThreadsDoNotChangeTheAnswer) {
  ASSERT_EQ(run("two", "--threads 2"), 0) << text("two.log");
  ASSERT_EQ(run("one", "--threads 1"), 0) << text("one.log");
  const auto history = output::read_csv(folder_ / "two" / "history.csv");
  ASSERT_GT(history.rows.size(), 20U);
  for (const double error : history.numbers("ledger_error")) EXPECT_LT(std::abs(error), 1e-10);

  const output::Summary two = output::read_summary(folder_ / "two" / "summary.json");
  ASSERT_TRUE(two.carriers && two.collisions);
  EXPECT_TRUE(two.carriers->first_motion) << "no carrier moved: the scene is meant to lift the dose";
  EXPECT_GT(two.collisions->wall, 0.0);
  ASSERT_EQ(two.fines.size(), 1U);
  EXPECT_GT(two.fines[0].FFE + two.fines[0].in_air, 0.0);
  EXPECT_NEAR(two.fines[0].FFE + two.fines[0].FFW + two.fines[0].FFCR + two.fines[0].FFCE + two.fines[0].in_air, 1.0,
              1e-10);

  EXPECT_EQ(text("one/history.csv"), text("two/history.csv"));
  const auto a = output::read_events(folder_ / "one" / "events.h5"),
             b = output::read_events(folder_ / "two" / "events.h5");
  ASSERT_EQ(a.size(), b.size());
  double detached = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].time_start, b[n].time_start);
    EXPECT_EQ(a[n].normal_speed, b[n].normal_speed);
    detached += a[n].detached;
  }
  EXPECT_GT(detached, 0.0);
  EXPECT_FALSE(output::read_pvd(folder_ / "one" / "vtk" / "carriers.pvd").empty());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "one" / "report.html"));
}

TEST_F(Run, ARunThatDivergesEndsWith5AndSaysWhere) {
  // A step five times longer than the inlet's speed allows: 0.5 in lattice units.
  EXPECT_EQ(run("bad", "--set numerics.time_step=4e-6 --until 10ms"), 5);
  const output::Summary s = output::read_summary(folder_ / "bad" / "summary.json");
  EXPECT_EQ(s.state, "diverged");
  EXPECT_NE(s.message.find("the first at ["), std::string::npos) << s.message;
}

TEST_F(Run, AFinishedRunIsNotOverwritten) {
  ASSERT_EQ(run("once", "--until 0.2ms"), 0) << text("once.log");
  EXPECT_EQ(run("once", "--until 0.2ms"), 7);
}

}  // namespace
