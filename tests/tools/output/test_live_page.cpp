#include <gtest/gtest.h>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/report/live_page.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

std::string page_in(const std::string& state) {
  Status s;
  s.name = "a & b";
  s.state = state;
  s.phase = "flight";
  s.simulated_time = 0.05, s.end_time = 0.2, s.eta = 30.0;
  HistoryRow one, two;
  one.carriers_in = 10, two.time = 0.05, two.carriers_in = 7, two.carriers_emitted = 3;
  return live_page(s, {one, two});
}

TEST(LivePage, RefreshesItselfWhileTheRunGoesOnAndThenLeadsToTheReport) {
  const std::string running = page_in("running"), finished = page_in("finished");
  EXPECT_NE(running.find("http-equiv=\"refresh\""), std::string::npos);
  EXPECT_EQ(running.find("report.html"), std::string::npos);
  EXPECT_EQ(finished.find("http-equiv=\"refresh\""), std::string::npos);
  EXPECT_NE(finished.find("href=\"report.html\""), std::string::npos);
}

TEST(LivePage, ShowsHowFarItIsAndLoadsNothing) {
  const std::string page = page_in("running");
  EXPECT_NE(page.find("<progress max=\"1\" value=\"0.2500\""), std::string::npos)
      << page.substr(0, 4000);  // 50 of 200 ms
  EXPECT_NE(page.find("a &amp; b"), std::string::npos);
  EXPECT_NE(page.find("30 s"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST(LivePage, ABarIsAPlainNumberHoweverLittleIsDone) {
  EXPECT_EQ(progress_bar(1e-6), "<progress max=\"1\" value=\"0.0000\"></progress>");
  EXPECT_EQ(progress_bar(7e-4, "class=\"b\""), "<progress max=\"1\" value=\"0.0007\" class=\"b\"></progress>");
  EXPECT_EQ(progress_bar(1.5), "<progress max=\"1\" value=\"1.0000\"></progress>");
}

TEST(SummaryTable, HoldsEveryNumberUnderItsPath) {
  const Scratch folder;
  Summary s;
  s.name = "x";
  s.dx = 2.5e-4;
  s.carriers.emplace();
  s.carriers->RDF = 0.125;
  s.fines = {{"drug", 0.5, 0.1, 0.1, 0.3, 0.0, 0.0, {}}};
  s.skipped = {{"sleep, deep", 3, 1.5}};
  write_summary(folder / "summary.json", s);
  write_summary_table(folder.path());
  const CsvTable t = read_csv(folder / "summary.csv");
  const auto value = [&](const std::string& quantity) -> std::string {
    for (const auto& row : t.rows)
      if (row[0] == quantity) return row[1];
    return "missing";
  };
  EXPECT_EQ(value("name"), "x");
  EXPECT_EQ(value("dx"), "0.00025");
  EXPECT_EQ(value("carriers.RDF"), "0.125");
  EXPECT_EQ(value("fines.drug.FFE"), "0.5");
  EXPECT_EQ(value("skipped.sleep, deep.seconds_saved"), "1.5");
}

}  // namespace
}  // namespace puffin::output
