// Studies and the folders they write: one for each case, none of another run, nothing missing in them.

#include "tests/tools/run/batch_study.hpp"
#include "tests/tools/run/small_dose.hpp"
#include "tools/output/study_results.hpp"
#include "tools/output/summary.hpp"

namespace {

using namespace puffin;
using namespace puffin::test;

/// A few carriers that fall onto a floor, with fines.
constexpr const char* fall = R"toml(
schema = 1
name = "fall"
geometry = { generator = "box", box = { x = "1 mm", y = "1 mm", z = "1 mm" } }
air = { model = "none" }
stop = { time = "1 ms" }
output = { statistics = "0.5 ms" }
[carriers]
list = [{ position = [5e-4, 5e-4, 5e-4], velocity = [0.0, 0.0, -2.0], diameter = "100 um", density = "1520 kg/m^3" }]
gravity = [0.0, 0.0, -9.81]
fines_each = 100
[fines]
micromodels = "sound.toml"
[[fines.scalar]]
name = "drug"
diffusion = "1e-6 kg/(m s)"
)toml";
constexpr const char* some_laws =
    "label = \"given\"\nsource = \"test\"\nsurface_energy = 3.6e-3\n[wall_detach]\nlaw = \"power\"\n"
    "A = [0.1, 1.0, 0.01, 0.1, 0.0]\nvalid = [0.0, 100.0]\n";

TEST_F(BatchStudy, CasesThatOneFolderWouldHoldAreRefusedTogether) {
  file("study.toml",
       "base = \"case.toml\"\n[[case]]\nname = \"a/b\"\nset = { \"air.density\" = 1.3 }\n[[case]]\nname = \"a_b\"\n");
  EXPECT_EQ(batch(""), 3);
  EXPECT_NE(text("log.txt").find("the cases 'a/b' and 'a_b' would share the folder a_b/seed-1"), std::string::npos)
      << text("log.txt");
  EXPECT_FALSE(fs::exists(folder_ / "out/a_b/seed-1/summary.json"));
}

// In a shared run too: there each has a file for what is replayed.
TEST_F(BatchStudy, CasesOfOneRunAreToldApart) {
  file("case.toml", fall);
  file("sound.toml", some_laws);
  file("other.toml", some_laws);
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"micromodels\"]\n[[case]]\nname = \"a b\"\n[[case]]\nname = \"a_b\"\n"
       "set = { \"fines.micromodels\" = \"other.toml\" }\n");
  EXPECT_EQ(batch(""), 3);
  EXPECT_NE(text("log.txt").find("the cases 'a b' and 'a_b' would share"), std::string::npos) << text("log.txt");
}

TEST_F(BatchStudy, AStudyAndARunDoNotShareAFolder) {
  const std::string program = std::string(PUFFIN_BINARY_DIR) + "/puffin ";
  ASSERT_EQ(shell(program + "run case.toml --out out --quiet --no-report > /dev/null 2> log.txt"), 0)
      << text("log.txt");
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n");
  const std::string before = text("out/status.json");
  EXPECT_EQ(batch(""), 7);
  EXPECT_NE(text("log.txt").find("holds a run"), std::string::npos) << text("log.txt");
  EXPECT_EQ(text("out/status.json"), before);

  ASSERT_EQ(shell(program + "batch study.toml --out study > /dev/null 2> log.txt"), 0) << text("log.txt");
  const std::string page = text("study/index.html");
  EXPECT_EQ(shell(program + "run case.toml --out study > /dev/null 2> log.txt"), 7);
  EXPECT_NE(text("log.txt").find("holds a study"), std::string::npos) << text("log.txt");
  EXPECT_EQ(text("study/index.html"), page);
}

TEST_F(BatchStudy, APageThatAKillHasPreventedIsMadeLater) {
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  fs::remove(folder_ / "out/a/seed-1/report.html");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  EXPECT_TRUE(fs::exists(folder_ / "out/a/seed-1/report.html"));
}

// A disk that lost the end of one file costs that run, not the tables of all others.
TEST_F(BatchStudy, ADamagedSummaryFailsAloneAndIsDoneAgain) {
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const std::string good = text("out/b/seed-1/summary.json");
  file("out/a/seed-1/summary.json", good.substr(0, good.size() / 2));
  EXPECT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin report out > /dev/null 2> report.txt"), 0)
      << text("report.txt");
  const output::StudyResults damaged = output::read_study_results(folder_ / "out");
  EXPECT_EQ(damaged.cases[0].runs[0].state, "failed");
  EXPECT_NE(damaged.cases[0].runs[0].message.find("summary.json"), std::string::npos);
  EXPECT_TRUE(damaged.cases[1].runs[0].summary);
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  EXPECT_TRUE(output::read_study_results(folder_ / "out").cases[0].runs[0].summary);
  EXPECT_EQ(text("out/b/seed-1/summary.json"), good);
  EXPECT_TRUE(fs::exists(folder_ / "out/a/seed-1.failed-1/summary.json"));
}

