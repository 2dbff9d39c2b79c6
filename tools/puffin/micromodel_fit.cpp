// puffin micromodel fit: a law from a table of fractions, or (--calibrate) constants from the outcome of whole runs.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cases/micromodel_file.hpp"
#include "cases/search_path.hpp"
#include "cases/table_file.hpp"
#include "cases/write_micromodels.hpp"
#include "micromodels/continuity.hpp"
#include "micromodels/derivation/fit_law.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/calibrate.hpp"
#include "tools/puffin/console.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/law_plot.hpp"
#include "tools/puffin/micromodel.hpp"

namespace puffin::tools {
namespace {

using micromodels::derivation::Estimate;
using micromodels::derivation::Point;
using nlohmann::json;

struct FitArguments {
  std::vector<std::filesystem::path> inputs;
  std::string law = "power", mechanism = "wall_detach", plot;
  std::filesystem::path out, start;
  double mass = 2.84e-10, energy = 0.0;
  bool unit_limit = false, calibrate = false, as_json = false;
  std::vector<std::string> constants, targets;
};

json to_json(const Estimate& e) {
  const auto finite = [](double x) { return std::isfinite(x) ? json(x) : json(); };
  return {{"value", e.value}, {"low", finite(e.low)}, {"high", finite(e.high)}};
}

std::string text_of(const std::string& name, const Estimate& e) {
  char line[120];
  std::snprintf(line, sizeof line, "%-24s %12.6g   95 %%: %.6g to %.6g", name.c_str(), e.value, e.low, e.high);
  return line;
}

std::vector<Point> read_points(const std::filesystem::path& file) {
  const cases::Columns columns = cases::read_columns(file.string(), {"speed", "fraction"});
  const auto& speed = columns.at("speed");
  const auto& fraction = columns.at("fraction");
  const auto error = columns.find("error");
  std::vector<Point> points;
  for (std::size_t k = 0; k < speed.size(); ++k)
    points.push_back({speed[k], fraction[k], error == columns.end() ? 1.0 : error->second[k]});
  std::sort(points.begin(), points.end(), [](const Point& x, const Point& y) { return x.speed < y.speed; });
  std::erase_if(points, [](const Point& p) { return p.speed == 0.0 && p.fraction == 0.0; });  // says nothing
  return points;
}

void write_result(const FitArguments& a, const micromodels::FinesModels& models, const std::string& comment,
                  const std::vector<output::Curve>& data) {
  if (!a.out.empty()) output::write_whole(a.out, cases::write_micromodels(models, {{"", comment}}));
  if (a.plot.empty()) return;
  auto curves = law_curves(models, data.empty() ? plot_range(models) : data.front().x.back());
  curves.insert(curves.end(), data.begin(), data.end());
  write_svg(a.plot, {"impact speed [m/s]", "fraction of the initial fines", curves, {}});
}

int fit_table(const FitArguments& a) {
  for (const auto& input : a.inputs)
    if (std::filesystem::is_directory(input))
      throw UsageError("fit: " + input.string() +
                       " is a folder, not a table; with --calibrate constants are fitted to the outcome of runs");
  if (a.inputs.size() != 1) throw UsageError("fit: give one table (or --calibrate for runs)");
  const std::vector<Point> points = read_points(a.inputs.front());
  micromodels::FinesModels models;
  models.label = micromodels::Label::given;
  models.source = "fit to " + a.inputs.front().filename().string();
  const micromodels::Validity valid{0.0, points.empty() ? 0.0 : points.back().speed};
  std::vector<std::pair<std::string, Estimate>> constants;
  double rms = 0.0;
  std::optional<micromodels::Law> law;
  if (a.law == "power") {
    const auto fit = micromodels::derivation::fit_power(points);
    for (std::size_t k = 0; k < 5; ++k) constants.emplace_back("A" + std::to_string(k), fit.A[k]);
    rms = fit.rms;
    law = micromodels::PowerLaw(fit.law().constants(), valid);
  } else {
    const double energy = a.energy > 0.0 ? a.energy : 0.5 * a.mass;
    const auto fit = micromodels::derivation::fit_weibull(points, a.mass, energy, a.unit_limit);
    constants = {{"limit", fit.limit}, {"energy_ratio", fit.energy_ratio}, {"shape", fit.shape}};
    rms = fit.rms;
    law = micromodels::WeibullLaw(fit.law().constants(), valid);
  }
  if (a.mechanism == "wall_detach") models.wall_detach = law;
  if (a.mechanism == "wall_attach") models.wall_attach = law;
  if (a.mechanism == "particle_detach") models.particle_detach = law;
  if (a.mechanism == "drag_detach") models.drag_detach = law;
  micromodels::check(models);
  const micromodels::Jump jump = micromodels::jump(*law);
  std::string comment =
      "Fitted to " + a.inputs.front().filename().string() + ", " + std::to_string(points.size()) + " points.";
  for (const auto& [name, e] : constants) comment += '\n' + text_of(name, e);
  output::Curve data{"data", {}, {}};
  for (const Point& p : points) data.x.push_back(p.speed), data.y.push_back(p.fraction);
  write_result(a, models, comment, {data});
  if (a.as_json) {
    json j{{"law", a.law},
           {"points", points.size()},
           {"rms", rms},
           {"jump", {{"speed", jump.speed}, {"height", jump.height}}}};
    for (const auto& [name, e] : constants) j["constants"][name] = to_json(e);
    if (a.law == "power")
      for (const auto& [name, e] : constants) j["A"].push_back(e.value);
    print(j.dump(2));
    return ok;
  }
  print(a.law + " law, " + std::to_string(points.size()) + " points, rms misfit " + four_digits(rms) +
        " in units of the errors");
  for (const auto& [name, e] : constants) print(text_of(name, e));
  if (jump.height != 0.0) print("jumps by " + four_digits(jump.height) + " at " + four_digits(jump.speed) + " m/s");
  return ok;
}

/// Targets are parts of one dose: each in 0..1, and those of a run at most 1 together.
void check_targets(const FitArguments& a, const std::vector<Target>& targets) {
  std::map<std::size_t, double> sums;
  for (const Target& t : targets) {
    const std::string what = "fit --calibrate: the target " + t.quantity + " = " + four_digits(t.value);
    if (!(t.value >= 0.0 && t.value <= 1.0)) throw UsageError(what + " is no part of the dose; it must be in 0..1");
    sums[t.run] += t.value;
  }
  for (const auto& [run, sum] : sums)
    if (sum > 1.0 + 1e-9)  // rounding
      throw UsageError("fit --calibrate: the targets of " + a.inputs[run].string() + " sum to " + four_digits(sum) +
                       "; parts of one dose are at most 1 together");
}

/// The number that is the whole text.
double number_of(const std::string& text) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != text.size()) throw std::invalid_argument("'" + text + "' is no number");
  return value;
}

