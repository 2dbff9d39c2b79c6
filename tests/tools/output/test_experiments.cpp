#include <gtest/gtest.h>

#include <cmath>

#include <fstream>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/experiments.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/report.hpp"
#include "tools/output/study_results.hpp"

namespace puffin::output {
namespace {

/// The table that ships with the twelve cases.
std::vector<Measurement> shipped() {
  return read_experiments(std::filesystem::path(PUFFIN_SOURCE_DIR) / "cases/study/experiments.csv");
}

// Tables 4.7 to 4.9 of the thesis, printed to 0.1 mg and 0.01, from its tables B.1 and B.2, which are rounded by `half`
// (half a digit): that moves a deviation of n values by up to half sqrt(n/(n - 1)) <= 1.23 half for three, and the mean
// by half.
TEST(Experiments, GiveTheMeansOfTheThesis) {
  const auto all = shipped();
  const auto near = [&](const char* device, const char* copy, const char* quantity, double half, double mean,
                        double relative) {
    const Spread s = spread_of(all, device, copy, quantity);
    EXPECT_NEAR(s.mean, mean, 2 * half) << device << copy << quantity;
    EXPECT_NEAR(s.relative_deviation().value(), relative, 0.005 + 1.23 * half / mean) << device << copy << quantity;
  };
  near("L-bend", "L1", "dose_mg", 0.05, 8.1, 0.39);
  near("L-bend", "L2", "FFE", 0.005, 0.43, 0.48);
  near("L-bend", "L3", "RDF", 0.005, 0.21, 0.27);
  near("Omega-bend", "O1", "FFE", 0.005, 0.41, 0.20);
  near("Omega-bend", "O2", "RDF", 0.005, 0.19, 0.70);
  near("L-bend", "", "FFE", 0.005, 0.41, 0.32);
  near("omega-bend", "", "FFE", 0.005, 0.38, 0.22);
  near("l-bend", "", "MMAD_um", 0.005, 1.87, 0.04);
  EXPECT_EQ(spread_of(all, "L-bend", "", "FFE").tests, 9);
  EXPECT_EQ(spread_of(all, "L-bend", "", "pressure_drop_kPa").tests, 6);  // three were not measured
  EXPECT_EQ(spread_of(all, "L-bend", "", "FFE").low, 0.23);
  EXPECT_EQ(spread_of(all, "L-bend", "", "FFE").high, 0.64);
}

TEST(Experiments, ATextWhereANumberBelongsIsAnErrorWithItsLine) {
  const Scratch folder;
  std::ofstream(folder / "a.csv") << "device,FFE\nL-bend,0.4\nL-bend,much\n";
  try {
    read_experiments(folder / "a.csv");
    FAIL();
  } catch (const OutputError& e) {
    EXPECT_NE(std::string(e.what()).find("a.csv:3: 'much'"), std::string::npos) << e.what();
  }
  std::ofstream(folder / "b.csv") << "apparatus,FFE\nL-bend,0.4\n";
  EXPECT_THROW(read_experiments(folder / "b.csv"), OutputError);
}

TEST(Experiments, AShortRowLeavesItsLastColumnsEmpty) {
  const Scratch folder;
  std::ofstream(folder / "a.csv") << "device,copy,test,FFE,RDF\nL-bend,L1,1,0.5\nL-bend\n";
  const auto all = read_experiments(folder / "a.csv");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].quantity, "FFE");
  EXPECT_EQ(all[0].value, 0.5);
}

void write_run(const Scratch& folder, const std::string& name, const Summary& s) {
  std::filesystem::create_directories(folder / name);
  write_summary(folder / name / "summary.json", s);
}

/// study.json of cases whose jobs are all done.
void write_plan(const Scratch& folder, const std::string& cases, const std::vector<std::string>& jobs) {
  std::string list;
  for (const std::string& job : jobs)
    list += (list.empty() ? "" : ", ") + (R"({"id": ")" + job + R"(", "state": "done"})");
  write_whole(folder / "study.json", R"({"study": "s.toml", "cases": [)" + cases + R"(], "jobs": [)" + list + "]}");
}

