// The promise of restart on the real device and dose: 20 kills at random moments of L-Base change nothing.

#include <algorithm>
#include <random>

#include "tests/tools/run/hurried_l_base.hpp"
#include "tests/tools/run/restart.hpp"

namespace {

using namespace puffin;
using std::chrono::milliseconds;

TEST(RestartLBase, TwentyKillsAtRandomMomentsChangeNothing) {
  const auto folder = std::filesystem::temp_directory_path() / "puffin-restart-l-base";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "case.toml") << hurried_l_base("10 ms");
  const auto words = [&](const std::string& name, int threads, bool resume) {
    std::vector<std::string> all{"run",       folder / "case.toml",
                                 "--out",     folder / name,
                                 "--quiet",   "--no-report",
                                 "--threads", std::to_string(threads),
                                 "--set",     "output.checkpoint.wall=\"1 ms\""};
    if (resume) all.emplace_back("--resume");
    return all;
  };
  const auto status = [&](const std::string& name) { return file_text(folder / name / "status.json"); };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(Child(words("whole", 2, false), folder / "whole.log").wait(), 0) << file_text(folder / "whole.log");
  const auto length = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begin);
  const auto rows = [&] {
    const std::string table = file_text(folder / "killed" / "history.csv");
    return std::count(table.begin(), table.end(), '\n');
  };
  std::mt19937 random(20);
  constexpr int kills = 20;
  int killed = 0, alive = 0;  // alive: killed after the part had got further than the one before
  long furthest = 0;
  for (bool ended = false; !ended;) {
    Child child(words("killed", 1 + killed % 2, killed > 0), folder / "killed.log");
    // Every fourth is killed while it sets up or soon after; the others a random while after they have got further than
    // ever, of which a run has 100 steps: a part, whatever else the machine does, takes 3 or 4 of them.
    if (killed < kills && killed % 4 != 3)
      while (!ended && rows() <= furthest) ended = child.ends_within(milliseconds(20));
    const milliseconds moment(killed < kills ? random() % (length.count() / (killed % 4 == 3 ? 20 : 50))
                                             : 24LL * 3600 * 1000);
    const std::string before = status("killed");
    ended = ended || child.ends_within(moment);
    if (!ended) child.send(SIGKILL);
    const int code = child.wait();
    if (ended && code == 7 && before.empty()) {  // killed before it had a folder: there is nothing to resume
      ended = false;
      killed = 0;
      continue;
    }
    if (ended) {
      ASSERT_EQ(code, 0) << file_text(folder / "killed.log");
    }
    if (!ended) ++killed;
    if (!ended && rows() > furthest) ++alive;
    furthest = std::max<long>(furthest, rows());
  }
  std::printf("%d kills, %d of them while it ran; the whole run took %lld ms\n", killed, alive,
              static_cast<long long>(length.count()));
  EXPECT_EQ(killed, kills) << "it ended too early: shorter parts are needed";
  EXPECT_GE(alive, kills / 2);
  expect_same_outputs(folder / "whole", folder / "killed");
  std::filesystem::remove_all(folder);
}

}  // namespace
