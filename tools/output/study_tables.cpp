// The tables of a study: results.csv, runs.csv, results.json, comparison.csv.

#include "tools/output/csv_file.hpp"
#include "tools/output/json_fields.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/output/study_results.hpp"

namespace puffin::output {
namespace {

namespace fs = std::filesystem;

/// As trial() of the first finished run.
std::string trial_of(const StudyCaseResult& c) {
  for (const StudyRun& run : c.runs)
    if (run.summary) return trial(*run.summary);
  return "";
}

/// comparison.csv: what was measured beside every case of that device.
void write_comparison(const StudyResults& results, const fs::path& study) {
  const fs::path part = study / "comparison.csv.part";
  const auto cell = [](const std::optional<double>& v, double factor) {
    return v ? CsvCell(*v * factor) : CsvCell(std::string());
  };
  {
    CsvFile table(
        part, {"device", "quantity", "case", "simulation", "ci_low", "ci_high", "replicates", "thesis", "experiment",
               "standard_deviation", "lowest", "highest", "tests", "reference", "trial", "flow_rate", "interval"});
    for (const std::string& quantity : names_of(results.experiments, &Measurement::quantity)) {
      const auto [ours, factor] = counterpart_of(quantity);
      for (const StudyCaseResult& c : results.cases) {
        const Estimate* e = ours.empty() ? nullptr : c.find(ours);
        const Spread s = spread_of(results.experiments, c.device, "", quantity);
        if (!e || s.tests == 0) continue;
        const ReferenceValue *thesis = c.given("thesis", ours), *plain = c.given("reference", ours);
        const Estimate* flow = is_pressure(ours) ? c.find("flow_rate") : nullptr;
        table.append({c.device, quantity, c.name, e->mean * factor, cell(e->ci_low, factor), cell(e->ci_high, factor),
                      double(e->n), cell(thesis ? std::optional(thesis->given) : std::nullopt, factor), s.mean,
                      cell(s.deviation, 1.0), s.low, s.high, double(s.tests),
                      cell(plain ? std::optional(plain->given) : std::nullopt, factor), trial_of(c),
                      cell(flow ? std::optional(flow->mean) : std::nullopt, 1.0), e->interval});
      }
    }
    table.flush();
  }
  finish_file(part, study / "comparison.csv");
}

}  // namespace

void write_study_tables(const StudyResults& results, const fs::path& study) {
  const auto cell = [](const std::optional<double>& v) { return v ? CsvCell(*v) : CsvCell(std::string()); };
  CsvFile table(study / "results.csv.part",
                {"case", "quantity", "mean", "ci_low", "ci_high", "replicates", "lowest", "highest", "thesis",
                 "experiment", "experiment_low", "experiment_high", "reference", "interval"});
  CsvFile runs(study / "runs.csv.part", {"case", "run", "scalar", "state", "exit_code", "quantity", "value"});
  for (const StudyCaseResult& c : results.cases) {
    for (const auto& [name, e] : c.numbers) {
      const ReferenceValue* thesis = c.given("thesis", name);
      const ReferenceValue *experiment = c.given("experiment", name), *plain = c.given("reference", name);
      table.append({c.name, name, e.mean, cell(e.ci_low), cell(e.ci_high), double(e.n), e.low, e.high,
                    cell(thesis ? std::optional(thesis->given) : std::nullopt),
                    cell(experiment ? std::optional(experiment->given) : std::nullopt),
                    cell(experiment ? experiment->low : std::nullopt),
                    cell(experiment ? experiment->high : std::nullopt),
                    cell(plain ? std::optional(plain->given) : std::nullopt), e.interval});
    }
    for (const StudyRun& run : c.runs) {
      if (!run.summary) runs.append({c.name, run.folder, run.scalar, run.state, double(run.exit_code), "", ""});
      for (const std::string& name : study_quantities())
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

bool is_pressure(const std::string& quantity) { return quantity.ends_with("_drop"); }

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
                      {"replicates", e.n},      {"lowest", number(e.low)},    {"highest", number(e.high)},
                      {"interval", e.interval}};
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
