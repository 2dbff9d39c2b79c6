// puffin bench skip: time with and without each thing that a run leaves out, and what leaving it out does to the
// answer.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>

#include "cases/micromodel_file.hpp"
#include "cases/search_path.hpp"
#include "coupling/replay_fines.hpp"
#include "tools/bench/answer_shift.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/bench/scene_runs.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/replay_record.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {
namespace {

using bench::Answers;
using cases::Override;
using nlohmann::json;

constexpr int usual_repeats = 3;
constexpr int least_replicates = 3;  // fillings of the dose that say how well an answer is known

/// Run time, and processor time of all threads [s].
struct Spent {
  double seconds = 0.0, processor = 0.0;
};
Spent spent_by(const SceneSetting& s) { return {s.seconds(), s.processor_seconds()}; }

struct SkipRow {
  std::string skip, scene;
  bool exact = false;   // claimed
  Spent with, without;  // medians over the repeats
  bench::Shift shift;
  int repeats = 1;
  double foreign_load = 0.0;  // the largest of the runs
};

json to_json(const SkipRow& r) {
  return {{"skip", r.skip},
          {"scene", r.scene},
          {"exact", r.exact},
          {"repeats", r.repeats},
          {"seconds_with", r.with.seconds},
          {"seconds_without", r.without.seconds},
          {"speedup", r.without.seconds / r.with.seconds},
          {"processor_with", r.with.processor},
          {"processor_without", r.without.processor},
          {"processor_speedup", r.without.processor / r.with.processor},
          {"foreign_load", r.foreign_load},
          {"answer", r.shift.answer},
          {"change", r.shift.change},
          {"confidence", r.shift.half_width},
          {"change_over_confidence", r.shift.ratio},
          {"within", r.shift.within}};
}

std::string to_text(const SkipRow& r) {
  char line[240];
  std::snprintf(line, sizeof line, "%-62s %8.2f %8.2f  %5.2f  %3.0f %%  %-34s %-9.3g %-9.3g %5.2f  %s",
                (r.skip + ", " + r.scene).c_str(), r.with.processor, r.without.processor,
                r.without.processor / r.with.processor, 100.0 * r.foreign_load, r.shift.answer.c_str(), r.shift.change,
                r.shift.half_width, r.shift.ratio, r.shift.within ? r.exact ? "exact" : "within" : "OUT");
  return line;
}

constexpr const char* heading =
    "skip, scene                                       processor seconds, with  without  ratio foreign answer that "
    "moved most"
    "            change    interval  ratio";

/// The rows of one scene. Settings: first everything skipped, then each skip switched off.
class SceneBench {
 public:
  SceneBench(const cases::AblationScene& scene, const BenchArguments& a, TemporaryFolder& place)
      : scene_(scene),
        repeats_(a.repeats > 0 ? a.repeats
                 : a.quick     ? 1
                               : usual_repeats),
        quick_(a.quick),
        silent_(a.json),
        place_(place) {
    settings_.push_back({"everything skipped", {}});
  }

  /// Returns its place.
  std::size_t add(const std::string& name, const std::vector<Override>& sets) {
    settings_.push_back({name, sets});
    return settings_.size() - 1;
  }

  void run() {
    run_in_turn(scene_, repeats_, quick_, silent_, place_, settings_);
    replicates_ = base().runs;
    while (static_cast<int>(replicates_.size()) < least_replicates)
      replicates_.push_back(run_scene(scene_, base(), static_cast<int>(replicates_.size()) + 1, quick_, place_));
  }

  const SceneSetting& base() const { return settings_.front(); }
  const SceneSetting& at(std::size_t place) const { return settings_[place]; }

  /// The setting at `place` beside the base. scalar: whose fines are compared.
  SkipRow row(std::size_t place, bool exact, const std::vector<std::string>& more,
              const std::string& scalar = "") const {
    const SceneSetting& off = settings_[place];
    return {off.name,
            scene_.name,
            exact,
            spent_by(base()),
            spent_by(off),
            bench::farthest_shift(answers(base().runs, more), answers(off.runs, more, scalar), widths(more), exact),
            repeats_,
            std::max(base().foreign_load(), off.foreign_load())};
  }

  /// What the program skips without a switch: cells inside the walls, from the run's own account.
  SkipRow solid_cells() const {
    const Spent spent = spent_by(base());
    SkipRow row{"solid cells (never computed)", scene_.name, true, spent, spent, {}, repeats_, base().foreign_load()};
    const auto& numbers = base().runs.front().numbers;
    if (const auto saved = numbers.find("skipped.solid cells of the bounding box.seconds_saved");
        saved != numbers.end()) {
      row.without.seconds += saved->second;
      row.without.processor *= row.without.seconds / row.with.seconds;  // the cores as busy as in the whole run
    }
    return row;
  }

