#include "tools/output/study_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "tools/output/json_fields.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

/// t(0.975, nu) of Student's distribution, nu = 1 ... 30; then 1.96 + 2.4/nu (within 0.001).
/// Source: Abramowitz & Stegun, Handbook of Mathematical Functions (1964), table 26.10.
double student(int nu) {
  constexpr std::array<double, 30> table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                         2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
                                         2.080,  2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
  return nu <= 30 ? table[static_cast<std::size_t>(nu - 1)] : 1.96 + 2.4 / nu;
}

std::string text(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

/// Takes what a run says of its micro-models out, and puts in those that its contacts were replayed with: their label
/// and source (which replays of earlier programs do not hold), and the file that the study keeps of them.
void tell_replayed_laws(Summary& s, const fs::path& replay) {
  const auto of_run = [](const std::string& text) {
    return text.starts_with("micro-models: ") || text.starts_with("fines.micromodels: ");
  };
  std::erase_if(s.assumptions, of_run);
  std::erase_if(s.warnings, of_run);  // impacts faster than the run's laws were made for
  const Json json = read_json(replay);
  const std::string label = text(json, "label"), source = text(json, "source");
  s.assumptions.push_back("micro-models: " + (label.empty() ? "" : label + ": ") +
                          (source.empty() ? "" : source + "; ") + "replayed from the contacts of another set's run (" +
                          fs::path(replay).replace_extension(".toml").filename().string() + ")");
}

/// The summary as the case alone would have written it. `replay`: a file with its own fines, which displace those of
/// the run, as its laws do. RDF is that of the run's first scalar: for another one, and for a replay, it changes by the
/// mass of the fines.
std::optional<Summary> summary_of(const fs::path& run, const std::string& scalar, const std::string& replay,
                                  double fines_of_dose) {
  if (!fs::exists(run / "summary.json") || (!replay.empty() && !fs::exists(run / replay))) return {};
  Summary s = read_summary(run / "summary.json");
  const auto keep_own = [&](std::vector<FinesSummary>& fines) {
    if (!scalar.empty()) std::erase_if(fines, [&](const FinesSummary& f) { return f.name != scalar; });
  };
  const auto left_inside = [](const FinesSummary& f) { return f.FFW + f.FFCR; };
  const double of_first = s.fines.empty() ? 0.0 : left_inside(s.fines[0]);
  keep_own(s.fines);
  if (s.carriers && s.carriers->RDF && !s.fines.empty())
    *s.carriers->RDF += fines_of_dose * (left_inside(s.fines[0]) - of_first);
  if (replay.empty()) return s;
  std::vector<FinesSummary> fines = read_fines(run / replay);
  keep_own(fines);
  if (s.carriers && s.carriers->RDF && !s.fines.empty() && !fines.empty())
    *s.carriers->RDF += fines_of_dose * (left_inside(fines[0]) - left_inside(s.fines[0]));
  s.fines = fines;
  tell_replayed_laws(s, run / replay);
  return s;
}

StudyRun run_of(const Json& described, const Json& jobs, const fs::path& study) {
  StudyRun run;
  run.folder = text(described, "job");
  run.scalar = text(described, "scalar");
  for (const Json& job : jobs)
    if (text(job, "id") == run.folder) {
      run.state = text(job, "state");
      run.message = text(job, "message");
      run.exit_code = job.value("exit_code", 0);
    }
  if (run.state != "done") return run;
  const std::string replay = text(described, "replay");
  try {
    run.summary = summary_of(study / run.folder, run.scalar, replay, described.value("fines_of_dose", 0.0));
  } catch (const OutputError& e) {  // damaged: it alone has failed
    run.state = "failed", run.exit_code = 7, run.message = e.what();
    return run;
  }
  if (!run.summary && !replay.empty())
    run.state = "failed", run.exit_code = 7, run.message = "its fines could not be replayed from this run";
  return run;
}

ReferenceValue reference_of(const std::string& name, const Json& value) {
  if (value.is_number()) return {name, value.get<double>(), {}, {}};
  const std::vector<double> list = value.is_array() ? numbers(value) : std::vector<double>{};
  if (list.size() != 3) return {name, std::nan(""), {}, {}};
  return {name, list[0], list[1], list[2]};
}

/// Where replicates give none: a mean over time has the interval of its run, from batch means.
void take_interval_of_run(const StudyCaseResult& c, const std::string& quantity, Estimate& e) {
  const auto run = std::find_if(c.runs.begin(), c.runs.end(), [](const StudyRun& r) { return r.summary.has_value(); });
  if (run == c.runs.end() || !run->summary->pressure) return;
  const PressureSummary& p = *run->summary->pressure;
  const TimeMean* mean = quantity == "static_drop"            ? &p.static_drop
                         : quantity == "total_to_static_drop" ? &p.total_to_static_drop
                         : quantity == "flow_rate"            ? &p.flow_rate
                                                              : nullptr;
  if (!mean || !mean->ci_low || !mean->ci_high) return;
  e.ci_low = mean->ci_low, e.ci_high = mean->ci_high, e.interval = "batches";
}

StudyCaseResult case_of(const Json& described, const Json& jobs, const fs::path& study) {
  StudyCaseResult c;
  c.name = text(described, "name");
  c.device = text(described, "device");
  for (const auto& [key, value] : part(described, "set").items())
    if (value.is_string()) c.sets.emplace_back(key, value.get<std::string>());
  for (const auto& [key, value] : part(described, "reference").items()) {
    const ReferenceValue given = reference_of(key, value);
    if (std::isfinite(given.given)) c.reference.push_back(given);
  }
  for (const Json& run : part(described, "runs")) c.runs.push_back(run_of(run, jobs, study));
  for (const std::string& name : study_quantities()) {
    std::vector<double> values;
    for (const StudyRun& run : c.runs)
      if (run.summary)
        if (const auto value = find_value(*run.summary, name); value && std::isfinite(*value)) values.push_back(*value);
    if (values.empty()) continue;
    c.numbers.emplace_back(name, estimate(values));
    if (c.numbers.back().second.interval.empty()) take_interval_of_run(c, name, c.numbers.back().second);
  }
  return c;
}

}  // namespace