TEST_F(BatchStudy, LawsThatCannotBeReadFailTheirCaseAloneAlsoWhereRunsAreShared) {
  file("case.toml", fall);
  file("sound.toml", some_laws);
  file("wrong.toml", "label = \"given\"\nsource = \"test\"\n[wall_detach]\nlaw = \"pwer\"\n");
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"micromodels\"]\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n"
       "set = { \"fines.micromodels\" = \"wrong.toml\" }\n");
  EXPECT_EQ(batch(""), 8) << text("log.txt");
  const output::StudyResults results = output::read_study_results(folder_ / "out");
  EXPECT_EQ(results.cases[0].runs[0].state, "done");
  EXPECT_EQ(results.cases[1].runs[0].state, "failed");
  EXPECT_EQ(results.cases[1].runs[0].exit_code, 3);
  EXPECT_NE(text("out/b/seed-1/run.log").find("pwer"), std::string::npos) << text("out/b/seed-1/run.log");
}

TEST_F(BatchStudy, ChangedLawsAreNotThoseOfTheFinishedRun) {
  file("case.toml", fall);
  file("sound.toml", some_laws);
  file("other.toml", some_laws);
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"micromodels\"]\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n"
       "set = { \"fines.micromodels\" = \"other.toml\" }\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const auto left_on = [&](int n) { return output::read_study_results(folder_ / "out").cases[n].find("FFCR")->mean; };
  EXPECT_EQ(left_on(0), left_on(1));

  std::string weaker = some_laws;
  weaker.replace(weaker.find("0.1, 0.0]"), 9, "0.05, 0.0]");
  file("other.toml", weaker);  // only a replay: done again
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  EXPECT_GT(left_on(1), left_on(0));
  file("sound.toml", weaker);  // the run's own
  EXPECT_EQ(batch(""), 7);
  EXPECT_NE(text("log.txt").find("with other laws than its micro-model file has now"), std::string::npos);
}

TEST_F(BatchStudy, AChangedTableOfALawIsNotThatOfTheFinishedRun) {
  file("case.toml", fall);
  file("sound.toml", "label = \"given\"\n[wall_detach]\nlaw = \"table\"\nfile = \"t.csv\"\n");
  file("t.csv", "speed,fraction\n0,0\n10,0.5\n");
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  EXPECT_EQ(batch(""), 0) << "nothing has changed";
  EXPECT_NE(text("out/a/seed-1/micromodels.toml").find("\n# t.csv\n# speed,fraction\n# 0,0\n"), std::string::npos);
  file("t.csv", "speed,fraction\n0,0\n10,0.6\n");
  EXPECT_EQ(batch(""), 7);
  EXPECT_NE(text("log.txt").find("with other laws than its micro-model file has now"), std::string::npos);
}