/// [run:]NAME=VALUE; a run by its place on the command line, from 1; without one: every run.
std::vector<Target> read_targets(const FitArguments& a) {
  std::vector<Target> targets;
  for (const std::string& text : a.targets) try {
      const auto equals = text.find('='), colon = text.find(':');
      if (equals == std::string::npos) throw std::invalid_argument("no '='");
      const bool one = colon != std::string::npos && colon < equals;
      const std::string quantity = text.substr(one ? colon + 1 : 0, equals - (one ? colon + 1 : 0));
      const double value = number_of(text.substr(equals + 1));
      const std::size_t run = one ? std::stoul(text.substr(0, colon)) : 0;
      if (one && (run < 1 || run > a.inputs.size())) throw std::invalid_argument("no such run");
      for (std::size_t r = 0; r < a.inputs.size(); ++r)
        if (!one || r + 1 == run) targets.push_back({r, quantity, value, 0.0});
    } catch (const std::logic_error& e) {
      throw UsageError("--target " + text + ": " + e.what() + "; write FFE=0.67, or 2:FFE=0.78 for the second run");
    }
  if (!targets.empty()) return targets;
  for (std::size_t r = 0; r < a.inputs.size(); ++r)  // what the cases refer to
    for (const auto& row : output::read_summary(a.inputs[r] / "summary.json").reference)
      if (row.name == "FFE" || row.name == "FFW" || row.name == "FFCR" || row.name == "FFCE")
        targets.push_back({r, row.name, row.given, 0.0});
  return targets;
}

/// What the fit did not reach, and that it stopped where a constant may go no farther.
std::vector<std::string> misses(const FitArguments& a, const Calibration& result) {
  constexpr double noticed = 1e-3;  // of the dose; a fit that meets its targets misses by rounding
  std::vector<std::string> texts;
  for (const Target& t : result.targets)
    if (!(std::abs(t.ours - t.value) <= noticed))
      texts.push_back("the target " + t.quantity + " = " + four_digits(t.value) + " of " + a.inputs[t.run].string() +
                      " is not met: " + four_digits(t.ours) + " is the nearest that was found, a miss of " +
                      four_digits(t.ours - t.value));
  if (texts.empty()) return texts;
  for (const FreeConstant& c : result.constants)
    if (c.at_end_of_reach)
      texts.push_back(c.name + " stopped at " + four_digits(c.estimate.value) + ", where it may go no farther");
  return texts;
}

