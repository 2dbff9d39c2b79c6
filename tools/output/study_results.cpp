#include "tools/output/study_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "tools/output/csv_file.hpp"
#include "tools/output/json_fields.hpp"
#include "tools/output/output_folder.hpp"

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

/// The numbers of a study's tables: keys of summary.json.
constexpr std::array<const char*, 28> quantities{"FFE",
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
                                                 "ledger_error",
                                                 "simulated_time",
                                                 "cells_fluid",
                                                 "steps",
                                                 "mlups",
                                                 "memory_peak",
                                                 "wall_clock"};

std::string text(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

/// The summary as the case alone would have written it. `replay`: a file with its own fines, which displace those of
/// the run. RDF is that of the run's first scalar: for another one, and for a replay, it changes by the mass of the
/// fines.
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
  run.summary = summary_of(study / run.folder, run.scalar, replay, described.value("fines_of_dose", 0.0));
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
  for (const std::string name : quantities) {
    std::vector<double> values;
    for (const StudyRun& run : c.runs)
      if (run.summary)
        if (const auto value = find_value(*run.summary, name); value && std::isfinite(*value)) values.push_back(*value);
    if (!values.empty()) c.numbers.emplace_back(name, estimate(values));
  }
  return c;
}

/// comparison.csv: what was measured beside every case of that device.
void write_comparison(const StudyResults& results, const fs::path& study) {
  const fs::path part = study / "comparison.csv.part";
  const auto cell = [](const std::optional<double>& v, double factor) {
    return v ? CsvCell(*v * factor) : CsvCell(std::string());
  };
  {
    CsvFile table(part, {"device", "quantity", "case", "simulation", "ci_low", "ci_high", "replicates", "thesis",
                         "experiment", "standard_deviation", "lowest", "highest", "tests"});
    for (const std::string& quantity : names_of(results.experiments, &Measurement::quantity)) {
      const auto [ours, factor] = counterpart_of(quantity);
      for (const StudyCaseResult& c : results.cases) {
        const Estimate* e = ours.empty() ? nullptr : c.find(ours);
        const Spread s = spread_of(results.experiments, c.device, "", quantity);
        if (!e || s.tests == 0) continue;
        const ReferenceValue* thesis = c.given("thesis", ours);
        table.append({c.device, quantity, c.name, e->mean * factor, cell(e->ci_low, factor), cell(e->ci_high, factor),
                      double(e->n), cell(thesis ? std::optional(thesis->given) : std::nullopt, factor), s.mean,
                      cell(s.deviation, 1.0), s.low, s.high, double(s.tests)});
      }
    }
    table.flush();
  }
  finish_file(part, study / "comparison.csv");
}

}  // namespace

Estimate estimate(const std::vector<double>& values) {
  if (values.empty()) throw std::invalid_argument("no values to take the mean of");
  Estimate e;
  e.n = static_cast<int>(values.size());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  e.low = *low, e.high = *high;
  for (const double v : values) e.mean += v / e.n;
  if (e.n < 2) return e;
  double squares = 0.0;
  for (const double v : values) squares += (v - e.mean) * (v - e.mean);
  const double half = student(e.n - 1) * std::sqrt(squares / (e.n - 1.0) / e.n);
  e.ci_low = e.mean - half, e.ci_high = e.mean + half;
  return e;
}

const Estimate* StudyCaseResult::find(const std::string& quantity) const {
  for (const auto& [key, value] : numbers)
    if (key == quantity) return &value;
  return nullptr;
}

const ReferenceValue* StudyCaseResult::given(const std::string& source, const std::string& quantity) const {
  for (const ReferenceValue& value : reference)
    if (value.name == source + "." + quantity || (source == "thesis" && value.name == quantity)) return &value;
  return nullptr;
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

void write_study_tables(const StudyResults& results, const fs::path& study) {
  const auto cell = [](const std::optional<double>& v) { return v ? CsvCell(*v) : CsvCell(std::string()); };
  CsvFile table(study / "results.csv.part", {"case", "quantity", "mean", "ci_low", "ci_high", "replicates", "lowest",
                                             "highest", "thesis", "experiment", "experiment_low", "experiment_high"});
  CsvFile runs(study / "runs.csv.part", {"case", "run", "scalar", "state", "exit_code", "quantity", "value"});
  for (const StudyCaseResult& c : results.cases) {
    for (const auto& [name, e] : c.numbers) {
      const ReferenceValue* thesis = c.given("thesis", name);
      const ReferenceValue* experiment = c.given("experiment", name);
      table.append({c.name, name, e.mean, cell(e.ci_low), cell(e.ci_high), double(e.n), e.low, e.high,
                    cell(thesis ? std::optional(thesis->given) : std::nullopt),
                    cell(experiment ? std::optional(experiment->given) : std::nullopt),
                    cell(experiment ? experiment->low : std::nullopt),
                    cell(experiment ? experiment->high : std::nullopt)});
    }
    for (const StudyRun& run : c.runs) {
      if (!run.summary) runs.append({c.name, run.folder, run.scalar, run.state, double(run.exit_code), "", ""});
      for (const std::string name : quantities)
        if (const auto value = run.summary ? find_value(*run.summary, name) : std::nullopt)
          runs.append({c.name, run.folder, run.scalar, run.state, double(run.exit_code), name, *value});
    }
  }
  table.flush(), runs.flush();
  finish_file(study / "results.csv.part", study / "results.csv");
  finish_file(study / "runs.csv.part", study / "runs.csv");
  write_whole(study / "results.json", study_results_json(results) + "\n");
  if (results.experiments.empty()) return;
  write_experiments_summary(results.experiments, study);
  write_comparison(results, study);
}

std::pair<std::string, double> counterpart_of(const std::string& measured) {
  if (measured == "FFE" || measured == "RDF") return {measured, 1.0};
  if (measured == "pressure_drop_kPa") return {"total_to_static_drop", 1e-3};
  if (measured == "pressure_drop_Pa") return {"total_to_static_drop", 1.0};
  return {"", 0.0};
}

std::string study_results_json(const StudyResults& results, std::optional<int> exit_code) {
  Json json{{"study", results.name}};
  if (exit_code) json["exit_code"] = *exit_code, json["ok"] = *exit_code == 0;
  Json list = Json::array();
  for (const StudyCaseResult& c : results.cases) {
    Json sets = Json::object(), runs = Json::array(), values = Json::object(), given = Json::object();
    for (const auto& [key, value] : c.sets) sets[key] = value;
    bool done = !c.runs.empty(), failed = false;
    for (const StudyRun& run : c.runs) {
      done = done && run.state == "done";
      failed = failed || run.state == "failed";
      runs.push_back({{"run", run.folder},
                      {"scalar", run.scalar},
                      {"state", run.state},
                      {"exit_code", run.exit_code},
                      {"message", run.message}});
    }
    for (const auto& [name, e] : c.numbers)
      values[name] = {{"mean", number(e.mean)}, {"ci_low", number(e.ci_low)}, {"ci_high", number(e.ci_high)},
                      {"replicates", e.n},      {"lowest", number(e.low)},    {"highest", number(e.high)}};
    for (const ReferenceValue& r : c.reference) given[r.name] = number(r.given);
    list.push_back({{"name", c.name},
                    {"state", failed ? "failed"
                              : done ? "finished"
                                     : "unfinished"},
                    {"set", sets},
                    {"runs", runs},
                    {"results", values},
                    {"reference", given}});
  }
  json["cases"] = list;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace puffin::output
