#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "tests/tools/output/scratch.hpp"
#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

void leave_run(const fs::path& folder, const std::string& state, bool with_checkpoint) {
  fs::create_directories(folder / "vtk");
  Status status;
  status.state = state;
  write_status(folder / "status.json", status);
  write_whole(folder / "history.csv", "time\n");
  Summary summary;
  summary.state = state;
  if (state == "finished") write_summary(folder / "summary.json", summary);
  if (!with_checkpoint) return;
  fs::create_directories(folder / "checkpoints");
  write_whole(folder / checkpoint_name(1), "data");
}

/// The text of the OutputError of opening the folder; empty if it opens.
std::string refusal(const fs::path& out, bool resume) {
  try {
    OutputFolder(out, "x", resume);
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

TEST(OutputFolder, AFinishedRunIsNeverOverwritten) {
  const Scratch folder;
  leave_run(folder / "run", "finished", true);
  EXPECT_NE(refusal(folder / "run", false).find("never overwritten"), std::string::npos);
  EXPECT_NE(refusal(folder / "run", true).find("never overwritten"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "run" / "history.csv"));
}

TEST(OutputFolder, AnUnfinishedRunWithCheckpointsWantsResume) {
  const Scratch folder;
  leave_run(folder / "run", "stopped", true);
  EXPECT_NE(refusal(folder / "run", false).find("--resume"), std::string::npos);
  EXPECT_EQ(refusal(folder / "run", true), "");
  EXPECT_TRUE(fs::exists(folder / "run" / "history.csv"));
}

TEST(OutputFolder, AnUnfinishedRunWithoutCheckpointsIsClearedOfItsOwnFilesOnly) {
  const Scratch folder;
  leave_run(folder / "run", "diverged", false);
  write_whole(folder / "run" / "notes.txt", "mine");
  EXPECT_EQ(refusal(folder / "run", false), "");
  EXPECT_FALSE(fs::exists(folder / "run" / "history.csv"));
  EXPECT_TRUE(fs::exists(folder / "run" / "notes.txt"));
}

TEST(OutputFolder, ResumingARunKilledBeforeItsFirstCheckpointBeginsAnew) {
  const Scratch folder;
  leave_run(folder / "run", "running", false);
  EXPECT_FALSE(OutputFolder(folder / "run", "x", true).resumed());
  EXPECT_FALSE(fs::exists(folder / "run" / "history.csv"));
  leave_run(folder / "run", "running", true);
  EXPECT_TRUE(OutputFolder(folder / "run", "x", true).resumed());
}

TEST(OutputFolder, AFolderAtWorkIsRefusedUntilItsRunIsOver) {
  const Scratch folder;
  {
    const OutputFolder run(folder / "run", "x");
    run.write_text("status.json", "{}");
    EXPECT_NE(refusal(folder / "run", false).find("another run is at work"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "run" / "status.json"));
  }
  EXPECT_EQ(refusal(folder / "run", false), "");
}

// A run that was told to end may still be writing its checkpoint when the same command goes on with it.
TEST(OutputFolder, ResumingWaitsForARunThatIsEnding) {
  const Scratch folder;
  leave_run(folder / "run", "stopped", true);
  auto ending = std::make_unique<OutputFolder>(folder / "run", "x", true);
  std::atomic<bool> over = false;
  std::thread end([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    over = true;
    ending.reset();
  });
  EXPECT_EQ(refusal(folder / "run", true), "");
  EXPECT_TRUE(over) << "it did not wait";
  end.join();
}

TEST(OutputFolder, AStudysFolderIsRefused) {
  const Scratch folder;
  write_whole(folder / "study.json", "{}");
  write_whole(folder / "status.json", "{}");
  EXPECT_NE(refusal(folder.path(), false).find("holds a study"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "status.json"));
}

TEST(OutputFolder, ResumingWhereNoRunIsIsRefused) {
  const Scratch folder;
  EXPECT_NE(refusal(folder / "run", true).find("without --resume"), std::string::npos);
}

TEST(OutputFolder, CheckpointsAreListedNewestFirst) {
  const Scratch folder;
  fs::create_directories(folder / "checkpoints");
  for (const int n : {7, 1000001, 12}) write_whole(folder / checkpoint_name(n), "data");
  for (const char* other : {"events.journal", "checkpoint-.bin", "checkpoint-1x.bin", "checkpoint-000013.bin.part"})
    write_whole(folder / "checkpoints" / other, "data");
  const auto files = list_checkpoints(folder.path());
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(checkpoint_number(files[0]), 1000001);
  EXPECT_EQ(checkpoint_number(files[2]), 7);
}

TEST(OutputFolder, AFolderThatVanishesIsAnErrorAndIsNotMadeAnew) {
  const Scratch folder;
  const OutputFolder run(folder / "run", "x");
  fs::remove_all(folder / "run");
  EXPECT_THROW(run.file("status.json"), OutputError);
  EXPECT_FALSE(fs::exists(folder / "run"));
}

TEST(OutputFolder, AFolderWithFilesOfTheSameNamesThatAreNotOfARunIsRefused) {
  const Scratch folder;
  write_whole(folder / "case.toml", "name = 'mine'");
  EXPECT_NE(refusal(folder.path(), false).find("is not the folder of a run"), std::string::npos);
  EXPECT_EQ(text_of(folder / "case.toml"), "name = 'mine'");
}

TEST(OutputFolder, TheDefaultIsANewFolderAndLatestPointsToIt) {
  const Scratch folder;
  const fs::path old = fs::current_path();
  fs::current_path(folder.path());
  const OutputFolder first({}, "L Base/1");
  const OutputFolder second({}, "L Base/1");
  fs::current_path(old);
  EXPECT_NE(first.path(), second.path());
  EXPECT_EQ(fs::canonical(folder / "runs" / "L_Base_1" / "latest"), second.path());
  EXPECT_EQ(first.path().parent_path(), fs::canonical(folder.path()) / "runs" / "L_Base_1");
}

TEST(OutputFolder, NothingIsWrittenOutside) {
  const Scratch folder;
  const OutputFolder run(folder / "run", "x");
  EXPECT_EQ(run.file("vtk/../vtk/a.vti"), run.path() / "vtk" / "a.vti");
  EXPECT_THROW(run.file("../outside"), OutputError);
  EXPECT_THROW(run.file("vtk/../../outside"), OutputError);
  EXPECT_THROW(run.file("/etc/outside"), OutputError);
  fs::create_directory_symlink(folder.path(), run.path() / "link");
  EXPECT_THROW(run.file("link/outside"), OutputError);
}

// The folder of a run that was got from elsewhere and is resumed: its tables are cut to a length, then appended to.
TEST(OutputFolder, ALinkInPlaceOfAFileIsNotFollowedOut) {
  const Scratch folder;
  const OutputFolder out(folder / "run", "x", false);
  write_whole(folder / "mine.txt", "mine");
  fs::create_symlink(folder / "mine.txt", out.path() / "history.csv");
  EXPECT_THROW(out.file("history.csv"), OutputError);
  fs::create_symlink(folder / "nowhere.txt", out.path() / "log.txt");
  EXPECT_THROW(out.file("log.txt"), OutputError);
  write_whole(out.path() / "within.txt", "");
  fs::create_symlink("within.txt", out.path() / "link.txt");
  EXPECT_NO_THROW(out.file("link.txt"));
}

// Symbolic or hard: opened by its name and cut to no length, either would take the other file's content.
TEST(WriteWhole, ALinkInPlaceOfTheTemporaryFileIsReplacedAndNotFollowed) {
  const Scratch folder;
  fs::create_directory(folder / "run");
  write_whole(folder / "mine.txt", "mine");
  fs::create_symlink(folder / "mine.txt", folder / "run" / "a.txt.part");
  fs::create_hard_link(folder / "mine.txt", folder / "run" / "b.txt.part");
  fs::create_symlink(folder / "nowhere.txt", folder / "run" / "c.txt.part");
  for (const char* name : {"a.txt", "b.txt", "c.txt"}) {
    write_whole(folder / "run" / name, "its");
    EXPECT_EQ(text_of(folder / "run" / name), "its");
  }
  EXPECT_EQ(text_of(folder / "mine.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder / "nowhere.txt"));
}

TEST(OutputFolder, AFolderThatCannotBeMadeIsAnOutputErrorWithARemedy) {
  EXPECT_NE(refusal("/proc/puffin/run", false).find("--out"), std::string::npos);
}

TEST(OutputFolder, AReadOnlyFolderIsAnOutputError) {
  if (geteuid() == 0) GTEST_SKIP() << "the administrator may write everywhere";
  const Scratch folder;
  fs::create_directory(folder / "run");
  fs::permissions(folder / "run", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(refusal(folder / "run", false).find("write into"), std::string::npos);
  fs::permissions(folder / "run", fs::perms::owner_all);
}

TEST(WriteWhole, AFullDiskLeavesTheOldFileAndNoTemporaryOne) {
  const Scratch folder;
  write_whole(folder / "a.txt", "old");
  {
    const FullDisk full(100);
    EXPECT_THROW(write_whole(folder / "a.txt", std::string(1000, 'x')), OutputError);
  }
  EXPECT_EQ(text_of(folder / "a.txt"), "old");
  EXPECT_FALSE(fs::exists(folder / "a.txt.part"));
}

}  // namespace
}  // namespace puffin::output
