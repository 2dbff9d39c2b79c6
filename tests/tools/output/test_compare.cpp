// Two runs side by side: what differs is named with its size and its place in time; times of the machine do not count.

#include <gtest/gtest.h>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/compare.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/summary.hpp"
#include "tools/output/tables.hpp"

namespace puffin::output {
namespace {

/// A run with one set of fines and ten rows of history every `step` s, FFE = 0.1 t / s + `more` from 0.5 s on.
void leave_run(const std::filesystem::path& folder, double FFE, double wall_clock, double step, double more) {
  std::filesystem::create_directories(folder);
  Summary s;
  s.name = "x";
  s.state = "finished";
  s.wall_clock = wall_clock;
  s.threads = static_cast<int>(wall_clock);
  s.steps = 1000;
  FinesSummary fines;
  fines.name = "drug";
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
  const auto all = compare_runs(folder / "a", folder / "b", {});
  EXPECT_GT(all.size(), 10U);
  for (const Difference& d : all) EXPECT_EQ(d.difference, 0.0) << d.name;
  EXPECT_EQ(named(all, "wall_clock"), nullptr);
  EXPECT_NE(comparison_text(all).find("0 outside"), std::string::npos);
}

TEST(Compare, ADifferenceIsNamedWithItsSizeAndItsMoment) {
  const Scratch folder;
  leave_run(folder / "a", 0.50, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.52, 1.0, 0.125, 0.25);
  const auto all = compare_runs(folder / "a", folder / "b", {});
  const Difference* fines = named(all, "fines.drug.FFE");
  ASSERT_NE(fines, nullptr);
  EXPECT_NEAR(fines->difference, 0.02, 1e-15);
  EXPECT_FALSE(fines->within());
  const Difference* history = named(all, "history.FFE");
  ASSERT_NE(history, nullptr);
  EXPECT_NEAR(history->difference, 0.25, 1e-15);
  EXPECT_GT(history->time.value(), 0.5);
  EXPECT_NE(comparison_text(all).find("OUTSIDE"), std::string::npos);
  EXPECT_NE(comparison_json(all).find("\"ok\": false"), std::string::npos);
}

TEST(Compare, TheLongestNameThatFitsGivesTheTolerance) {
  const Scratch folder;
  leave_run(folder / "a", 0.50, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.52, 1.0, 0.125, 0.0);
  const auto within = [&](const Tolerances& t) {
    return named(compare_runs(folder / "a", folder / "b", t), "fines.drug.FFE")->within();
  };
  EXPECT_TRUE(within({{0.0, 0.0}, {{"fines", {0.03, 0.0}}}, {}}));
  EXPECT_FALSE(within({{1.0, 0.0}, {{"fines", {0.03, 0.0}}, {"fines.drug.FFE", {0.01, 0.0}}}, {}}));
  EXPECT_TRUE(within({{0.0, 0.05}, {}, {}}));
  EXPECT_FALSE(within({{0.0, 0.0}, {{"fine", {1.0, 0.0}}}, {}})) << "part of a word is no name";
  EXPECT_EQ(named(compare_runs(folder / "a", folder / "b", {{}, {}, {"fines"}}), "fines.drug.FFE"), nullptr);
}

TEST(Compare, HistoriesOfOtherIntervalsAreComparedBetweenTheirRows) {
  const Scratch folder;
  leave_run(folder / "a", 0.5, 1.0, 0.125, 0.0);
  leave_run(folder / "b", 0.5, 1.0, 0.25, 0.0);
  // FFE is linear in time: linear interpolation gives it to rounding.
  EXPECT_LT(named(compare_runs(folder / "a", folder / "b", {}), "history.FFE")->difference, 1e-15);
}

TEST(Compare, AFolderWithoutARunIsAnOutputError) {
  const Scratch folder;
  leave_run(folder / "a", 0.5, 1.0, 0.125, 0.0);
  EXPECT_THROW(compare_runs(folder / "a", folder / "none", {}), OutputError);
}

}  // namespace
}  // namespace puffin::output