TEST_F(BatchStudy, AChangedTableOfAReplayIsReplayedAnew) {
  file("case.toml", fall);
  file("sound.toml", some_laws);
  file("other.toml", "label = \"given\"\n[wall_detach]\nlaw = \"table\"\nfile = \"t.csv\"\n");
  file("t.csv", "speed,fraction\n0,0\n10,0.5\n");
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"micromodels\"]\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n"
       "set = { \"fines.micromodels\" = \"other.toml\" }\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const auto left = [&] { return output::read_study_results(folder_ / "out").cases[1].find("FFCR")->mean; };
  const double before = left();
  file("t.csv", "speed,fraction\n0,0\n10,1\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  EXPECT_LT(left(), before);
}

// Its checkpoint is that of another density: going on from it can never work, so it begins anew when it is tried again.
TEST_F(BatchStudy, WhatCannotGoOnFromItsCheckpointBeginsAnew) {
  file("study.toml",
       "base = \"case.toml\"\n[[case]]\nname = \"a\"\nset = { \"stop.time\" = \"1000 s\", "
       "\"output.checkpoint.wall\" = \"1 ms\" }\n");
  stop_at_checkpoint("");
  ASSERT_TRUE(fs::exists(folder_ / "out/a/seed-1/checkpoints")) << text("log.txt");
  ASSERT_FALSE(fs::is_empty(folder_ / "out/a/seed-1/checkpoints")) << text("log.txt");
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\nset = { \"air.density\" = 1.3 }\n");
  EXPECT_EQ(batch(""), 8);
  EXPECT_NE(text("log.txt").find("it belongs to another case"), std::string::npos) << text("log.txt");
  EXPECT_EQ(batch("--retry-failed"), 0) << text("log.txt");
  EXPECT_TRUE(fs::exists(folder_ / "out/a/seed-1.failed-1/checkpoints"));
}

TEST_F(BatchStudy, ACaseThatCannotBeReplayedHasFailed) {
  file("case.toml", fall);
  file("sound.toml", some_laws);
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"micromodels\"]\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n"
       "set = { \"fines.micromodels\" = \"other.toml\" }\n");
  file("other.toml", some_laws);
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const fs::path shared = folder_ / "out/shared/a_b/seed-1";
  fs::remove(shared / "replay-b.json");
  std::ofstream(shared / "events.h5") << "no record";
  EXPECT_EQ(batch(""), 8);
  EXPECT_NE(text("log.txt").find("b: no replay of"), std::string::npos) << text("log.txt");
  const output::StudyResults results = output::read_study_results(folder_ / "out");
  EXPECT_EQ(results.cases[0].runs[0].state, "done");
  EXPECT_EQ(results.cases[1].runs[0].state, "failed");
  EXPECT_EQ(results.cases[1].runs[0].exit_code, 7);
}

// A run alone, stopped, has a checkpoint; asked for beside the other one it goes on alone, as a shared flow keeps none.
TEST_F(BatchStudy, AStoppedMemberOfASharedFlowGoesOnFromItsCheckpoint) {
  file("case.toml", small_dose);
  file("study.toml",
       "base = \"case.toml\"\nshare = [\"one-way-flow\"]\n[[case]]\nname = \"a\"\nset = { \"stop.time\" = \"4 ms\", "
       "\"output.checkpoint\" = { wall = \"0.1 s\" } }\n[[case]]\nname = \"b\"\nset = { \"stop.time\" = \"1 ms\" }\n");
  stop_at_checkpoint("--only a");
  ASSERT_TRUE(fs::exists(folder_ / "out/a/seed-1/checkpoints")) << text("log.txt");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  EXPECT_NE(text("out/a/seed-1/log.txt").find("going on from"), std::string::npos);
  EXPECT_NEAR(output::read_summary(folder_ / "out/a/seed-1/summary.json").simulated_time, 4e-3, 1e-5);
}

// Its page says which pictures are missing, the tables and the code stay what they are.
TEST_F(BatchStudy, ARunWhoseFilesAreGoneTakesNoOthersPage) {
  file("case.toml", small_dose);
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\nset = { \"stop.time\" = \"2 ms\" }\n");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  for (const auto& entry : fs::directory_iterator(folder_ / "out/a/seed-1/vtk"))
    if (entry.path().extension() != ".pvd") fs::remove_all(entry.path());
  fs::remove_all(folder_ / "out/a/seed-1/images");
  fs::remove(folder_ / "out/report.html");
  EXPECT_EQ(batch("--json"), 0) << text("log.txt");
  EXPECT_TRUE(fs::exists(folder_ / "out/report.html"));
  EXPECT_NE(text("json.txt").find("\"FFE\""), std::string::npos);
}

TEST_F(BatchStudy, ReplicatesWithoutAnythingForTheirSeedAreWarnedOf) {
  file("study.toml",
       "base = \"case.toml\"\nreplicates = 2\n[[case]]\nname = \"calm\"\n[[case]]\nname = \"rough\"\n"
       "set = { \"air.boundary[0].turbulence\" = 0.05 }\n");
  ASSERT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin plan study.toml > /dev/null 2> log.txt"), 0);
  EXPECT_NE(text("log.txt").find("replicates of calm will all be equal"), std::string::npos) << text("log.txt");
  ASSERT_EQ(batch(""), 0) << text("log.txt");
  const output::StudyResults results = output::read_study_results(folder_ / "out");
  EXPECT_EQ(results.cases[0].find("static_drop")->n, 2);
  EXPECT_NE(results.cases[0].find("static_drop")->interval, "replicates");
  EXPECT_EQ(results.cases[1].find("static_drop")->interval, "replicates");
}

}  // namespace
