// Whole runs of the program: the ledger closes, the answer does not depend on the threads, failures say where.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sanitized.hpp"
#include "tests/tools/run/small_dose.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/events_file.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/vtk_series.hpp"

namespace {

using namespace puffin;

class Run : public SmallDose {};

// The ledger: every event books what it takes to one rounding, sums are compensated: 1e-10 of the dose leaves four
// orders of room. FFE + FFW + FFCR + FFCE + in_air = 1 + that error.
TEST_F(Run, TheLedgerClosesAtEveryOutputAndThreadsDoNotChangeTheAnswer) {
  std::ofstream(folder_ / "case.toml") << coarse_dose();
  ASSERT_EQ(run("two", "--threads 2 --no-report --set output.statistics=0.25e-3"), 0) << text("two.log");
  ASSERT_EQ(run("one", "--threads 1 --set output.statistics=0.25e-3"), 0) << text("one.log");
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

// Without air and fines: of 8 parts of mass that fly out and one that stays, RDF is 1/9. Exact but for rounding.
TEST_F(Run, RetainedMassCountsUnlikeCarriersWithTheirOwn) {
  std::ofstream(folder_ / "case.toml") << R"toml(
schema = 1
name = "two"
geometry = { generator = "duct", duct = { length = "10 mm", width = "4 mm", height = "4 mm" } }
air = { model = "none" }
[carriers]
list = [ { position = [5e-3, 1e-3, 2e-3], velocity = [4.0, 0.0, 0.0], diameter = 1e-4, density = 1520 },
         { position = [5e-3, 3e-3, 2e-3], velocity = [0.0, 0.0, 0.0], diameter = 5e-5, density = 1520 } ]
gravity = [0.0, 0.0, 0.0]
[stop]
time = "2 ms"
)toml";
  ASSERT_EQ(run("out", "--no-report"), 0) << text("out.log");
  const output::Summary s = output::read_summary(folder_ / "out" / "summary.json");
  ASSERT_TRUE(s.carriers && s.carriers->RDF);
  EXPECT_EQ(s.carriers->emitted, 1);
  EXPECT_NEAR(*s.carriers->RDF, 1.0 / 9.0, 1e-12);
}

TEST_F(Run, ARunThatDivergesEndsWith5AndSaysWhere) {
  // A reference speed of an eightieth of the inlet's: 8 in lattice units, and 1 after three retreats.
  EXPECT_EQ(run("bad", "--set numerics.reference_speed=\"0.8 m/s\""), 5);
  const output::Summary s = output::read_summary(folder_ / "bad" / "summary.json");
  EXPECT_EQ(s.state, "diverged");
  EXPECT_NE(s.message.find("the first at ["), std::string::npos) << s.message;
  const auto of_retreat = [](const std::string& w) { return w.starts_with("retreat "); };
  EXPECT_EQ(std::count_if(s.warnings.begin(), s.warnings.end(), of_retreat), 3) << "behind those of the case";
  EXPECT_TRUE(s.warnings.back().starts_with("retreat 3 of 3")) << s.warnings.back();
  EXPECT_NE(text("bad/log.txt").find("retreat 1 of 3"), std::string::npos);
  EXPECT_FALSE(output::list_checkpoints(folder_ / "bad").empty()) << "the last good state is kept";
}

// 0.5 in lattice units diverges, an eighth of that step does not.
TEST_F(Run, ARetreatWithASmallerStepSavesARun) {
  // On the coarser cells of a sanitized build 12.5 m/s diverge before the first row of history.csv.
  const std::string speed = sanitized ? "9 m/s" : "12.5 m/s";
  ASSERT_EQ(run("saved", "--set numerics.reference_speed=\"" + speed + "\" --until 6ms"), 0) << text("saved.log");
  const output::Summary s = output::read_summary(folder_ / "saved" / "summary.json");
  EXPECT_EQ(s.state, "finished");
  EXPECT_TRUE(std::any_of(s.warnings.begin(), s.warnings.end(),
                          [](const std::string& w) { return w.starts_with("retreat "); }));
  EXPECT_LT(s.dt_min, 0.51 * s.dt_max);
  const auto saved = output::read_csv(folder_ / "saved" / "history.csv");
  const std::vector<double> times = saved.numbers("time");
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(std::adjacent_find(times.begin(), times.end()), times.end()) << "a retreat must not leave rows twice";
  for (const double error : saved.numbers("ledger_error")) EXPECT_LT(std::abs(error), 1e-10);
}

TEST_F(Run, UntilStopsEarlierAndChangesNothingElse) {
  ASSERT_EQ(run("short", "--until 0.05ms"), 0) << text("short.log");
  ASSERT_EQ(run("long", "--until 0.2ms"), 0) << text("long.log");
  // The reference speed, and so the step, is that of the whole case.
  EXPECT_EQ(output::read_csv(folder_ / "short" / "history.csv").numbers("dt").front(),
            output::read_csv(folder_ / "long" / "history.csv").numbers("dt").front());
  const output::Summary summary = output::read_summary(folder_ / "short" / "summary.json");
  EXPECT_DOUBLE_EQ(summary.stop_time.value(), 0.05e-3);
  EXPECT_DOUBLE_EQ(summary.case_stop_time.value(), 0.01);
  EXPECT_TRUE(output::cut_short(summary));
  // The run's own file is that of the whole case too, and its page says where it was ended.
  EXPECT_NE(text("short/report.html").find("--until 5e-05s"), std::string::npos);
  EXPECT_EQ(text("short/case.toml"), text("long/case.toml"));
}

// As `puffin check`: on cells of 0.5 mm the inlet has too few of them for its jet.
TEST_F(Run, WhatTheCheckWarnsOfIsInTheLogAndTheSummaryOnce) {
  ASSERT_EQ(run("out", "--until 0.05ms --no-report"), 0) << text("out.log");
  const std::vector<std::string> told = output::read_summary(folder_ / "out" / "summary.json").warnings;
  const auto of_inlet = [](const std::string& w) { return w.starts_with("the inlet \"inlet\" has"); };
  EXPECT_EQ(std::count_if(told.begin(), told.end(), of_inlet), 1);
  for (const std::string& one : told) {
    EXPECT_EQ(std::count(told.begin(), told.end(), one), 1) << one;
    EXPECT_NE(text("out/log.txt").find(one), std::string::npos) << one;
  }
}

TEST_F(Run, ThePresetAndTheCasesOwnEndAreInTheSummary) {
  ASSERT_EQ(run("out", "--preset quick --set stop.time='200 ms' --until 0.05ms --no-report"), 0) << text("out.log");
  const output::Summary summary = output::read_summary(folder_ / "out" / "summary.json");
  EXPECT_EQ(summary.preset, "quick");
  EXPECT_DOUBLE_EQ(summary.case_stop_time.value(), 0.2);
}

// One of two equal carriers without fines flies out of a duct, the other stays: half of the dose.
TEST_F(Run, TheRetainedDoseIsKnownWithoutFines) {
  std::ofstream(folder_ / "case.toml") << R"toml(
schema = 1
name = "dry"
[geometry]
generator = "duct"
[air]
model = "none"
[numerics]
dx = "1 mm"
[carriers]
diameter = "70 um"
density = "1520 kg/m^3"
gravity = [0.0, 0.0, 0.0]
list = [ { position = [0.049, 0.003, 0.002], velocity = [9, 0, 0] }, { position = [0.02, 0.003, 0.002], velocity = [0, 0, 0] } ]
[stop]
time = "0.5 ms"
)toml";
  ASSERT_EQ(run("dry", "--no-report"), 0) << text("dry.log");
  EXPECT_EQ(output::read_summary(folder_ / "dry" / "summary.json").carriers->RDF, 0.5);
  EXPECT_NE(text("dry.log").find("of 0.5 ms"), std::string::npos) << text("dry.log");
  const std::string eta = "\"eta\": ", status = text("dry/status.json");
  EXPECT_EQ(std::stod(status.substr(status.find(eta) + eta.size())), 0.0) << "it is over";
  EXPECT_EQ(output::read_status(folder_ / "dry" / "status.json").wall_clock,
            output::read_summary(folder_ / "dry" / "summary.json").wall_clock);
}

TEST_F(Run, AFinishedRunIsNotOverwritten) {
  ASSERT_EQ(run("once", "--until 0.2ms"), 0) << text("once.log");
  EXPECT_EQ(run("once", "--until 0.2ms"), 7);
}

}  // namespace