const std::vector<std::string>& study_quantities() {
  static const std::vector<std::string> names{"FFE",
                                              "FFW",
                                              "FFCR",
                                              "FFCE",
                                              "in_air",
                                              "RDF",
                                              "retained_fraction",
                                              "by_mechanism.wall",
                                              "by_mechanism.particle",
                                              "by_mechanism.drag",
                                              "first_motion",
                                              "first_emitted",
                                              "last_emitted",
                                              "collisions.wall",
                                              "collisions.particle",
                                              "median_per_carrier",
                                              "median_per_emitted_carrier",
                                              "mean_wall_energy",
                                              "mean_particle_energy",
                                              "static_drop",
                                              "total_to_static_drop",
                                              "flow_rate",
                                              "ledger_error",
                                              "simulated_time",
                                              "cells_fluid",
                                              "steps",
                                              "mlups",
                                              "memory_peak",
                                              "wall_clock"};
  return names;
}

Estimate estimate(const std::vector<double>& values) {
  if (values.empty()) throw std::invalid_argument("no values to take the mean of");
  Estimate e;
  e.n = static_cast<int>(values.size());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  e.low = *low, e.high = *high;
  for (const double v : values) e.mean += v / e.n;
  if (e.n < 2 || e.low == e.high) return e;
  double squares = 0.0;
  for (const double v : values) squares += (v - e.mean) * (v - e.mean);
  const double half = student(e.n - 1) * std::sqrt(squares / (e.n - 1.0) / e.n);
  e.ci_low = e.mean - half, e.ci_high = e.mean + half, e.interval = "replicates";
  return e;
}

const Estimate* StudyCaseResult::find(const std::string& quantity) const {
  for (const auto& [key, value] : numbers)
    if (key == quantity) return &value;
  return nullptr;
}

const ReferenceValue* StudyCaseResult::given(const std::string& source, const std::string& quantity) const {
  for (const ReferenceValue& value : reference)
    if (source_of(value.name) == std::pair(source, quantity)) return &value;
  return nullptr;
}

bool StudyCaseResult::gives(const std::string& source) const {
  return std::any_of(reference.begin(), reference.end(),
                     [&](const ReferenceValue& value) { return source_of(value.name).first == source; });
}

StudyResults read_study_results(const fs::path& study) try {
  const Json json = read_json(study / "study.json");
  StudyResults results;
  results.name = fs::path(text(json, "study")).stem().string();
  if (fs::exists(study / "experiments.csv")) results.experiments = read_experiments(study / "experiments.csv");
  for (const Json& c : part(json, "cases")) results.cases.push_back(case_of(c, part(json, "jobs"), study));
  return results;
} catch (const nlohmann::json::exception& e) {
  throw OutputError((study / "study.json").string() + " is damaged: " + e.what());
}

}  // namespace puffin::output
