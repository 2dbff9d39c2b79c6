// puffin bench stability: scenes that try to blow up, over settings and speeds; what ran, what was healed, what
// diverged.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "cases/search_path.hpp"
#include "cases/spelling.hpp"
#include "tools/output/csv_file.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/bench/benches.hpp"
#include "tools/puffin/bench/stability_envelope.hpp"
#include "tools/puffin/bench/stability_map.hpp"
#include "tools/puffin/bench/stability_plan.hpp"
#include "tools/puffin/bench/stability_shapes.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/run.hpp"
#include "tools/puffin/signals.hpp"

namespace puffin::tools {
namespace {

using nlohmann::json;

/// Scenes and runs in a temporary folder; gone at the end.
class Workshop {
 public:
  explicit Workshop(const std::filesystem::path& scenes)
      : path_(std::filesystem::temp_directory_path() /
              ("puffin-stability-" + std::to_string(static_cast<long>(getpid())))) {
    std::filesystem::create_directories(path_);
    for (const auto& entry : std::filesystem::directory_iterator(scenes))
      if (entry.path().extension() == ".toml")
        std::filesystem::copy_file(entry.path(), path_ / entry.path().filename(),
                                   std::filesystem::copy_options::overwrite_existing);
    write_stability_shapes(path_);
  }
  ~Workshop() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  std::filesystem::path scene(const std::string& name) const { return path_ / (name + ".toml"); }
  std::filesystem::path fresh_run() const {
    std::filesystem::remove_all(path_ / "run");
    return path_ / "run";
  }

 private:
  std::filesystem::path path_;
};

/// A message as a field of a CSV.
std::string plain(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Change of the pressure drop between the second and the last quarter of a run [1], and its standard error from
/// batches of a tenth: what a million steps of rounding would do to it. NaN without openings.
std::array<double, 2> drift_of(const std::filesystem::path& run) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> drop;
  try {
    drop = output::read_csv(run / "history.csv").numbers("static_drop");
  } catch (const std::exception&) {
    return {none, none};
  }
  const std::size_t n = drop.size();
  if (n < 80 || !std::isfinite(drop.back())) return {none, none};
  const auto mean = [&](std::size_t first, std::size_t count) {
    double sum = 0.0;
    for (std::size_t k = first; k < first + count; ++k) sum += drop[k];
    return sum / static_cast<double>(count);
  };
  const auto quarter = [&](std::size_t first) {
    const std::size_t batch = n / 40;
    double m = mean(first, 10 * batch), square = 0.0;
    for (std::size_t b = 0; b < 10; ++b) square += std::pow(mean(first + b * batch, batch) - m, 2);
    return std::array{m, square / 90.0};
  };
  const auto early = quarter(n / 4), late = quarter(3 * n / 4);
  return {late[0] / early[0] - 1.0, std::sqrt(early[1] + late[1]) / std::abs(early[0])};
}

json make_row(const StabilityTrial& trial, const Workshop& place) {
  json row{{"scene", trial.scene->name},
           {"variation", trial.variation->name},
           {"u_lb", trial.speed},
           {"cells", 0},
           {"steps", 0},
           {"outcome", "refused"},
           {"why", ""},
           {"seconds", 0.0},
           {"retreats", 0},
           {"limited", 0.0},
           {"backflow", 0},
           {"mach_max", 0.0},
           {"tau_min", 0.0},
           {"drift", nullptr},
           {"drift_error", nullptr}};
  RunOptions options;
  options.case_file = place.scene(trial.scene->name);
  for (const std::string& set : trial.sets) options.sets.push_back(cases::parse_override(set));
  options.out = place.fresh_run();
  options.quiet = true;
  options.report = false;
  try {
    const int code = run_command(options);
    if (code == interrupted || code == stopped) return row;
    std::ifstream in(options.out / "summary.json");
    const json summary = json::parse(in);
    auto warnings = summary.value("warnings", std::vector<std::string>());  // of them only the retreats
    std::erase_if(warnings, [](const std::string& text) { return text.find("retreat ") == std::string::npos; });
    row["outcome"] = code == diverged ? "diverged" : (warnings.empty() ? "ok" : "healed");
    row["why"] = plain(code == diverged ? summary.value("message", "") : (warnings.empty() ? "" : warnings.front()));
    row["retreats"] = warnings.size();
    row["cells"] = summary["cells_fluid"];
    row["steps"] = summary["steps"];
    row["seconds"] = summary["wall_clock"];
    const double updates = summary["cells_fluid"].get<double>() * summary["steps"].get<double>();
    row["limited"] = updates > 0.0 ? summary["limited"].get<double>() / updates : 0.0;
    row["backflow"] = summary["backflow"];
    row["mach_max"] = summary["mach_max"];
    row["tau_min"] = summary["tau_min"];
    if (const auto drift = drift_of(options.out); code == ok && std::isfinite(drift[0])) {
      row["drift"] = drift[0];
      row["drift_error"] = drift[1];
    }
  } catch (const std::exception& e) {
    row["why"] = plain(e.what());
  }
  set_up_log(false);  // the runs are quiet
  return row;
}

void check_names(const StabilityPlan& plan, const std::vector<std::string>& only) {
  std::vector<std::string> names;
  for (const StabilityScene& scene : plan.scenes) names.push_back(scene.name);
  for (const std::string& name : only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError("there is no scene '" + name + "'; the scenes are " + cases::join(names));
}

}  // namespace

BenchRows bench_stability(const BenchArguments& a) {
  const std::filesystem::path folder = cases::stability_directory();
  const StabilityPlan plan = read_stability_plan(folder / "stability.toml");
  check_names(plan, a.only);
  const Signals signals;
  const Workshop place(folder);
  json rows = json::array();
  bool whole = !a.quick && a.only.empty();
  if (!a.json) print("scene                variation         u_lb     steps   seconds  outcome");
  for (const StabilityTrial& trial : trials_of(plan, a.quick)) {
    if (!a.only.empty() && std::find(a.only.begin(), a.only.end(), trial.scene->name) == a.only.end()) continue;
    const json made = make_row(trial, place);
    if (Signals::received() != 0) {  // this run was cut short
      whole = false;
      break;
    }
    rows.push_back(made);
    if (a.json) continue;
    const json& row = rows.back();
    char line[160];
    std::snprintf(line, sizeof line, "%-20s %-16s %5.2f %9lld %9.1f  %s%s", trial.scene->name.c_str(),
                  trial.variation->name.c_str(), trial.speed, static_cast<long long>(row["steps"].get<std::int64_t>()),
                  row["seconds"].get<double>(), row["outcome"].get<std::string>().c_str(),
                  row["why"].get<std::string>().empty() ? "" : ": ");
    print(line + row["why"].get<std::string>().substr(0, 100));
  }
  if (!a.out.empty()) {
    const std::filesystem::path out(a.out);
    output::write_whole(out / "stability.svg", stability_map(rows));
    if (whole) output::write_whole(out / "envelope.toml", cases::write_envelope(envelope_of(plan, folder, rows)));
  }
  return {rows, Signals::code()};
}

}  // namespace puffin::tools