int calibrate_runs(const FitArguments& a) {
  if (a.inputs.empty() || a.start.empty())
    throw UsageError("fit --calibrate: give run folders and --micromodels, the start");
  const std::vector<Target> targets = read_targets(a);
  check_targets(a, targets);
  std::vector<StoredRun> runs;
  for (const auto& folder : a.inputs) runs.push_back(read_stored_run(folder));
  const auto start = cases::read_micromodels(cases::found_micromodels(a.start));
  Calibration result;
  try {
    result = calibrate(start, runs, targets, a.constants);
  } catch (const std::invalid_argument& e) {
    throw UsageError(std::string("fit --calibrate: ") + e.what());
  }
  result.models.source = "calibrated on " + std::to_string(runs.size()) + " run(s) from " + a.start.filename().string();
  std::string comment = "Calibrated from " + a.start.filename().string() + " by replay.";
  for (const auto& c : result.constants) comment += '\n' + text_of(c.name, c.estimate);
  for (const auto& t : result.targets)
    comment += '\n' + a.inputs[t.run].filename().string() + " " + t.quantity + ": target " + four_digits(t.value) +
               ", fitted " + four_digits(t.ours);
  const std::vector<std::string> warnings = misses(a, result);
  for (const std::string& warning : warnings) log_warning(warning);
  write_result(a, result.models, comment, {});
  if (a.as_json) {
    json j{{"rms", result.rms}, {"constants", json::object()}, {"targets", json::array()}, {"warnings", warnings}};
    for (const auto& c : result.constants) j["constants"][c.name] = to_json(c.estimate);
    for (const auto& t : result.targets)
      j["targets"].push_back({{"run", a.inputs[t.run].string()},
                              {"quantity", t.quantity},
                              {"target", t.value},
                              {"fitted", t.ours},
                              {"miss", t.ours - t.value}});
    print(j.dump(2));
    return ok;
  }
  for (const auto& c : result.constants) print(text_of(c.name, c.estimate));
  for (const auto& t : result.targets)
    print(a.inputs[t.run].string() + ": " + t.quantity + " target " + four_digits(t.value) + ", fitted " +
          four_digits(t.ours) + ", miss " + four_digits(t.ours - t.value));
  return ok;
}

}  // namespace

Action micromodel_fit(CLI::App& app) {
  auto a = std::make_shared<FitArguments>();
  app.add_option("input", a->inputs, "a table with the columns speed, fraction and, if wanted, error; or run folders")
      ->required()
      ->type_name("TABLE.csv|RUNDIR...");
  app.add_option("--law", a->law, "power or weibull")->check(CLI::IsMember({"power", "weibull"}));
  app.add_option("--mechanism", a->mechanism, "the table of the file that is written")
      ->check(CLI::IsMember({"wall_detach", "wall_attach", "particle_detach", "drag_detach"}));
  app.add_option("--carrier-mass", a->mass, "weibull: of the coated carrier [kg]")->check(CLI::PositiveNumber);
  app.add_option("--adhesion-energy", a->energy,
                 "weibull: parts all fines from a carrier [J]; without it energy_ratio "
                 "is the square of the speed")
      ->check(CLI::PositiveNumber);
  app.add_flag("--unit-limit", a->unit_limit, "weibull: all fines come off in the limit");
  app.add_flag("--calibrate", a->calibrate, "fit constants to the outcome of runs, through replay");
  app.add_option("--micromodels", a->start, "calibrate: the laws to start from")->type_name("FILE.toml");
  app.add_option("--free", a->constants, "calibrate: a constant to fit, as wall_detach.A0, wall_attach.scale; repeat")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  app.add_option("--target", a->targets, "calibrate: [run:]FFE=0.67; repeat; without it the runs' own [reference]")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  app.add_option("--out", a->out, "the micro-model file")->type_name("FILE.toml");
  app.add_option("--plot", a->plot, "a plot of law and data")->type_name("FILE.svg");
  app.add_flag("--json", a->as_json, "one JSON object on stdout");
  return [a] {
    if (a->calibrate) return calibrate_runs(*a);
    try {
      return fit_table(*a);
    } catch (const std::invalid_argument& e) {
      throw UsageError(std::string("fit: ") + e.what());
    }
  };
}

}  // namespace puffin::tools
