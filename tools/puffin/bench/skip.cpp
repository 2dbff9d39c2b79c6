// puffin bench skip: time with and without each thing that a run leaves out, and what leaving it out does to the
// answer.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

#include "cases/micromodel_file.hpp"
#include "cases/search_path.hpp"
#include "cases/verification/ablation.hpp"
#include "coupling/replay_fines.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/bench/child_run.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/replay_record.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {
namespace {

using cases::Override;
using nlohmann::json;

/// What is compared: shares of the fines and of the carriers, all between 0 and 1.
std::map<std::string, double> answers_of(const cases::RunOutput& output) {
  std::map<std::string, double> answers;
  for (const auto& [key, value] : output.numbers) {
    const std::size_t dot = key.rfind('.');
    const std::string last = dot == std::string::npos ? key : key.substr(dot + 1);
    const bool fines =
        key.starts_with("fines.") && (last == "FFE" || last == "FFW" || last == "FFCR" || last == "FFCE");
    if (fines || key == "carriers.retained_fraction") answers[last] = value;
  }
  return answers;
}

double largest_change(const std::map<std::string, double>& a, const std::map<std::string, double>& b) {
  double most = 0.0;
  for (const auto& [name, value] : a)
    if (const auto other = b.find(name); other != b.end()) most = std::max(most, std::abs(value - other->second));
  return most;
}

struct Measured {
  double seconds = 0.0;
  std::map<std::string, double> answers, numbers;
  std::filesystem::path folder;
};

/// The runs of one scene; that with everything skipped is made once for each of three seeds.
class SceneBench {
 public:
  SceneBench(const cases::AblationScene& scene, bool quick, TemporaryFolder& place)
      : scene_(scene), quick_(quick), place_(place) {
    for (int seed = 1; seed <= replicates; ++seed) base_.push_back(run({{"numerics.seed", std::to_string(seed)}}));
  }

  Measured run(std::vector<Override> sets) {
    if (quick_) sets.insert(sets.begin(), scene_.quick_sets.begin(), scene_.quick_sets.end());
    Measured m;
    m.folder = place_.fresh();
    const ChildRun child = run_child(scene_.case_file, sets, m.folder);
    if (!child.output) throw std::runtime_error("bench skip, scene " + scene_.name + ": " + child.problem);
    m.seconds = child.seconds;
    m.numbers = child.output->numbers;
    m.answers = answers_of(*child.output);
    return m;
  }
  const Measured& base() const { return base_.front(); }

  /// Half the 95 % confidence interval of the mean over the seeds, the widest of all answers. Student's t for two
  /// degrees of freedom: 4.303.
  double confidence() const {
    double most = 0.0;
    for (const auto& [name, unused] : base().answers) {
      double mean = 0.0, square = 0.0;
      for (const Measured& m : base_) mean += m.answers.at(name) / replicates;
      for (const Measured& m : base_) square += std::pow(m.answers.at(name) - mean, 2);
      most = std::max(most, 4.303 * std::sqrt(square / (replicates - 1) / replicates));
    }
    return most;
  }

