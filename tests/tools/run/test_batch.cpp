// Studies as a user sees them: what fails fails alone, what is finished is never redone, shared runs give the same.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/tools/run/batch_study.hpp"
#include "tests/tools/run/small_dose.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/study_results.hpp"
#include "tools/output/summary.hpp"

namespace {

using namespace puffin;
using namespace puffin::test;

TEST_F(BatchStudy, AFailedCaseFailsAloneAndIsTriedAgainOnlyWhenAsked) {
  file(
      "study.toml",
      "base = \"case.toml\"\n[[case]]\nname = \"good\"\n[[case]]\nname = \"misspelt\"\nset = { \"numerics.dxx\" = 1 }\n"
      "[[case]]\nname = \"diverges\"\nset = { \"numerics.reference_speed\" = 0.05, \"air.viscosity\" = 1e-8, "
      "\"stop.time\" = 0.4 }\n[[case]]\nname = "
      "\"fast\"\n"
      "set = { \"air.boundary[0].velocity\" = \"8 m/s\" }\n");
  EXPECT_EQ(batch("--jobs 2 --json"), 8) << text("log.txt");
  const output::StudyResults results = output::read_study_results(folder_ / "out");
  ASSERT_EQ(results.cases.size(), 4U);
  EXPECT_EQ(results.cases[0].runs[0].state, "done");
  EXPECT_EQ(results.cases[1].runs[0].exit_code, 3);
  EXPECT_EQ(results.cases[2].runs[0].state, "failed");
  EXPECT_EQ(results.cases[2].runs[0].exit_code, 5) << results.cases[2].runs[0].message;
  EXPECT_EQ(results.cases[3].runs[0].state, "done");
  EXPECT_NE(text("log.txt").find("study.toml:6:"), std::string::npos) << text("log.txt");
  EXPECT_NE(text("json.txt").find("\"exit_code\": 8"), std::string::npos);
  EXPECT_NE(text("out/diverges/seed-1/run.log").find("diverged"), std::string::npos);
  for (const char* name : {"report.html", "results.csv", "runs.csv", "results.json", "status.json", "index.html"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  EXPECT_NE(text("out/index.html").find("href=\"good/seed-1/index.html\""), std::string::npos);
  EXPECT_NE(text("out/index.html").find("href=\"misspelt/seed-1/run.log\""), std::string::npos) << "it has no page";
  EXPECT_NE(text("out/status.json").find("\"format\": 1"), std::string::npos);

  EXPECT_EQ(batch(""), 8);
  EXPECT_EQ(text("out/study.json").find("\"attempts\": 2"), std::string::npos) << "a failed or finished run was redone";
  EXPECT_EQ(batch("--retry-failed --only diverges"), 8);
  EXPECT_NE(text("out/study.json").find("\"attempts\": 2"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/diverges/seed-1.failed-1/run.log")) << "the first log is kept";
  EXPECT_EQ(batch("--only '[gf]*'"), 0) << "the chosen cases are all finished";
}

TEST_F(BatchStudy, AKilledBatchGoesOnWithoutRedoingWhatIsFinished) {
  file("study.toml",
       "base = \"case.toml\"\n[sweep]\nmethod = \"list\"\n[sweep.range]\n"
       "\"stop.time\" = [\"1.2 ms\", \"1.1 ms\", \"1 ms\", \"40 s\"]\n");
  // The long run is the dearest and starts first; the short ones end beside it. Then the batch is killed outright.
  EXPECT_NE(shell("timeout -s KILL 6 " + std::string(PUFFIN_BINARY_DIR) +
                  "/puffin batch study.toml --out out --jobs 2 > /dev/null 2> log.txt"),
            0);
  const auto before = text("out/duct-1/seed-1/summary.json"), status = text("out/status.json");
  ASSERT_NE(before.find("finished"), std::string::npos) << text("log.txt");
  EXPECT_NE(status.find("\"state\": \"running\""), std::string::npos);
  EXPECT_NE(text("out/index.html").find("http-equiv=\"refresh\""), std::string::npos);
  // The long run may still be writing its last checkpoint; it is gone on with all the same, and stopped in order.
  EXPECT_EQ(shell("timeout --preserve-status -s TERM 5 " + std::string(PUFFIN_BINARY_DIR) +
                  "/puffin batch study.toml --out out --only duct-4 > /dev/null 2>> log.txt"),
            75)
      << text("log.txt");
  EXPECT_EQ(batch("--only 'duct-[123]'"), 0);
  EXPECT_EQ(text("out/duct-1/seed-1/summary.json"), before);
  const std::string book = text("out/study.json");
  ASSERT_NE(book.find("\"attempts\": 2"), std::string::npos);
  EXPECT_EQ(book.find("\"attempts\": 2"), book.rfind("\"attempts\": 2")) << "the long run alone";
}

// The run of 40 s of air is shot as soon as its status is there, half a minute later at the latest.
TEST_F(BatchStudy, ARunThatASignalEndsIsBookedWithItsName) {
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"shot\"\nset = { \"stop.time\" = \"40 s\" }\n");
  EXPECT_EQ(shell("{ " + std::string(PUFFIN_BINARY_DIR) +
                  "/puffin batch study.toml --out out > /dev/null 2> log.txt & batch=$!; "
                  "for n in $(seq 600); do grep -qs running out/shot/seed-1/status.json && break; sleep 0.05; done; "
                  "pkill -KILL -P $batch; wait $batch; }"),
            8)
      << text("log.txt");
  EXPECT_NE(text("out/study.json").find("ended by signal 9 (Killed)"), std::string::npos) << text("out/study.json");
}

TEST_F(BatchStudy, AFinishedRunOfAnotherCaseIsNeverTakenForThisOne) {
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\nset = { \"air.density\" = 1.3 }\n");
  EXPECT_EQ(batch(""), 7);
  EXPECT_NE(text("log.txt").find("finished run of another case"), std::string::npos);
}

// The folder of a study that was got from elsewhere: a log is appended to, what settled beds and lists share lies in
// one.
TEST_F(BatchStudy, ALinkOutOfTheStudyIsRefused) {
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n");
  file("mine.txt", "mine");
  for (const char* link : {"out/.lock", "out/a/seed-1/run.log", "out/a/seed-1", "out/shared"}) {
    fs::remove_all(folder_ / "out");
    fs::create_directories((folder_ / link).parent_path());
    fs::create_symlink(folder_ / (link == std::string("out/a/seed-1/run.log") ? "mine.txt" : "nowhere"),
                       folder_ / link);
    EXPECT_EQ(batch(""), 7) << link;
    EXPECT_NE(text("log.txt").find("leads it out of the folder"), std::string::npos) << link << text("log.txt");
    fs::remove(folder_ / "log.txt");
    EXPECT_FALSE(fs::exists(folder_ / "nowhere")) << link;
  }
  EXPECT_EQ(text("mine.txt"), "mine");
}

TEST_F(BatchStudy, TheTableStandsBesideTheGivenValues) {
  file("study.toml", "base = \"case.toml\"\nreplicates = 2\n[[case]]\nname = \"a\"\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const auto table = output::read_csv(folder_ / "out/results.csv");
  const auto names = static_cast<std::size_t>(table.find("quantity"));
  bool found = false;
  for (std::size_t n = 0; n < table.rows.size(); ++n)
    if (table.rows[n][names] == "static_drop") {
      found = true;
      const auto one = output::read_summary(folder_ / "out/a/seed-1/summary.json").pressure->static_drop;
      // Nothing in this case is random: both seeds give the same, and say nothing of an interval.
      EXPECT_DOUBLE_EQ(table.numbers("mean")[n], *one.mean);
      EXPECT_EQ(std::isnan(table.numbers("ci_high")[n]), !one.ci_high);
      EXPECT_NE(table.rows[n][static_cast<std::size_t>(table.find("interval"))], "replicates");
      EXPECT_EQ(table.numbers("replicates")[n], 2.0);
      EXPECT_EQ(table.numbers("thesis")[n], 100.0);
    }
  EXPECT_TRUE(found);
}

TEST_F(BatchStudy, GivenValuesOfTheBaseAreNotThoseOfAnotherDrug) {
  file("study.toml",
       "base = \"case.toml\"\n[[case]]\nname = \"finer\"\nset = { \"numerics.dx\" = \"0.4 mm\" }\n[[case]]\n"
       "name = \"heavier\"\nset = { \"air.density\" = 1.3 }\n[[case]]\nname = \"own\"\n"
       "set = { \"air.density\" = 1.3, \"reference.thesis.static_drop\" = 7 }\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const output::StudyResults r = output::read_study_results(folder_ / "out");
  ASSERT_TRUE(r.cases[0].given("thesis", "static_drop"));
  EXPECT_EQ(r.cases[0].given("thesis", "static_drop")->given, 100.0);
  EXPECT_FALSE(r.cases[1].given("thesis", "static_drop"));
  ASSERT_TRUE(r.cases[2].given("thesis", "static_drop"));
  EXPECT_EQ(r.cases[2].given("thesis", "static_drop")->given, 7.0);
}

// Air, carriers and contacts do not know of the fines, so all but what is in the air must be the same to the last bit.
// In the air the shared run steps as the most diffusive scalar needs: with equal diffusion the same bits too.
TEST_F(BatchStudy, ASharedRunGivesWhatEachCaseGivesAlone) {
  file("case.toml", small_dose);
  const std::string cases =
      "[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\nset = { \"fines.scalar[0].scheme\" = \"minmod\" }\n";
  file("study.toml", "base = \"case.toml\"\nshare = [\"scalars\"]\n" + cases);
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  ASSERT_TRUE(fs::exists(folder_ / "out/shared/a_b/seed-1/summary.json"));
  file("study.toml", "base = \"case.toml\"\n" + cases);
  ASSERT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin batch study.toml --out alone > /dev/null 2> log.txt"), 0);
  const auto shared = output::read_study_results(folder_ / "out"),
             alone = output::read_study_results(folder_ / "alone");
  for (std::size_t n = 0; n < 2; ++n)
    for (const char* quantity : {"FFE", "FFW", "FFCR", "FFCE", "in_air", "collisions.wall", "mean_wall_energy", "steps",
                                 "by_mechanism.wall", "static_drop", "RDF"}) {
      SCOPED_TRACE(quantity);
      ASSERT_TRUE(shared.cases[n].find(quantity) && alone.cases[n].find(quantity));
      EXPECT_EQ(shared.cases[n].find(quantity)->mean, alone.cases[n].find(quantity)->mean);
    }
  // And over time: the curves of the second case are its own, not those of the first scalar.
  const fs::path stats = folder_ / "out/shared/a_b/seed-1/stats.h5";
  const auto own = output::read_csv(folder_ / "alone/b/seed-1/history.csv");
  EXPECT_EQ(output::read_stats(stats, "in_air_b"), own.numbers("in_air"));
  EXPECT_EQ(output::read_stats(stats, "FFE_b"), own.numbers("FFE"));
  EXPECT_NE(output::read_stats(stats, "in_air_a"), own.numbers("in_air"));
}

/// A power law that detaches `limit` of the fines at any hard hit.
std::string micromodel_set(double limit) {
  return "label = \"given\"\nsource = \"the set of " + std::to_string(limit) +
         "\"\nsurface_energy = 3.6e-3\n[wall_detach]\nlaw = \"power\"\nA = [" + std::to_string(limit) +
         ", 1.0, 0.01, " + std::to_string(limit) + ", 0.0]\nvalid = [0.0, 100.0]\n";
}

// Fines do not act on air, carriers or contacts: what is left on the carriers is the same as in a run with those laws,
// to the rounding of other orders of summation (1e-9 of the fines; sums of some 1e6 terms). Where airborne fines ended
// is taken from the run.
TEST_F(BatchStudy, ReplayedMicromodelsLeaveOnTheCarriersWhatARunOfTheirOwnLeaves) {
  file("case.toml", small_dose);
  file("weak.toml", micromodel_set(0.05));
  file("strong.toml", micromodel_set(0.2));
  const std::string first = "[[case]]\nname = \"a\"\nset = { \"fines.micromodels\" = \"weak.toml\" }\n",
                    second = "[[case]]\nname = \"b\"\nset = { \"fines.micromodels\" = \"strong.toml\" }\n";
  file("study.toml", "base = \"case.toml\"\nshare = [\"micromodels\"]\n" + first + second);
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  ASSERT_TRUE(fs::exists(folder_ / "out/shared/a_b/seed-1/replay-b.json")) << text("log.txt");
  const auto run = output::read_summary(folder_ / "out/shared/a_b/seed-1/summary.json");
  ASSERT_EQ(run.fines.size(), 1U) << "the run has computed the fines of a alone";
  EXPECT_EQ(run.fines[0].name, "a");
  file("study.toml", "base = \"case.toml\"\n" + second);
  ASSERT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin batch study.toml --out alone > /dev/null 2> log.txt"), 0);
  const auto shared = output::read_study_results(folder_ / "out"),
             alone = output::read_study_results(folder_ / "alone");
  for (const char* quantity : {"FFCR", "FFCE", "by_mechanism.wall", "RDF"}) {
    SCOPED_TRACE(quantity);
    ASSERT_TRUE(shared.cases[1].find(quantity) && alone.cases[0].find(quantity));
    EXPECT_NEAR(shared.cases[1].find(quantity)->mean, alone.cases[0].find(quantity)->mean, 1e-9);
  }
  const auto said = [&](std::size_t n, const std::string& text) {  // among the assumptions of a case
    const auto& list = shared.cases[n].runs[0].summary->assumptions;
    return std::count_if(list.begin(), list.end(),
                         [&](const std::string& one) { return one.find(text) != std::string::npos; });
  };
  EXPECT_EQ(said(0, "the set of 0.05"), 1);
  EXPECT_EQ(said(1, "the set of 0.05"), 0) << "laws of the run that it does not have";
  EXPECT_EQ(said(1, "micro-models: given: the set of 0.200000; replayed"), 1);
  EXPECT_EQ(said(1, "replay-b.toml"), 1);
  EXPECT_EQ(said(1, "fines.micromodels"), 0);
  EXPECT_GT(shared.cases[0].find("FFCR")->mean, shared.cases[1].find("FFCR")->mean + 1e-3);  // the laws do differ
}

// A run names no scalar after a case whose results it does not hold: those of a and d are replayed. The fate of a's
// airborne fines is that of b's, which are carried alike; for d's it carries one more.
TEST_F(BatchStudy, AScalarIsNamedAfterTheCaseWhoseResultsItHolds) {
  file("case.toml", small_dose);
  file("strong.toml", micromodel_set(0.2));
  const std::string laws = "\"fines.micromodels\" = \"strong.toml\"",
                    scheme = "\"fines.scalar[0].scheme\" = \"minmod\"";
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"scalars\", \"micromodels\"]\n[[case]]\nname = \"b\"\n"
       "[[case]]\nname = \"a\"\nset = { " +
           laws + " }\n[[case]]\nname = \"d\"\nset = { " + laws + ", " + scheme + " }\n");
  ASSERT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin plan study.toml > plan.txt 2> log.txt"), 0)
      << text("log.txt");
  const std::string plan = text("plan.txt");
  EXPECT_NE(plan.find("name = \"b\""), std::string::npos) << plan;
  EXPECT_EQ(plan.find("name = \"a\""), std::string::npos) << plan;
  EXPECT_EQ(plan.find("name = \"d\""), std::string::npos) << plan;
  EXPECT_NE(plan.find("name = \"d-with-micromodels-of-b\""), std::string::npos) << plan;
}

// Carriers that do not act on the air feel the same air alone and beside others. While no dose rests as a whole, both
// ways take the same intervals, so that every number is the same to the last bit.
TEST_F(BatchStudy, ASharedFlowGivesWhatEachOneWayCaseGivesAlone) {
  file("case.toml", small_dose);
  const std::string cases =
      "[[case]]\nname = \"a\"\nset = { \"carriers.two_way\" = false, \"stop.time\" = \"8 ms\" }\n[[case]]\nname = "
      "\"b\"\n"
      "set = { \"carriers.two_way\" = false, \"carriers.count\" = 500, \"stop.time\" = \"8 ms\" }\n";
  file("study.toml", "base = \"case.toml\"\nshare = [\"one-way-flow\"]\n" + cases);
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  ASSERT_TRUE(fs::exists(folder_ / "out/flow-1.json")) << text("log.txt");
  file("study.toml", "base = \"case.toml\"\n" + cases);
  ASSERT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin batch study.toml --out alone > /dev/null 2> log.txt"), 0);
  const auto shared = output::read_study_results(folder_ / "out"),
             alone = output::read_study_results(folder_ / "alone");
  for (std::size_t n = 0; n < 2; ++n)
    for (const char* quantity : {"FFE", "FFW", "FFCR", "FFCE", "in_air", "collisions.wall", "collisions.particle",
                                 "mean_wall_energy", "steps", "static_drop", "RDF"}) {
      SCOPED_TRACE(quantity);
      ASSERT_TRUE(shared.cases[n].find(quantity) && alone.cases[n].find(quantity)) << text("out/a/seed-1/run.log");
      EXPECT_EQ(shared.cases[n].find(quantity)->mean, alone.cases[n].find(quantity)->mean);
    }
  EXPECT_GT(shared.cases[0].find("collisions.particle")->mean, shared.cases[1].find("collisions.particle")->mean);
  for (const char* run : {"a/seed-1", "b/seed-1"}) {  // and each tells of the flow it rode on, owner of it or not
    SCOPED_TRACE(run);
    const output::Summary ours = output::read_summary(folder_ / "out" / run / "summary.json"),
                          own = output::read_summary(folder_ / "alone" / run / "summary.json");
    EXPECT_EQ(ours.dt_min, own.dt_min);
    EXPECT_EQ(ours.dt_max, own.dt_max);
    EXPECT_EQ(ours.tau_min, own.tau_min);
    EXPECT_EQ(ours.mach_max, own.mach_max);
    EXPECT_GT(ours.mlups, 0.0);
  }
}

TEST_F(BatchStudy, OfASharedFlowOnlyWhatIsNotFinishedIsRunAgain) {
  file("case.toml", small_dose);
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"one-way-flow\"]\n[[case]]\nname = \"a\"\nset = { \"stop.time\" = \"1 ms\" }\n"
       "[[case]]\nname = \"b\"\nset = { \"stop.time\" = \"2 ms\" }\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const std::string before = text("out/a/seed-1/summary.json");
  fs::remove_all(folder_ / "out/b");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  EXPECT_EQ(text("out/a/seed-1/summary.json"), before);
  EXPECT_NEAR(output::read_summary(folder_ / "out/b/seed-1/summary.json").simulated_time, 2e-3, 1e-5);
}

// mean 2, standard deviation 1, t(0.975, 2) = 4.303: half width 4.303/sqrt(3) = 2.484 (four digits in the table).
TEST(StudyTable, TheIntervalOfThreeValuesIsStudents) {
  const output::Estimate e = output::estimate({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(e.mean, 2.0);
  EXPECT_NEAR(*e.ci_high - e.mean, 4.302653 / std::sqrt(3.0), 5e-4);
  EXPECT_NEAR(e.mean - *e.ci_low, 4.302653 / std::sqrt(3.0), 5e-4);
  EXPECT_EQ(e.interval, "replicates");
  EXPECT_FALSE(output::estimate({1.0}).ci_low);
  EXPECT_FALSE(output::estimate({2.0, 2.0, 2.0}).ci_low) << "seeds that change nothing tell nothing";
}

}  // namespace
