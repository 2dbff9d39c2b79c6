#pragma once
// Rows of `puffin bench pareto`, as text, JSON and figure.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace puffin::tools {

/// One setting of one case. Errors and widths are relative or absolute as the check of the case says.
struct ParetoRow {
  std::string case_id, axis, setting, metric;
  std::string outcome = "not run";  // ok | diverged | exit N | no value
  std::string problem;
  bool is_default = false, on_front = false;
  int repeats = 0;
  double seconds = 0.0, seconds_min = 0.0, seconds_max = 0.0;  // wall-clock of the process: median and range
  std::map<std::string, double> phases;                        // [s]
  double cells = 0.0, steps = 0.0, cell_updates = 0.0;
  double memory_peak = 0.0;  // [byte]
  double value = 0.0, reference = 0.0, error = 0.0;
  double value_half_width = 0.0, reference_uncertainty = 0.0;
  double time_over_front = 0.0;          // run time over the fastest that is no less accurate
  double time_over_front_certain = 0.0;  // the same, of those that are more accurate beyond both uncertainties
  double foreign_load = 0.0;
};

/// Three significant digits.
std::string short_text(double value);
std::string to_text(const ParetoRow& row, double seconds);
nlohmann::json to_json(const ParetoRow& row);
/// The front of a case from fast to accurate: for this error, this setting, this time; then where the default stands.
std::string front_text(const std::vector<ParetoRow>& rows);
/// FOLDER/pareto-ID.svg: run time against error, the front as stairs, the default with a ring.
void write_figure(const std::vector<ParetoRow>& rows, const std::string& title, const std::string& folder);

}  // namespace puffin::tools
