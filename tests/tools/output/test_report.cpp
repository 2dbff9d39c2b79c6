#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "tests/tools/output/scratch.hpp"
#include "tests/tools/output/synthetic_run.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/report.hpp"
#include "tools/output/report/chart.hpp"
#include "tools/output/report/html.hpp"
#include "tools/output/tables.hpp"

namespace puffin::output {
namespace {

/// The whole run's report, made once: it paints 17 pictures.
const std::string& whole_report() {
  static const std::string text = [] {
    const Scratch folder;
    write_synthetic_run(folder / "run");
    return make_report(folder / "run");
  }();
  return text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::ptrdiff_t count(const std::string& text, const std::string& part) {
  std::ptrdiff_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Report, LoadsNothing) {
  const std::string& text = whole_report();
  EXPECT_FALSE(has(text, "http://"));
  EXPECT_FALSE(has(text, "https://"));
  EXPECT_FALSE(has(text, "<script"));
  EXPECT_FALSE(has(text, "<link"));
  EXPECT_FALSE(has(text, "@import"));
  EXPECT_EQ(count(text, "src=\""), count(text, "src=\"data:image/png;base64,"));
  EXPECT_EQ(count(text, "<img "),
            17);                       // device, four moments and the end, air, four moments of it twice, two wall maps
  EXPECT_EQ(count(text, "<svg "), 6);  // two emissions, outcome, flow, pressure, phases
}

TEST(Report, HoldsEverySectionAndNothingIsLeftOut) {
  for (const char* title :
       {"The device", "Carriers in flight", "Emission over time", "Where the fines ended", "Beside the given values",
        "Flow and pressure", "The air", "Collisions", "What landed on the walls", "Where the time went", "Numerics",
        "Assumptions", "To run this again"}) {
    EXPECT_TRUE(has(whole_report(), "<h2>" + std::string(title) + "</h2>")) << title;
  }
  EXPECT_FALSE(has(whole_report(), "Left out"));
}

TEST(Report, EveryTagThatIsOpenedIsClosed) {
  const std::string& text = whole_report();
  for (const std::string tag : {"table", "tr", "td", "th", "figure", "div", "svg", "ul", "li", "p", "h2", "text"}) {
    EXPECT_EQ(count(text, "<" + tag + ">") + count(text, "<" + tag + " "), count(text, "</" + tag + ">")) << tag;
  }
}

TEST(Report, AFlowOnlyRunSaysWhatIsLeftOutAndWhy) {
  const Scratch folder;
  write_synthetic_run(folder / "run", RunKind::flow_only);
  const std::string text = make_report(folder / "run");
  EXPECT_TRUE(has(text, "Left out: this run has no carriers."));
  EXPECT_TRUE(has(text, "total-to-static drop [Pa]"));
  EXPECT_EQ(count(text, "<img "), 10);  // device, air, its streamlines at four moments over all and at the pocket
}

TEST(Report, ADivergedRunSaysWhere) {
  const Scratch folder;
  write_synthetic_run(folder / "run", RunKind::diverged);
  const std::string text = make_report(folder / "run");
  EXPECT_TRUE(has(text, "This run diverged"));
  EXPECT_TRUE(has(text, "cell (88, 14, 9)"));
}

TEST(Report, WarningsStandBeforeTheResults) {
  const Scratch folder;
  Summary summary = synthetic_summary();
  summary.warnings = {"the inlet has 4.9 cells & more", "step 7: went on with half the time step"};
  summary.limited = 7593, summary.backflow = 18511;
  write_summary(folder / "summary.json", summary);
  const std::string text = make_report(folder.path());
  const std::size_t at = text.find("<div class=alarm><b>This run warns:");
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(at, text.find("<h2>"));
  EXPECT_TRUE(has(text, "<li>the inlet has 4.9 cells &amp; more</li>"));
  EXPECT_TRUE(has(text, "<li>step 7: went on with half the time step</li>"));
  EXPECT_TRUE(has(text, "7&#8239;593 ("));
  EXPECT_TRUE(has(text, "18&#8239;511 ("));
  EXPECT_FALSE(has(whole_report(), "This run warns"));
}

// 121 of 211 ms; a run that ends sooner since everything has left is whole.
TEST(Report, ATrialIsCalledOne) {
  const Scratch folder;
  Summary summary = synthetic_summary();
  summary.preset = "quick", summary.stop_time = summary.simulated_time = 0.121, summary.case_stop_time = 0.211;
  compare_with_reference(summary, {{"thesis.last_emitted", 0.21, {}, {}}});
  EXPECT_EQ(trial(summary), "preset quick, ended at 121 ms of 211 ms");
  write_summary(folder / "summary.json", summary);
  const std::string text = make_report(folder.path());
  EXPECT_TRUE(has(text, "<b>A trial:</b> preset quick, ended at 121 ms of 211 ms."));
  EXPECT_EQ(count(text, "(until the end of this run)"), 1);  // in the reference; no moments of carriers are stored
  summary.preset = "default", summary.simulated_time = 0.1;
  EXPECT_EQ(trial(summary), "");
  summary.preset = "";
  summary.simulated_time = summary.stop_time.emplace(0.211);
  EXPECT_EQ(trial(summary), "");
  EXPECT_FALSE(has(whole_report(), "A trial"));
}

TEST(Report, PicturesAndChartsHaveNames) {
  const std::string& text = whole_report();
  EXPECT_EQ(count(text, "role=\"img\" aria-label=\""), count(text, "<svg "));
  EXPECT_TRUE(has(text, "aria-label=\"pressure drop [Pa] over time [ms]: static, total to static\""));
  EXPECT_TRUE(has(text, "<img alt=\"Carriers in the device, coloured by speed, t = "));
  EXPECT_TRUE(has(text, "<img alt=\"Speed of the air on a plane, last stored moment. "));
}

// With a second scalar the numbers that are shown large say which one they are of.
TEST(Report, OfSeveralScalarsTheShownOneIsNamed) {
  const Scratch folder;
  Summary summary = synthetic_summary();
  summary.fines.push_back(summary.fines[0]);
  summary.fines[1].name = "slow";
  write_summary(folder / "summary.json", summary);
  const std::string of = " of L-Base, the first of 2 scalars", text = make_report(folder.path());
  EXPECT_TRUE(has(text, "fines emitted free (FFE)" + of));
  EXPECT_TRUE(has(text, "The fines" + of + ": FFE free"));
  EXPECT_FALSE(has(whole_report(), "scalars"));
}

// Carriers without air: no empty charts, and no lattice of size 0.
TEST(Report, ADryRunLeavesTheAirOut) {
  const Scratch folder;
  Summary summary = synthetic_summary();
  summary.pressure.reset(), summary.cells_fluid = summary.cells_active = 0;
  summary.dx = summary.tau_min = summary.mach_max = 0.0;
  write_summary(folder / "summary.json", summary);
  {
    CsvFile history(folder / "history.csv", history_columns());
    HistoryRow row;
    row.carriers_in = 3;
    append(history, row), row.time = 0.1, append(history, row);
    history.flush();
  }
  const std::string text = make_report(folder.path());
  EXPECT_FALSE(has(text, "flow rate [L/min]"));
  EXPECT_FALSE(has(text, "relaxation time tau"));
  EXPECT_TRUE(has(text, "Left out: no flow through an opening"));
  EXPECT_TRUE(has(text, "Left out: cell size"));
}

TEST(Report, ABareSummaryIsEnough) {
  const Scratch folder;
  Summary summary;
  summary.name = "a <b> & \"c\"";
  summary.state = "stopped";
  write_summary(folder / "summary.json", summary);
  const std::string text = make_report(folder.path());
  EXPECT_TRUE(has(text, "a &lt;b&gt; &amp; &quot;c&quot;"));
  EXPECT_FALSE(has(text, "<b> &"));
  EXPECT_EQ(count(text, "<img "), 0);
}

// The folder of a run that was got from elsewhere.
TEST(Report, PicturesAreNotKeptBehindALinkOutOfTheRun) {
  const Scratch folder;
  write_synthetic_run(folder / "run");
  std::filesystem::create_directory(folder / "mine");
  std::filesystem::create_directory_symlink(folder / "mine", folder / "run" / "images");
  EXPECT_TRUE(has(make_report(folder / "run"), "leads it out of the folder"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "mine"));
}

TEST(Report, AFolderWithoutASummaryIsAnOutputError) {
  const Scratch folder;
  EXPECT_THROW(make_report(folder.path()), OutputError);
}

TEST(Html, Base64OfTheStandardsExamples) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Html, NumbersKeepTheirSignificantDigits) {
  EXPECT_EQ(significant(2612.4, 3), "2612");  // whole numbers below a million stay plain
  EXPECT_EQ(significant(0.064, 3), "0.0640");
  EXPECT_EQ(significant(9.996, 3), "10.0");
  EXPECT_EQ(significant(5.5e-10, 2), "5.5&nbsp;&times;&nbsp;10<sup>-10</sup>");
  EXPECT_EQ(significant(-1.0, 3), "-1.00");
  EXPECT_EQ(grouped(213576), "213&#8239;576");
  EXPECT_EQ(grouped(-1000), "&minus;1&#8239;000");
  EXPECT_EQ(grouped(12), "12");
}

TEST(Chart, APeakSurvivesTheThinning) {
  LineChart chart;
  Curve curve{"x", {}, {}};
  for (int i = 0; i < 100000; ++i) curve.x.push_back(i), curve.y.push_back(i == 54321 ? 8.0 : 1.0);
  chart.curves = {curve};
  const std::string svg = line_chart(chart);
  EXPECT_LT(svg.size(), 30000u);
  const std::size_t points = svg.find("points=\"");
  // The axis ends at 8 exactly, so the peak touches the upper edge of the plot.
  const std::regex edge(",46\\.0 ");
  EXPECT_TRUE(std::regex_search(svg.substr(points), edge));
}

/// Right ends of the legend's names, at 7 pixel a letter (the mean of letters of 13), and their lowest line.
std::pair<double, double> legend_reach(const std::string& svg) {
  double right = 0.0, lowest = 0.0;
  const std::regex entry("rx=\"2\" fill=\"[^\"]*\"/><text x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>([^<]*)</text>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), entry), end; it != end; ++it) {
    right = std::max(right, std::stod((*it)[1]) + 7.0 * static_cast<double>((*it)[3].length()));
    lowest = std::max(lowest, std::stod((*it)[2]));
  }
  return {right, lowest};
}

// The legend of a study's seven cases: all of it inside the picture of 760, and above the plot.
TEST(Chart, ALongLegendTakesMoreRowsAboveThePlot) {
  LineChart chart;
  BarChart bars;
  bars.groups.push_back({"FFE", {}});
  for (int n = 0; n < 7; ++n) {
    const std::string name = "A case with a rather long name " + std::to_string(n);
    chart.curves.push_back({name, {0, 1}, {0, 1}});
    bars.groups[0].bars.push_back({name, 0.5, {}, {}});
  }
  const std::string lines = line_chart(chart), lying = bar_chart(bars);
  const auto [right, lowest] = legend_reach(lines);
  EXPECT_LE(right, 760 - 22);
  EXPECT_LE(legend_reach(lying).first, 760 - 22);
  std::smatch top;  // the uppermost line of the grid; the axis ends at 1, where the curves do
  ASSERT_TRUE(std::regex_search(lines, top, std::regex("points=\"[0-9.]+,[0-9.]+ [0-9.]+,([0-9.]+) ")));
  EXPECT_GT(lowest, 21.0);
  EXPECT_GT(std::stod(top[1]), lowest + 15);
  chart.curves.resize(1);
  EXPECT_TRUE(has(line_chart(chart), "viewBox=\"0 0 760.0 330.0\""));
  chart.curves[0].name = std::string(200, 'n');
  EXPECT_TRUE(has(line_chart(chart), "textLength=\"640.0\""));
}

TEST(Chart, NoPointsOrStrangeOnesStillGiveAChart) {
  LineChart chart;
  chart.curves = {{"none", {}, {}}, {"nan", {0, 1}, {std::nan(""), std::nan("")}}};
  EXPECT_TRUE(has(line_chart(chart), "</svg>"));
  EXPECT_FALSE(has(line_chart(chart), "nan,"));
  EXPECT_TRUE(has(bar_chart({}), "</svg>"));
}

}  // namespace
}  // namespace puffin::output