/// A study with one finished run whose FFE is 0.5 and whose pressure drop is 3000 Pa.
void write_study(const Scratch& folder) {
  Summary s;
  s.name = "A";
  s.state = "finished";
  s.fines = {{"A", 0.5, 0.1, 0.1, 0.3, 0.0, 0.0, {}}};
  s.pressure.emplace();
  s.pressure->total_to_static_drop.mean = 3000.0;
  s.pressure->flow_rate.mean = 6e-4;
  s.assumptions = {"the air is dry"};
  s.phases = {{"air", 7.0}};
  s.skipped = {{"exchanges", 3, 1.5}};
  std::filesystem::create_directories(folder / "A/seed-1");
  write_summary(folder / "A/seed-1/summary.json", s);
  write_whole(folder / "study.json",
              R"({"study": "s.toml", "cases": [{"name": "A", "device": "l-bend", "set": {}, "reference":
              {"thesis.FFE": 0.67}, "runs": [{"job": "A/seed-1", "scalar": ""}]}],
              "jobs": [{"id": "A/seed-1", "state": "done", "exit_code": 0, "message": ""}]})");
  write_whole(folder / "experiments.csv",
              "device,copy,test,FFE,pressure_drop_kPa\nL-bend,L1,1,0.4,3.5\nL-bend,L1,2,0.6,\nL-bend,L2,3,0.5,3.7\n");
}

TEST(Comparison, StandsBesideTheExperimentsInTheirUnits) {
  const Scratch folder;
  write_study(folder);
  write_study_tables(read_study_results(folder.path()), folder.path());
  const CsvTable t = read_csv(folder / "comparison.csv");
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(t.numbers("simulation"), (std::vector<double>{0.5, 3.0}));  // 3000 Pa in kPa
  EXPECT_EQ(t.numbers("thesis")[0], 0.67);
  EXPECT_NEAR(t.numbers("experiment")[0], 0.5, 1e-15);
  EXPECT_NEAR(t.numbers("standard_deviation")[0], 0.1, 1e-15);
  EXPECT_EQ(t.numbers("tests"), (std::vector<double>{3.0, 2.0}));
  EXPECT_TRUE(std::isnan(t.numbers("flow_rate")[0])) << "FFE is of no flow rate";
  EXPECT_EQ(t.numbers("flow_rate")[1], 6e-4);
  const std::string page = make_study_report(folder.path());
  EXPECT_NE(page.find("<th>at a flow rate of [L/min]</th>"), std::string::npos);
  EXPECT_NE(page.find("<td>36.0</td>"), std::string::npos);
}

TEST(Experiments, ADeviceUnderTwoSpellingsIsOne) {
  const std::vector<Measurement> all{{"duct", "1", "1", "FFE", 0.5}, {"Duct", "1", "2", "FFE", 0.4}};
  EXPECT_EQ(names_of(all, &Measurement::device), std::vector<std::string>{"duct"});
  const Scratch folder;
  write_experiments_summary(all, folder.path());
  EXPECT_EQ(read_csv(folder / "experiments-summary.csv").numbers("tests"), (std::vector<double>{2.0, 2.0}));
}

TEST(Experiments, OneTestHasNoDeviation) {
  const std::vector<Measurement> all{{"L-bend", "1", "1", "FFE", 0.5}, {"L-bend", "2", "1", "FFE", 0.4}};
  EXPECT_FALSE(spread_of(all, "L-bend", "1", "FFE").deviation);
  EXPECT_NEAR(spread_of(all, "L-bend", "", "FFE").deviation.value(), 0.1 / std::sqrt(2.0), 1e-15);
  const Scratch folder;
  write_experiments_summary(all, folder.path());
  const CsvTable table = read_csv(folder / "experiments-summary.csv");
  EXPECT_EQ(table.rows[0][table.find("standard_deviation")], "");
}

