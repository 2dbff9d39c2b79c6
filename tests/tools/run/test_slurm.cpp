// The same studies as a job array, with a stand-in for the scheduler.

#include "tests/tools/run/batch_study.hpp"
#include "tools/output/study_results.hpp"

namespace {

using namespace puffin;
using namespace puffin::test;

/// Stands in for Slurm: sbatch runs the tasks of the array one after the other and squeue then knows of none.
class SlurmStudy : public BatchStudy {
 protected:
  void SetUp() override {
    BatchStudy::SetUp();
    fs::create_directories(folder_ / "bin");
    file("bin/sbatch",
         "#!/bin/sh\nfor a in \"$@\"; do case $a in --array=*) list=${a#--array=};; *.sh) script=$a;; esac; done\n"
         "echo \"$list\" >> " +
             (folder_ / "sent.txt").string() +
             "\nfor n in $(echo ${list%%%*} | tr , ' '); do SLURM_ARRAY_TASK_ID=$n sh $script; done\necho "
             "'77;cluster'\n");
    file("bin/squeue", "#!/bin/sh\nexit 0\n");
    fs::permissions(folder_ / "bin/sbatch", fs::perms::owner_all);
    fs::permissions(folder_ / "bin/squeue", fs::perms::owner_all);
  }
  int slurm_batch(const std::string& arguments) const {
    return shell("PATH=$PWD/bin:$PATH " + std::string(PUFFIN_BINARY_DIR) +
                 "/puffin batch study.toml --slurm --out out " + arguments + " > json.txt 2>> log.txt");
  }
};

TEST_F(SlurmStudy, AnArrayGivesTheSameTablesAsTheBatch) {
  file("study.toml",
       "base = \"case.toml\"\n[sweep]\nmethod = \"list\"\n[sweep.range]\n\"air.density\" = [1.1, 1.2, 1.3]\n");
  ASSERT_EQ(slurm_batch("--jobs 2"), 0) << text("log.txt");
  EXPECT_EQ(text("sent.txt"), "0,1,2%2\n");
  ASSERT_EQ(shell(std::string(PUFFIN_BINARY_DIR) + "/puffin batch study.toml --out here > /dev/null 2>> log.txt"), 0);
  const auto there = output::read_study_results(folder_ / "out"), here = output::read_study_results(folder_ / "here");
  ASSERT_EQ(there.cases.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    ASSERT_TRUE(there.cases[n].find("static_drop"));
    EXPECT_EQ(there.cases[n].find("static_drop")->mean, here.cases[n].find("static_drop")->mean);
  }
  ASSERT_EQ(slurm_batch(""), 0);  // everything is finished: nothing is sent again
  EXPECT_EQ(text("sent.txt"), "0,1,2%2\n");
}

TEST_F(SlurmStudy, ATaskThatFailsFailsAloneAndARefusalIsTold) {
  file("study.toml",
       "base = \"case.toml\"\n[[case]]\nname = \"good\"\n[[case]]\nname = \"bad\"\n"
       "set = { \"numerics.reference_speed\" = 0.05, \"air.viscosity\" = 1e-8, \"stop.time\" = 0.4 }\n");
  EXPECT_EQ(slurm_batch(""), 8) << text("log.txt");
  EXPECT_TRUE(fs::exists(folder_ / "out/good/seed-1/report.html"));
  file("bin/sbatch", "#!/bin/sh\necho 'sbatch: error: invalid partition specified: night'\nexit 1\n");
  EXPECT_EQ(slurm_batch("--retry-failed"), 7);
  EXPECT_NE(text("log.txt").find("invalid partition specified: night"), std::string::npos);
}

// A plug-in of the site may speak before sbatch gives the number. The first array holds a alone and is still in the
// queue when all is asked for: it is watched first, then b is sent.
TEST_F(SlurmStudy, WhatAnEarlierArrayLeftOutIsSentAfterIt) {
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n");
  const std::string sbatch = text("bin/sbatch");
  file("bin/sbatch", "#!/bin/sh\necho 'sbatch: note of the site' >&2\necho 'lua: 3 rules'\necho 78\n");
  file("bin/squeue",
       "#!/bin/sh\ntouch " + (folder_ / "asked").string() + "\necho 'slurm_load: a note'\necho '0 PENDING'\n");
  EXPECT_EQ(
      shell("(PATH=$PWD/bin:$PATH " + std::string(PUFFIN_BINARY_DIR) +
            "/puffin batch study.toml --slurm --out out --only a > /dev/null 2>> log.txt & for n in $(seq 600); do "
            "if [ -e asked ]; then break; fi; sleep 0.05; done; kill -TERM $!; wait $!)"),
      75)
      << text("log.txt");
  EXPECT_EQ(text("out/slurm/array.txt"), "78\n0 a/seed-1\n");
  file("bin/sbatch", sbatch);
  file("bin/squeue", "#!/bin/sh\nif [ -e " + (folder_ / "gone").string() + " ]; then exit 0; fi\ntouch " +
                         (folder_ / "gone").string() + "\necho '0 PENDING'\n");
  EXPECT_EQ(slurm_batch(""), 75) << "a ended without a word: stopped";
  EXPECT_EQ(text("sent.txt"), "1\n");
  EXPECT_TRUE(fs::exists(folder_ / "out/b/seed-1/report.html"));
  EXPECT_EQ(slurm_batch(""), 0);
  EXPECT_EQ(text("sent.txt"), "1\n0\n");
}

TEST_F(SlurmStudy, AChangedStudyDoesNotWatchTheOldArray) {
  file("study.toml", "base = \"case.toml\"\n[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n");
  fs::create_directories(folder_ / "out/slurm");
  file("out/slurm/array.txt", "78\n0 a/seed-1\n5 f/seed-1\n");
  file("bin/squeue", "#!/bin/sh\necho '0 PENDING'\n");
  EXPECT_EQ(slurm_batch(""), 7);
  EXPECT_NE(text("log.txt").find("has other runs than when Slurm job 78 was sent"), std::string::npos);
  EXPECT_NE(text("out/status.json").find("\"failed\""), std::string::npos);
}

}  // namespace