 private:
  static constexpr int replicates = 3;
  const cases::AblationScene& scene_;
  bool quick_;
  TemporaryFolder& place_;
  std::vector<Measured> base_;
};

struct SkipRow {
  std::string skip, scene;
  bool exact = false;                // claimed
  double with = 0.0, without = 0.0;  // [s] run time with the skip and without
  double change = 0.0;               // largest change of an answer
  double confidence = 0.0;           // half the interval that replicates span
};

json to_json(const SkipRow& r) {
  return {{"skip", r.skip},
          {"scene", r.scene},
          {"exact", r.exact},
          {"seconds_with", r.with},
          {"seconds_without", r.without},
          {"speedup", r.without / r.with},
          {"change", r.change},
          {"confidence", r.confidence},
          {"within", r.exact ? r.change == 0.0 : r.change <= r.confidence}};
}

std::string to_text(const SkipRow& r) {
  char line[200];
  std::snprintf(line, sizeof line, "%-36s %-14s %8.2f %8.2f  %5.2f  %-9.3g %-9.3g %s", r.skip.c_str(), r.scene.c_str(),
                r.with, r.without, r.without / r.with, r.change, r.confidence, r.exact ? "exact" : "approximate");
  return line;
}

/// What the program skips without a switch: cells inside the walls, from the run's own account.
SkipRow solid_cells(const std::string& scene, const Measured& m) {
  SkipRow row{"solid cells (never computed)", scene, true, m.seconds, m.seconds, 0.0, 0.0};
  const auto saved = m.numbers.find("skipped.solid cells of the bounding box.seconds_saved");
  if (saved != m.numbers.end()) row.without += saved->second;
  return row;
}

/// Three scalars in one run against three runs.
SkipRow shared_scalars(SceneBench& bench, const std::string& scene) {
  std::string list;
  for (const char* diffusion : {"1e-6", "1e-5", "1e-4"})
    list += std::string(list.empty() ? "" : ", ") + "{ name = \"d" + diffusion + "\", diffusion = \"" + diffusion +
            " kg/(m s)\" }";
  const Measured shared = bench.run({{"fines.scalar", "[" + list + "]"}});
  SkipRow row{"runs shared by three scalars",
              scene,
              false,
              shared.seconds,
              3.0 * bench.base().seconds,
              0.0,
              bench.confidence()};
  for (const char* share : {"FFW", "FFCR", "FFCE"})
    row.change = std::max(row.change, std::abs(shared.answers.at(share) - bench.base().answers.at(share)));
  return row;
}

/// Other micro-models by replay against a run of their own.
SkipRow replayed(const SceneBench& bench, const std::string& scene) {
  const auto start = std::chrono::steady_clock::now();
  const StoredRun run = read_stored_run(bench.base().folder);
  const auto models = cases::read_micromodels(cases::found_micromodels("lactose-3.6e-3.toml"));
  const auto fines = summaries(coupling::replay(run.record, models), run.scalars);
  SkipRow row{"replay instead of a run",
              scene,
              false,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
              bench.base().seconds,
              0.0,
              1e-9};
  const auto& ours = bench.base().answers;
  row.change = std::max({std::abs(fines.front().FFW - ours.at("FFW")), std::abs(fines.front().FFCR - ours.at("FFCR")),
                         std::abs(fines.front().FFCE - ours.at("FFCE"))});
  return row;
}

/// All rows of a scene.
void bench_scene(const cases::AblationList& list, const cases::AblationScene& scene, bool quick, TemporaryFolder& place,
                 const std::function<void(const SkipRow&)>& add) {
  SceneBench bench(scene, quick, place);
  std::vector<Override> everything;
  for (const cases::Ablation& skip : list.skips) {
    if (skip.scene != scene.name) continue;
    const Measured without = bench.run(skip.off);
    add({skip.name, scene.name, skip.exact, bench.base().seconds, without.seconds,
         largest_change(bench.base().answers, without.answers), bench.confidence()});
    everything.insert(everything.end(), skip.off.begin(), skip.off.end());
  }
  const Measured without = bench.run(everything);
  add({"all of these together", scene.name, false, bench.base().seconds, without.seconds,
       largest_change(bench.base().answers, without.answers), bench.confidence()});
  if (scene.name != list.scenes.front().name) return;
  add(shared_scalars(bench, scene.name));
  add(replayed(bench, scene.name));
  add(solid_cells(scene.name, bench.base()));
}

}  // namespace

BenchRows bench_skip(const BenchArguments& a) {
  const cases::AblationList list = cases::read_ablations(cases::bench_directory() / "skip.toml");
  TemporaryFolder place("puffin-bench");
  const Signals signals;
  json rows = json::array();
  const auto add = [&](const SkipRow& row) {
    rows.push_back(to_json(row));
    if (!a.json) print(to_text(row));
  };
  if (!a.json)
    print("skip                                 scene          with, s  without  ratio  change    confidence");
  try {
    for (const cases::AblationScene& scene : list.scenes) bench_scene(list, scene, a.quick, place, add);
  } catch (const BenchStopped&) {  // the rows so far are kept
  }
  return {rows, Signals::code()};
}

}  // namespace puffin::tools