TEST(StudyReport, HoldsExperimentsAssumptionsPhasesAndSkips) {
  const Scratch folder;
  write_study(folder);
  const std::string page = make_study_report(folder.path());
  for (const char* part : {"L-bend: simulation, thesis and experiment", "0.500 &plusmn; 0.10", "pressure drop [kPa]",
                           "the air is dry", "What was skipped", "exchanges", "L2"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("http://"), std::string::npos);
}

// Flow alone, three times: the seed acts on nothing, and +-0 would be a lie.
TEST(StudyReport, EqualReplicatesHaveTheIntervalOfTheRun) {
  const Scratch folder;
  Summary s;
  s.state = "finished", s.steps = 7;
  s.pressure.emplace();
  s.pressure->static_drop = {100.0, 90.0, 110.0, 20};
  const std::vector<std::string> names{"A/seed-1", "A/seed-2", "A/seed-3"};
  for (const std::string& name : names) write_run(folder, name, s);
  write_plan(folder, R"({"name": "A", "runs": [{"job": "A/seed-1"}, {"job": "A/seed-2"}, {"job": "A/seed-3"}]})",
             names);
  const StudyResults results = read_study_results(folder.path());
  const Estimate& drop = *results.cases[0].find("static_drop");
  EXPECT_EQ(drop.ci_low, 90.0);
  EXPECT_EQ(drop.ci_high, 110.0);
  EXPECT_EQ(drop.interval, "batches");
  EXPECT_EQ(results.cases[0].find("steps")->interval, "");
  write_study_tables(results, folder.path());
  const CsvTable t = read_csv(folder / "results.csv");
  for (const auto& row : t.rows)
    EXPECT_EQ(row[t.find("interval")], row[t.find("quantity")] == "static_drop" ? "batches" : "") << row[1];
  const std::string page = make_study_report(folder.path());
  EXPECT_NE(page.find("100 &plusmn; 10 <span class=soft>(over time)</span>"), std::string::npos);

  s.pressure->static_drop = {106.0, 96.0, 116.0, 20};
  write_run(folder, "A/seed-3", s);
  EXPECT_EQ(read_study_results(folder.path()).cases[0].find("static_drop")->interval, "replicates");
}

// Somebody's own device: what its case gives in [reference] itself is of no thesis.
TEST(StudyReport, PlainlyGivenValuesAreAReference) {
  const Scratch folder;
  write_study(folder);
  std::string plan = read_whole(folder / "study.json");
  plan.replace(plan.find("thesis.FFE"), 10, "FFE");
  write_whole(folder / "study.json", plan);
  const StudyResults results = read_study_results(folder.path());
  write_study_tables(results, folder.path());
  for (const char* name : {"comparison.csv", "results.csv"}) {
    const CsvTable t = read_csv(folder / name);
    EXPECT_TRUE(std::isnan(t.numbers("thesis")[0])) << name;
    EXPECT_EQ(t.numbers("reference")[0], 0.67) << name;
  }
  const std::string page = make_study_report(folder.path());
  EXPECT_EQ(page.find("thesis"), std::string::npos);
  EXPECT_NE(page.find("L-bend: simulation, reference and experiment"), std::string::npos);
  EXPECT_NE(page.find("in brackets: the reference."), std::string::npos);
}

// A case whose fines were replayed has the laws of the replay, not those of the run.
TEST(StudyReport, AReplayedCaseHasItsOwnLawsAmongItsAssumptions) {
  const Scratch folder;
  Summary s;
  s.state = "finished";
  s.fines = {{"A", 0.5, 0.1, 0.1, 0.3, 0.0, 0.0, {}}};
  s.assumptions = {"air.density: dry air", "fines.micromodels: a surrogate", "micro-models: laws of the run"};
  s.warnings = {"micro-models: an impact on a wall, at 9 m/s, is faster than its law was made for"};
  write_run(folder, "AB/seed-1", s);
  const std::string head = R"({"fines": {"A": {"FFE": 0.6}}, )";
  write_whole(folder / "AB/seed-1/replay-B.json", head + R"("label": "derived", "source": "laws of the replay"})");
  write_plan(folder, R"({"name": "A", "runs": [{"job": "AB/seed-1"}]},
                        {"name": "B", "runs": [{"job": "AB/seed-1", "replay": "replay-B.json"}]})",
             {"AB/seed-1"});
  const StudyResults results = read_study_results(folder.path());
  EXPECT_EQ(results.cases[0].runs[0].summary->assumptions, s.assumptions);
  EXPECT_EQ(results.cases[0].runs[0].summary->warnings, s.warnings);
  const std::vector<std::string> own{"air.density: dry air",
                                     "micro-models: derived: laws of the replay; replayed from the contacts of another "
                                     "set's run (replay-B.toml)"};
  EXPECT_EQ(results.cases[1].runs[0].summary->assumptions, own);
  EXPECT_TRUE(results.cases[1].runs[0].summary->warnings.empty());
}

// What all replicates of a case say is of the case, what one says is of that one.
TEST(StudyReport, TellsTheWarningsOfItsRuns) {
  const Scratch folder;
  Summary s;
  s.state = "finished";
  s.warnings = {"the inlet has 4.9 cells"};
  write_run(folder, "A/seed-1", s);
  write_run(folder, "B/seed-1", s);
  s.warnings.push_back("step 7: half the time step");
  write_run(folder, "A/seed-2", s);
  write_plan(folder, R"({"name": "A", "runs": [{"job": "A/seed-1"}, {"job": "A/seed-2"}]},
                        {"name": "B", "runs": [{"job": "B/seed-1"}]})",
             {"A/seed-1", "A/seed-2", "B/seed-1"});
  const std::string page = make_study_report(folder.path());
  EXPECT_NE(page.find("<h2>Warnings</h2>"), std::string::npos);
  EXPECT_NE(page.find("the inlet has 4.9 cells <span class=soft>(A, B)</span>"), std::string::npos);
  EXPECT_NE(page.find("step 7: half the time step <span class=soft>(A/seed-2)</span>"), std::string::npos);
}

}  // namespace
}  // namespace puffin::output
