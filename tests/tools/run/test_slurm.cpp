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

}  // namespace
