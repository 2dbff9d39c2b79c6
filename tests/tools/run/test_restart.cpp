// Killed, starved, interrupted: nothing is lost, and the resumed run ends as if nothing had happened.

#include <random>

#include "tests/tools/run/restart.hpp"
#include "tests/tools/run/small_dose.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"

namespace {

using namespace puffin;
using std::chrono::milliseconds;
namespace fs = std::filesystem;

class Restart : public SmallDose {
 protected:
  void SetUp() override {
    SmallDose::SetUp();
    std::ofstream(folder_ / "case.toml") << coarse_dose();
  }
  std::vector<std::string> words(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"run",         folder_ / "case.toml",
                                 "--out",       folder_ / name,
                                 "--set",       "output.checkpoint.wall=\"1 ms\"",
                                 "--no-report", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  fs::path log(const std::string& name) const { return folder_ / (name + ".log"); }
  std::vector<fs::path> checkpoints(const std::string& name) const { return output::list_checkpoints(folder_ / name); }
  /// Waits until the run has written its checkpoint of that number or a later one.
  bool has_checkpoint(const std::string& name, std::int64_t number, Child& child) const {
    for (int n = 0; n < 20000; ++n) {
      const auto files = checkpoints(name);
      if (!files.empty() && output::checkpoint_number(files.front()) >= number) return true;
      if (child.ends_within(milliseconds(10))) return false;
    }
    return false;
  }
};

TEST_F(Restart, KilledAtRandomMomentsARunEndsAsIfNothingHadHappened) {
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(Child(words("whole", {"--threads", "1"}), log("whole")).wait(), 0) << file_text(log("whole"));
  const auto length = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begin);
  std::mt19937 random(3);
  int kills = 0;
  for (bool ended = false; !ended;) {
    std::vector<std::string> more{"--threads", kills % 2 ? "1" : "2"};
    if (kills > 0) more.emplace_back("--resume");
    Child child(words("killed", more), log("killed"));
    // From within the set-up to beyond the end; the last part is left alone, so that the run ends at all.
    const milliseconds moment(kills < 6 ? 20 + random() % (length.count() / 2) : 600000);
    ended = child.ends_within(moment);
    if (!ended) child.send(SIGKILL);
    const int code = child.wait();
    if (ended && code == 7 && !fs::exists(folder_ / "killed" / "status.json")) {
      ended = false;  // killed before it had a folder: there is nothing to resume
      kills = 0;
      continue;
    }
    // Killed when all was written: nothing is left to resume.
    if (ended && code == 7 && file_text(log("killed")).find("holds a finished run") != std::string::npos) break;
    if (ended) {
      ASSERT_EQ(code, 0) << file_text(log("killed"));
    }
    ++kills;
  }
  EXPECT_GE(kills, 2);
  expect_same_outputs(folder_ / "whole", folder_ / "killed");
  EXPECT_LE(checkpoints("killed").size(), 2U);
  EXPECT_FALSE(fs::exists(folder_ / "killed" / "checkpoints" / "events.journal"));
}

TEST_F(Restart, SignalsAndTheWallTimeStopCleanlyAndCanBeResumed) {
  ASSERT_EQ(Child(words("whole"), log("whole")).wait(), 0);
  {
    Child child(words("parts"), log("parts"));
    ASSERT_TRUE(has_checkpoint("parts", 2, child));
    child.send(SIGTERM);
    EXPECT_EQ(child.wait(), 75) << file_text(log("parts"));
  }
  EXPECT_EQ(output::read_summary(folder_ / "parts" / "summary.json").state, "stopped");
  EXPECT_EQ(output::read_status(folder_ / "parts" / "status.json").state, "stopped");
  EXPECT_TRUE(fs::exists(folder_ / "parts" / "events.h5"));
  const std::int64_t first = output::checkpoint_number(checkpoints("parts").front());
  {
    Child child(words("parts", {"--resume"}), log("parts"));
    ASSERT_TRUE(has_checkpoint("parts", first + 2, child));
    child.send(SIGINT);
    EXPECT_EQ(child.wait(), 130) << file_text(log("parts"));
  }
  EXPECT_EQ(Child(words("parts", {"--resume", "--walltime", "1ms"}), log("parts")).wait(), 75);
  EXPECT_EQ(Child(words("parts"), log("parts")).wait(), 7) << "an unfinished run is not overwritten";
  EXPECT_EQ(Child(words("parts", {"--resume"}), log("parts")).wait(), 0) << file_text(log("parts"));
  expect_same_outputs(folder_ / "whole", folder_ / "parts");
  EXPECT_EQ(Child(words("parts", {"--resume"}), log("parts")).wait(), 7) << "a finished run is finished";
}

TEST_F(Restart, ARunUntilAMomentGoesOnAsIfItHadNeverEnded) {
  ASSERT_EQ(Child(words("whole"), log("whole")).wait(), 0);
  // Between two outputs: the step that ends there is cut short, and is none of the whole run.
  ASSERT_EQ(Child(words("part", {"--until", "5.71 ms"}), log("part")).wait(), 0) << file_text(log("part"));
  const output::Summary first = output::read_summary(folder_ / "part" / "summary.json");
  EXPECT_EQ(first.state, "finished");
  EXPECT_EQ(first.until.value(), 5.71e-3);
  EXPECT_NEAR(first.simulated_time, 5.71e-3, 1e-5);
  EXPECT_EQ(Child(words("part"), log("part")).wait(), 7) << "without --resume it is not touched";
  EXPECT_EQ(Child(words("part", {"--resume"}), log("part")).wait(), 0) << file_text(log("part"));
  expect_same_outputs(folder_ / "whole", folder_ / "part");
  EXPECT_FALSE(output::read_summary(folder_ / "part" / "summary.json").until);
  EXPECT_EQ(Child(words("part", {"--resume"}), log("part")).wait(), 7) << "now it is finished";
}

TEST_F(Restart, ADamagedCheckpointIsNamedAndTheOlderOneTaken) {
  ASSERT_EQ(Child(words("whole"), log("whole")).wait(), 0);
  {
    Child child(words("part"), log("part"));
    ASSERT_TRUE(has_checkpoint("part", 3, child));
    child.send(SIGTERM);
    ASSERT_EQ(child.wait(), 75);
  }
  const auto files = checkpoints("part");
  ASSERT_EQ(files.size(), 2U);
  std::string bytes = file_text(files[0]);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  std::ofstream(files[0], std::ios::binary) << bytes;
  EXPECT_EQ(Child(words("part", {"--resume"}), log("part")).wait(), 0) << file_text(log("part"));
  EXPECT_NE(file_text(log("part")).find(files[0].filename().string() + " is damaged"), std::string::npos);
  expect_same_outputs(folder_ / "whole", folder_ / "part");
}

TEST_F(Restart, WithoutASoundCheckpointOfThisCaseTheRunEndsWith7) {
  {
    Child child(words("part"), log("part"));
    ASSERT_TRUE(has_checkpoint("part", 2, child));
    child.send(SIGTERM);
    ASSERT_EQ(child.wait(), 75);
  }
  EXPECT_EQ(Child(words("part", {"--resume", "--set", "carriers.contact.restitution=0.5"}), log("part")).wait(), 7);
  EXPECT_NE(file_text(log("part")).find("there 'restitution = 0.6"), std::string::npos) << file_text(log("part"));
  EXPECT_EQ(Child(words("part", {"--resume", "--set", "numerics.dx=0.45e-3"}), log("part")).wait(), 7);
  for (const auto& file : checkpoints("part")) fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_EQ(Child(words("part", {"--resume"}), log("part")).wait(), 7);
  EXPECT_NE(file_text(log("part")).find("is sound; begin anew"), std::string::npos) << file_text(log("part"));
  EXPECT_EQ(Child(words("none", {"--resume"}), log("none")).wait(), 7);
}

TEST_F(Restart, AFullDiskEndsWith7AndTheRunGoesOnOnceThereIsRoom) {
  ASSERT_EQ(Child(words("whole"), log("whole")).wait(), 0);
  // Room for the first checkpoint and a little more history than there is then: half way, a table no longer fits.
  const auto size = fs::file_size(checkpoints("whole").back());
  Child full(words("full"), log("full"));
  ASSERT_TRUE(has_checkpoint("full", 2, full));
  const rlimit limit{size / 2, size / 2};
  full.limit_file_size(limit);
  EXPECT_EQ(full.wait(), 7) << file_text(log("full"));
  EXPECT_NE(file_text(log("full")).find("free some space"), std::string::npos) << file_text(log("full"));
  EXPECT_FALSE(checkpoints("full").empty());
  EXPECT_EQ(Child(words("full", {"--resume"}), log("full")).wait(), 0) << file_text(log("full"));
  expect_same_outputs(folder_ / "whole", folder_ / "full");
}

TEST_F(Restart, AFolderThatVanishesEndsWith7) {
  Child child(words("gone"), log("gone"));
  ASSERT_TRUE(has_checkpoint("gone", 1, child));
  fs::rename(folder_ / "gone", folder_ / "elsewhere");
  EXPECT_EQ(child.wait(), 7) << file_text(log("gone"));
  EXPECT_NE(file_text(log("gone")).find("has vanished"), std::string::npos) << file_text(log("gone"));
  EXPECT_FALSE(fs::exists(folder_ / "gone"));
}

}  // namespace
