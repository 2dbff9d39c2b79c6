// The promise of restart on the real case: 20 kills at random moments of the quick L-Base run change nothing.

#include <random>

#include "tests/tools/run/restart.hpp"

namespace {

using namespace puffin;
using std::chrono::milliseconds;

TEST(RestartLBase, TwentyKillsAtRandomMomentsChangeNothing) {
  const auto folder = std::filesystem::temp_directory_path() / "puffin-restart-l-base";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto words = [&](const std::string& name, int threads, bool resume) {
    std::vector<std::string> all{"run",
                                 PUFFIN_SOURCE_DIR "/cases/l-base/case.toml",
                                 "--preset",
                                 "quick",
                                 "--out",
                                 folder / name,
                                 "--quiet",
                                 "--threads",
                                 std::to_string(threads),
                                 "--set",
                                 "output.checkpoint.wall=\"2 s\""};
    if (resume) all.emplace_back("--resume");
    return all;
  };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(Child(words("whole", 2, false), folder / "whole.log").wait(), 0) << file_text(folder / "whole.log");
  const auto length = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begin);
  std::mt19937 random(20);
  constexpr int kills = 20;
  int done = 0;
  for (bool ended = false; !ended && done <= kills; ++done) {
    Child child(words("killed", 1 + done % 2, done > 0), folder / "killed.log");
    // Moments up to a tenth of the run after each start: 20 of them end near its middle.
    const milliseconds moment(done < kills ? 5000 + random() % (length.count() / 10) : 24 * 3600 * 1000);
    ended = child.ends_within(moment);
    if (!ended) child.send(SIGKILL);
    const int code = child.wait();
    if (ended) ASSERT_EQ(code, 0) << file_text(folder / "killed.log");
  }
  EXPECT_GE(done, 10);
  expect_same_outputs(folder / "whole", folder / "killed");
  std::filesystem::remove_all(folder);
}

}  // namespace
