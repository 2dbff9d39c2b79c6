// Two runs side by side: what differs is named with its size and its place in time; times of the machine do not count.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/compare.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/tables.hpp"

namespace puffin::output {
namespace {

/// A run with one set of fines and ten rows of history every `step` s, FFE = 0.1 t / s + `more` from 0.5 s on.
void leave_run(const std::filesystem::path& folder, double FFE, double wall_clock, double step, double more,
               const std::string& drug = "drug", const std::string& state = "finished") {
  std::filesystem::create_directories(folder);
  Summary s;
  s.name = "x";
  s.state = state;
  s.simulated_time = state == "finished" ? 1.0 : 0.5;
  s.wall_clock = wall_clock;
  s.threads = static_cast<int>(wall_clock);
  s.steps = 1000;
  FinesSummary fines;
  fines.name = drug;
  fines.FFE = FFE;
  s.fines.push_back(fines);
  write_summary(folder / "summary.json", s);
  CsvFile csv(folder / "history.csv", history_columns());
  for (double t = 0.0; t < 1.0 + 0.5 * step; t += step) {
    HistoryRow row;
    row.time = t;
    row.FFE = 0.1 * t + (t > 0.5 ? more : 0.0);
    append(csv, row);
  }
}

const Difference* named(const std::vector<Difference>& all, const std::string& name) {
  for (const Difference& d : all)
    if (d.name == name) return &d;
  return nullptr;
}

TEST(Compare, EqualRunsAreEqualHoweverLongTheyTook) {
  const Scratch folder;
  leave_run(folder / "a", 0.5, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.5, 9.0, 0.125, 0.0);
  const Comparison both = compare_runs(folder / "a", folder / "b", {});
  const auto& all = both.differences;
  EXPECT_GT(all.size(), 10U);
  for (const Difference& d : all) EXPECT_EQ(d.difference, 0.0) << d.name;
  EXPECT_EQ(named(all, "wall_clock"), nullptr);
  EXPECT_NE(comparison_text(both).find("0 outside"), std::string::npos);
}

// What a ledger is off by is rounding: 1e-12 of the dose is what it keeps, and any other bit changes it.
TEST(Compare, LedgersDifferByWhatTheyKeep) {
  const Scratch folder;
  leave_run(folder / "a", 0.5, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.5, 1.0, 0.125, 0.0);
  const auto off_by = [&](double error, const Tolerances& tolerances = {}) {
    Summary s;
    s.name = "x", s.state = "finished", s.simulated_time = 1.0;
    FinesSummary fines;
    fines.name = "drug", fines.ledger_error = error;
    s.fines.push_back(fines);
    write_summary(folder / "b" / "summary.json", s);
    const auto all = compare_runs(folder / "a", folder / "b", tolerances).differences;
    return named(all, "fines.drug.ledger_error")->within();
  };
  EXPECT_TRUE(off_by(3e-17));
  EXPECT_TRUE(off_by(3e-17, {{}, {{"fines", {0.0, 0.5}}}, {}})) << "a group knows nothing of ledgers";
  EXPECT_FALSE(off_by(3e-17, {{}, {{"fines.drug.ledger_error", {0.0, 0.5}}}, {}}));
  EXPECT_TRUE(off_by(-0.9e-12));
  EXPECT_FALSE(off_by(1.1e-12));
}

// reference.FFE.ours is FFE once more, and would be judged without FFE's tolerance.
TEST(Compare, WhatTheReferenceRepeatsIsJudgedUnderItsOwnNameAlone) {
  const Scratch folder;
  for (const auto& [run, ours] : {std::pair("a", 0.50), std::pair("b", 0.51)}) {
    leave_run(folder / run, ours, 1.0, 0.125, 0.0);
    Summary s = read_summary(folder / run / "summary.json");
    s.reference.push_back({"FFE", 0.4, {}, {}, ours, ours - 0.4});
    write_summary(folder / run / "summary.json", s);
  }
  const auto all = [&](const Tolerances& t) { return compare_runs(folder / "a", folder / "b", t).differences; };
  const auto free = all({{}, {{"fines", {0.03, 0.0}}}, {}});
  EXPECT_TRUE(std::all_of(free.begin(), free.end(), [](const Difference& d) { return d.within(); }));
  const auto strict = all({{}, {{"fines", {0.03, 0.0}}, {"reference.FFE.ours", {0.001, 0.0}}}, {}});
  EXPECT_FALSE(std::all_of(strict.begin(), strict.end(), [](const Difference& d) { return d.within(); }));
}

// A run again by the file of a preset's run, and a summary of before there was a flow rate: nothing of the results
// differs.
TEST(Compare, HowARunWasAskedForIsNoResult) {
  const Scratch folder;
  for (const auto& [run, whole] : {std::pair("a", 0.211), std::pair("b", 0.121)}) {
    leave_run(folder / run, 0.5, 1.0, 0.125, 0.0);
    Summary s = read_summary(folder / run / "summary.json");
    s.stop_time = 0.121, s.case_stop_time = whole;
    s.pressure.emplace();
    s.pressure->static_drop.mean = 5.0;
    if (whole > 0.2) s.pressure->flow_rate.mean = 1e-4;
    write_summary(folder / run / "summary.json", s);
  }
  for (const auto& [one, other] : {std::pair("a", "b"), std::pair("b", "a")}) {
    const auto all = compare_runs(folder / one, folder / other, {}).differences;
    EXPECT_TRUE(std::all_of(all.begin(), all.end(), [](const Difference& d) { return d.within(); }));
    EXPECT_NE(named(all, "pressure.static_drop.mean"), nullptr);
  }
}

TEST(Compare, ADifferenceIsNamedWithItsSizeAndItsMoment) {
  const Scratch folder;
  leave_run(folder / "a", 0.50, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.52, 1.0, 0.125, 0.25);
  const Comparison both = compare_runs(folder / "a", folder / "b", {});
  const auto& all = both.differences;
  const Difference* fines = named(all, "fines.drug.FFE");
  ASSERT_NE(fines, nullptr);
  EXPECT_NEAR(fines->difference, 0.02, 1e-15);
  EXPECT_FALSE(fines->within());
  const Difference* history = named(all, "history.FFE");
  ASSERT_NE(history, nullptr);
  EXPECT_NEAR(history->difference, 0.25, 1e-15);
  EXPECT_GT(history->time.value(), 0.5);
  EXPECT_NE(comparison_text(both).find("OUTSIDE"), std::string::npos);
  EXPECT_NE(comparison_json(both).find("\"ok\": false"), std::string::npos);
}

TEST(Compare, TheLongestNameThatFitsGivesTheTolerance) {
  const Scratch folder;
  leave_run(folder / "a", 0.50, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.52, 1.0, 0.125, 0.0);
  const auto within = [&](const Tolerances& t) {
    return named(compare_runs(folder / "a", folder / "b", t).differences, "fines.drug.FFE")->within();
  };
  EXPECT_TRUE(within({{0.0, 0.0}, {{"fines", {0.03, 0.0}}}, {}}));
  EXPECT_FALSE(within({{1.0, 0.0}, {{"fines", {0.03, 0.0}}, {"fines.drug.FFE", {0.01, 0.0}}}, {}}));
  EXPECT_TRUE(within({{0.0, 0.05}, {}, {}}));
  EXPECT_FALSE(within({{0.0, 0.0}, {{"fine", {1.0, 0.0}}}, {}})) << "part of a word is no name";
  EXPECT_EQ(named(compare_runs(folder / "a", folder / "b", {{}, {}, {"fines"}}).differences, "fines.drug.FFE"),
            nullptr);
}

TEST(Compare, HistoriesOfOtherIntervalsAreComparedBetweenTheirRows) {
  const Scratch folder;
  leave_run(folder / "a", 0.5, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.5, 1.0, 0.25, 0.0);
  // FFE is linear in time: linear interpolation gives it to rounding.
  EXPECT_LT(named(compare_runs(folder / "a", folder / "b", {}).differences, "history.FFE")->difference, 1e-15);
}

TEST(Compare, RunsOfOtherNamesAndLengthsAreToldAndTheirOnlyFinesCompared) {
  const Scratch folder;
  leave_run(folder / "a", 0.5, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.5, 1.0, 0.125, 0.0, "other", "diverged");
  const Comparison both = compare_runs(folder / "a", folder / "b", {{0.0, 1e-9}, {{"fines.durg", {1.0, 0.0}}}, {}});
  EXPECT_EQ(named(both.differences, "fines.drug.FFE")->difference, 0.0);
  EXPECT_EQ(named(both.differences, "fines.other.FFE"), nullptr);
  EXPECT_FALSE(named(both.differences, "state")->within()) << "equal numbers of a run that diverged are no agreement";
  ASSERT_EQ(both.notes.size(), 2U);
  EXPECT_NE(both.notes[0].find("\"other\" of B"), std::string::npos);
  EXPECT_NE(both.notes[1].find("0.5 s, where B ends"), std::string::npos);
  EXPECT_EQ(both.unused, std::vector<std::string>{"fines.durg"});
  EXPECT_NE(comparison_text(both).find("diverged at 0.5 s"), std::string::npos);
}

TEST(Compare, AFolderWithoutARunIsAnOutputError) {
  const Scratch folder;
  leave_run(folder / "a", 0.5, 1.0, 0.125, 0.0);
  EXPECT_THROW(compare_runs(folder / "a", folder / "none", {}), OutputError);
}

}  // namespace
}  // namespace puffin::output
