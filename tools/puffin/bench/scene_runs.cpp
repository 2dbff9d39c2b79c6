#include "tools/puffin/bench/scene_runs.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tools/bench/median.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {
namespace {

double median_of(const std::vector<SceneRun>& runs, double SceneRun::*member) {
  std::vector<double> values;
  for (const SceneRun& run : runs) values.push_back(run.*member);
  return bench::median(std::move(values));
}

}  // namespace

double SceneSetting::seconds() const { return median_of(runs, &SceneRun::seconds); }

double SceneSetting::processor_seconds() const { return median_of(runs, &SceneRun::processor_seconds); }

double SceneSetting::foreign_load() const {
  double most = 0.0;
  for (const SceneRun& run : runs) most = std::max(most, run.foreign_load);
  return most;
}

SceneRun run_scene(const cases::AblationScene& scene, const SceneSetting& setting, int seed, bool quick,
                   TemporaryFolder& place) {
  std::vector<cases::Override> sets;
  if (quick) sets = scene.quick_sets;
  sets.push_back({"numerics.seed", std::to_string(seed)});
  sets.insert(sets.end(), setting.sets.begin(), setting.sets.end());
  SceneRun run;
  run.folder = place.fresh();
  const ChildRun child = run_child(scene.case_file, sets, run.folder);
  if (!child.output)
    throw std::runtime_error("bench skip, scene " + scene.name + ", " + setting.name + ": " + child.problem);
  run.seconds = child.seconds;
  run.processor_seconds = child.processor_seconds;
  run.foreign_load = child.foreign_load;
  run.numbers = child.output->numbers;
  return run;
}

void run_in_turn(const cases::AblationScene& scene, int repeats, bool quick, bool silent, TemporaryFolder& place,
                 std::vector<SceneSetting>& settings) {
  for (int round = 1; round <= repeats; ++round)
    for (SceneSetting& setting : settings) {
      setting.runs.push_back(run_scene(scene, setting, round, quick, place));
      if (silent) continue;
      char line[200];
      std::snprintf(line, sizeof line, "  %d of %d  %-14s %-48s %8.2f s", round, repeats, scene.name.c_str(),
                    setting.name.c_str(), setting.runs.back().seconds);
      print(line);
    }
}

}  // namespace puffin::tools
