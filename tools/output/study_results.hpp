#pragma once
// What a study came to: mean and confidence interval of every number over the replicates of each case.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/output/experiments.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {

struct StudyRun {
  std::string folder;  // relative to the study's
  std::string state;   // waiting | running | done | failed | stopped
  int exit_code = 0;
  std::string message;
  std::string scalar;              // of a shared run: the scalar of this case; else ""
  std::optional<Summary> summary;  // of a finished run, `fines` cut to this case's scalar
};

struct Estimate {
  double mean = 0.0, low = 0.0, high = 0.0;  // of the values
  std::optional<double> ci_low, ci_high;     // 95 %
  std::string interval;                      // what of: "replicates" (Student's t), "batches" of one run's time, or ""
  int n = 0;                                 // replicates that have the number
};

struct StudyCaseResult {
  std::string name;
  std::string device;  // the generator, or the name of the STL file
  std::vector<std::pair<std::string, std::string>> sets;
  std::vector<StudyRun> runs;
  std::vector<std::pair<std::string, Estimate>> numbers;  // by quantity
  std::vector<ReferenceValue> reference;
  const Estimate* find(const std::string& quantity) const;
  /// "thesis", "FFE" -> the value of [reference.thesis] FFE; "reference", "FFE" -> that of [reference] FFE.
  const ReferenceValue* given(const std::string& source, const std::string& quantity) const;
  /// Whether it gives any value of that source.
  bool gives(const std::string& source) const;
};

struct StudyResults {
  std::string name;
  std::vector<Measurement> experiments;  // experiments.csv of the study's folder, if the study brings some
  std::vector<StudyCaseResult> cases;
};

/// The numbers of a study's tables: keys of summary.json.
const std::vector<std::string>& study_quantities();

/// Mean and 95 % confidence interval of independent values. One value has no interval, nor have values that are all
/// equal: their seeds have changed nothing. Throws std::invalid_argument without any.
Estimate estimate(const std::vector<double>& values);

/// Reads study.json and the summaries of its finished runs. Throws OutputError if study.json is missing or damaged.
StudyResults read_study_results(const std::filesystem::path& study);
/// results.csv (a row a case and quantity), runs.csv (a row a run) and results.json; with experiments also
/// experiments-summary.csv and comparison.csv (a row a device, quantity and case).
void write_study_tables(const StudyResults& results, const std::filesystem::path& study);
/// Which number of a run a measured quantity is compared with, and the factor from SI to the unit in its name:
/// "pressure_drop_kPa" -> {"total_to_static_drop", 1e-3}. {"", 0} if runs have no such number.
std::pair<std::string, double> counterpart_of(const std::string& measured);
/// Whether a number of a run is a pressure drop, which is of its flow rate.
bool is_pressure(const std::string& quantity);
std::string study_results_json(const StudyResults& results, std::optional<int> exit_code = {});

}  // namespace puffin::output