  /// Other micro-models by replay against a run of their own.
  SkipRow replayed() const {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t spent = std::clock();
    const SceneRun& run = base().runs.front();
    const StoredRun stored = read_stored_run(run.folder);
    const auto models = cases::read_micromodels(cases::found_micromodels("lactose-3.6e-3.toml"));
    const auto fines = summaries(coupling::replay(stored.record, models), stored.scalars);
    SkipRow row{"replay instead of a run", scene_.name, false, {}, spent_by(base()), {}, 1, base().foreign_load()};
    row.with.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    row.with.processor = static_cast<double>(std::clock() - spent) / CLOCKS_PER_SEC;
    const Answers ours = bench::answers_of(run.numbers, {});
    const Answers again{{"FFW", fines.front().FFW}, {"FFCR", fines.front().FFCR}, {"FFCE", fines.front().FFCE}};
    constexpr double rounding = 1e-9;
    row.shift =
        bench::farthest_shift({ours}, {again}, {{"FFW", rounding}, {"FFCR", rounding}, {"FFCE", rounding}}, false);
    return row;
  }

 private:
  /// By the scatter of the fillings or, where wider, the run's own interval of a mean over time.
  Answers widths(const std::vector<std::string>& more) const {
    Answers widths = bench::half_widths(answers(replicates_, more), repeats_);
    for (const auto& [name, own] : bench::own_half_widths(base().runs.front().numbers, more, repeats_))
      widths[name] = std::max(widths[name], own);
    return widths;
  }
  static std::vector<Answers> answers(const std::vector<SceneRun>& runs, const std::vector<std::string>& more,
                                      const std::string& scalar = "") {
    std::vector<Answers> all;
    for (const SceneRun& run : runs) all.push_back(bench::answers_of(run.numbers, more, scalar));
    return all;
  }

  const cases::AblationScene& scene_;
  int repeats_;
  bool quick_, silent_;
  TemporaryFolder& place_;
  std::vector<SceneSetting> settings_;
  std::vector<SceneRun> replicates_;  // of the base
};

/// Three scalars in one run, that of the scene among them.
std::vector<Override> three_scalars() {
  std::string list;
  for (const char* diffusion : {"1e-6", "1e-5", "1e-4"})
    list += std::string(list.empty() ? "" : ", ") + "{ name = \"d" + diffusion + "\", diffusion = \"" + diffusion +
            " kg/(m s)\" }";
  return {{"fines.scalar", "[" + list + "]"}};
}

/// All rows of a scene.
void bench_scene(const cases::AblationList& list, const cases::AblationScene& scene, const BenchArguments& a,
                 TemporaryFolder& place, const std::function<void(const SkipRow&)>& add) {
  SceneBench bench(scene, a, place);
  std::vector<std::pair<std::size_t, const cases::Ablation*>> skips;
  std::vector<Override> everything;
  std::vector<std::string> all_answers;
  for (const cases::Ablation& skip : list.skips) {
    if (skip.scene != scene.name) continue;
    skips.emplace_back(bench.add(skip.name, skip.off), &skip);
    everything.insert(everything.end(), skip.off.begin(), skip.off.end());
    all_answers.insert(all_answers.end(), skip.answers.begin(), skip.answers.end());
  }
  const std::size_t together = bench.add("all of these together", everything);
  const bool first = scene.name == list.scenes.front().name;
  const std::size_t shared = first ? bench.add("runs shared by three scalars", three_scalars()) : 0;
  bench.run();
  if (!a.json) print(heading);
  for (const auto& [at, skip] : skips) add(bench.row(at, skip->exact, skip->answers));
  add(bench.row(together, false, all_answers));
  if (!first) return;
  SkipRow row = bench.row(shared, false, {}, "d1e-6");  // one run of three against three runs
  std::swap(row.with, row.without);
  row.without.seconds *= 3.0, row.without.processor *= 3.0;
  add(row);
  add(bench.replayed());
  add(bench.solid_cells());
}

}  // namespace

BenchRows bench_skip(const BenchArguments& a) {
  const cases::AblationList list = cases::read_ablations(cases::bench_directory() / "skip.toml");
  for (const std::string& name : a.only)
    if (std::none_of(list.scenes.begin(), list.scenes.end(), [&](const auto& s) { return s.name == name; }))
      throw UsageError("there is no scene '" + name + "' in " + (cases::bench_directory() / "skip.toml").string());
  TemporaryFolder place("puffin-bench");
  const Signals signals;
  json rows = json::array();
  const auto add = [&](const SkipRow& row) {
    rows.push_back(to_json(row));
    if (!a.json) print(to_text(row));
  };
  try {
    for (const cases::AblationScene& scene : list.scenes)
      if (a.only.empty() || std::find(a.only.begin(), a.only.end(), scene.name) != a.only.end())
        bench_scene(list, scene, a, place, add);
  } catch (const BenchStopped&) {  // the rows of the scenes before are kept
  }
  return {rows, Signals::code()};
}

}  // namespace puffin::tools
