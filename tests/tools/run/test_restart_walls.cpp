// Killed and resumed, with what the other restart tests do not have: walls as partly solid cells, walls as markers, the
// carriers' volume in the air's equations, fines with inertia, and a closed box whose mass is kept.

#include "tests/tools/run/restart.hpp"
#include "tests/tools/run/small_dose.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/summary.hpp"

namespace {

using namespace puffin;
namespace fs = std::filesystem;

struct Scene {
  const char* name;
  std::string file;  // of the source tree; empty: the coarse dose
  std::vector<std::string> settings;
};

class RestartScenes : public SmallDose, public ::testing::WithParamInterface<Scene> {
 protected:
  void SetUp() override {
    SmallDose::SetUp();
    std::ofstream(folder_ / "case.toml") << (GetParam().file.empty()
                                                 ? coarse_dose()
                                                 : file_text(fs::path(PUFFIN_SOURCE_DIR) / GetParam().file));
  }
  std::vector<std::string> words(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"run", folder_ / "case.toml", "--out", folder_ / name, "--no-report", "--quiet"};
    for (const std::string& setting : GetParam().settings) all.insert(all.end(), {"--set", setting});
    all.insert(all.end(), {"--set", "output.checkpoint.wall=\"1 ms\""});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  fs::path log(const std::string& name) const { return folder_ / (name + ".log"); }
  std::int64_t newest(const std::string& name) const {
    const auto files = output::list_checkpoints(folder_ / name);
    return files.empty() ? -1 : output::checkpoint_number(files.front());
  }
};

TEST_P(RestartScenes, KilledTwiceARunEndsAsIfNothingHadHappened) {
  ASSERT_EQ(Child(words("whole", {"--threads", "1"}), log("whole")).wait(), 0) << file_text(log("whole"));
  for (int kills = 0; kills < 2; ++kills) {
    std::vector<std::string> more{"--threads", kills == 0 ? "2" : "1"};
    if (kills > 0) more.emplace_back("--resume");
    const std::int64_t wanted = newest("killed") + 3;
    Child child(words("killed", more), log("killed"));
    while (newest("killed") < wanted) ASSERT_FALSE(child.ends_within(std::chrono::milliseconds(10)));
    child.send(SIGKILL);
    ASSERT_EQ(child.wait(), -SIGKILL);
  }
  ASSERT_EQ(Child(words("killed", {"--threads", "2", "--resume"}), log("killed")).wait(), 0)
      << file_text(log("killed"));
  expect_same_outputs(folder_ / "whole", folder_ / "killed");
  if (const auto air = output::read_summary(folder_ / "whole" / "summary.json").air_mass) {
    EXPECT_GT(air->corrections, 0);
  }
}

const Scene scenes[] = {
    {"psm", "", {"numerics.wall=\"psm\""}},
    {"ibm", "", {"numerics.wall=\"ibm\""}},
    {"inertial", "", {"fines.wall_deposition=\"inertial\""}},
    {"averaged", "", {"carriers.volume_fraction=\"averaged\""}},
    {"closed", "tests/soak/soak.toml", {"stop.time=\"13 ms\"", "output.checkpoint.keep=2"}},
};

INSTANTIATE_TEST_SUITE_P(Of, RestartScenes, ::testing::ValuesIn(scenes),
                         [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
