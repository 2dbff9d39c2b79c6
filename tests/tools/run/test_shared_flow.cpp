// Cases that share a flow end each for itself.

#include "tests/tools/run/batch_study.hpp"
#include "tests/tools/run/towards_the_floor.hpp"
#include "tools/output/study_results.hpp"
#include "tools/output/summary.hpp"

namespace {

using namespace puffin;
using namespace puffin::test;

/// One carrier of 70 um, 5 um over the floor and 1 m/s towards it.
const std::string one_carrier = towards_the_floor + R"toml(
youngs_modulus = "1 GPa"
[[carriers.list]]
position = [3e-3, 1e-3, 4e-5]
velocity = [0.0, 0.0, -1.0]
spin = [0.0, 0.0, 0.0]
diameter = "70 um"
density = 1520
[stop]
time = "0.1 ms"
[output]
carriers = "0.1 ms"
)toml";

// Of the two that fail the one would own the air, as it runs the longest, and the other owns it and ends on the way: a
// carrier of 18.8 kPa goes in by more than 0.3 diameters (test_run_health.cpp).
TEST_F(BatchStudy, OfASharedFlowAFailedCaseFailsAloneWithItsOwnCodeAndMessage) {
  file("case.toml", one_carrier);
  file(
      "study.toml",
      "base = \"case.toml\"\nshare = [\"one-way-flow\"]\n[[case]]\nname = \"outside\"\nset = { "
      "\"carriers.list[0].position\" = [0.1, 0.0, 0.0], \"stop.time\" = \"0.4 ms\" }\n[[case]]\nname = \"soft\"\nset "
      "= { \"carriers.contact.youngs_modulus\" = \"18.8 kPa\", \"stop.time\" = \"0.3 ms\" }\n[[case]]\nname = \"b\"\n");
  EXPECT_EQ(batch("--jobs 1 --threads 1"), 8) << text("log.txt");
  const output::StudyResults results = output::read_study_results(folder_ / "out");
  ASSERT_EQ(results.cases.size(), 3U);
  const auto& outside = results.cases[0].runs[0];
  EXPECT_EQ(outside.exit_code, 3);
  EXPECT_NE(outside.message.find("outside the geometry"), std::string::npos) << outside.message;
  const auto& soft = results.cases[1].runs[0];
  EXPECT_EQ(soft.exit_code, 5);
  EXPECT_NE(soft.message.find("of its diameter"), std::string::npos) << soft.message;
  EXPECT_NE(text("out/soft/seed-1/run.log").find(soft.message), std::string::npos) << "its own log says why";
  EXPECT_EQ(output::read_status(folder_ / "out/soft/seed-1/status.json").state, "diverged");
  const fs::path run = folder_ / "out/b/seed-1";
  ASSERT_TRUE(fs::exists(run / "summary.json")) << text("log.txt");
  EXPECT_EQ(output::read_summary(run / "summary.json").state, "finished");
  EXPECT_EQ(output::read_status(run / "status.json").state, "finished");

  EXPECT_EQ(batch(""), 8);
  EXPECT_NE(text("log.txt").find("outside/seed-1 failed before (--set carriers.list[0].position"), std::string::npos);
}

// Air so viscous that tau is 1.1 and the density differs: both are said at the end of a run, of the owner of the air
// and of those that ride on it.
TEST_F(BatchStudy, OfASharedFlowEachCaseWarnsAsAloneAndHasItsLog) {
  file("case.toml", one_carrier);
  const std::string cases =
      "base = \"case.toml\"\n[sweep]\nmethod = \"list\"\n[sweep.range]\n\"stop.time\" = [\"0.2 ms\", \"0.1 ms\"]\n"
      "\"carriers.two_way\" = [false, false]\n\"air.viscosity\" = [3e-3, 3e-3]\n\"air.density\" = [1.2, 1.2]\n";
  file("study.toml", "share = [\"one-way-flow\"]\n" + cases);
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  file("study.toml", cases);
  ASSERT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin batch study.toml --out alone > /dev/null 2> log.txt"), 0);
  for (const std::string run : {"towards-the-floor-1/seed-1", "towards-the-floor-2/seed-1"}) {
    SCOPED_TRACE(run);
    const output::Summary ours = output::read_summary(folder_ / "out" / run / "summary.json");
    EXPECT_EQ(ours.warnings, output::read_summary(folder_ / "alone" / run / "summary.json").warnings);
    ASSERT_EQ(ours.warnings.size(), 3U) << "of the time step, the density and tau";
    const std::string log = text("out/" + run + "/log.txt");
    for (const std::string& warning : ours.warnings) EXPECT_NE(log.find(warning), std::string::npos) << log;
  }
}

// No file may be larger than 8 kB: stats.h5 is, the study's own files are not.
TEST_F(BatchStudy, CasesOfASharedFlowThatCannotBeWrittenSayFailed) {
  file("case.toml", one_carrier);
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"one-way-flow\"]\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n");
  EXPECT_EQ(shell("bash -c \"trap '' XFSZ; ulimit -f 8; " + std::string(PUFFIN_BINARY_DIR) +
                  "/puffin batch study.toml --out out --jobs 1 --threads 1\" > /dev/null 2> log.txt"),
            8)
      << text("log.txt");
  const output::StudyResults results = output::read_study_results(folder_ / "out");
  ASSERT_EQ(results.cases.size(), 2U);
  for (const auto& c : results.cases) {
    EXPECT_EQ(c.runs[0].exit_code, 7) << c.runs[0].message;
    EXPECT_EQ(output::read_status(folder_ / "out" / c.name / "seed-1" / "status.json").state, "failed");
  }
}

}  // namespace
