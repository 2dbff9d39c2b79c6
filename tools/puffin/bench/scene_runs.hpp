#pragma once
// Runs of one scene with several settings, made in turn, and what is kept of them.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/verification/ablation.hpp"
#include "tools/puffin/bench/child_run.hpp"

namespace puffin::tools {

/// One run.
struct SceneRun {
  double seconds = 0.0, processor_seconds = 0.0, foreign_load = 0.0;  // as of ChildRun
  std::map<std::string, double> numbers;                              // as of cases::RunOutput
  std::filesystem::path folder;
};

/// One setting of the scene, with a run for each repeat.
struct SceneSetting {
  std::string name;
  std::vector<cases::Override> sets;
  std::vector<SceneRun> runs = {};
  double seconds() const;            // medians over the runs
  double processor_seconds() const;  // of all threads
  double foreign_load() const;       // the largest
};

/// Runs every setting once in each of `repeats` rounds, so that a slow minute hits all of them; the round's number is
/// the seed, so that the runs of a round come in pairs. Says so line by line unless `silent`.
/// Throws std::runtime_error, naming scene and setting, if a run does not end well.
void run_in_turn(const cases::AblationScene& scene, int repeats, bool quick, bool silent, TemporaryFolder& place,
                 std::vector<SceneSetting>& settings);

/// One more run, with the seed given.
SceneRun run_scene(const cases::AblationScene& scene, const SceneSetting& setting, int seed, bool quick,
                   TemporaryFolder& place);

}  // namespace puffin::tools
