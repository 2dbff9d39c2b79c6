#pragma once
// Rows of `puffin bench pareto`, as text, JSON and figure.

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace puffin::tools {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// One setting of one case. A number that a run did not come to is NaN, so that none that failed passes for the best:
/// `nan` in CSV, null in JSON.
struct ParetoRow {
  std::string case_id, axis, setting, metric;
  std::string outcome = "not run";  // ok | diverged | exit N | no value
  std::string problem;
  bool is_default = false, on_front = false;
  int repeats = 0;
  double cost = 0.0;  // [s] what the front weighs: seconds or processor_seconds
  double seconds = 0.0, seconds_min = 0.0, seconds_max = 0.0;  // wall-clock of the process: median and range
  double processor_seconds = 0.0;                              // of all threads: median
  std::map<std::string, double> phases;                        // [s]
  double cells = not_known, steps = not_known, cell_updates = not_known;
  double memory_peak = not_known;                   // [byte]
  double value = not_known, reference = not_known;  // in the metric's unit
  double value_spread = not_known;                  // half of what the variants of the case differ by
  double value_half_width = not_known, reference_uncertainty = not_known;  // likewise
  double error = not_known;                    // distance of value from reference, over it where the check is relative
  double error_half_width = not_known;         // both widths together, on the error's scale: its bar
  double time_over_front = not_known;          // run time over the fastest that is no less accurate
  double time_over_front_certain = not_known;  // the same, of those that are more accurate beyond both bars
  // What the front has at the cost of this setting: its most accurate setting that takes no longer.
  std::string front_setting;
  double front_error = not_known, error_over_front = not_known;
  double error_over_front_by_updates = not_known;  // the same at equal cell updates, which go as dx^-4/lattice_speed
  double foreign_load = 0.0;
};

/// How a setting is called in tables: its axis and label.
std::string name_of(const ParetoRow& row);

/// Three significant digits.
std::string short_text(double value);
std::string to_text(const ParetoRow& row, double seconds);
nlohmann::json to_json(const ParetoRow& row);
/// The front of a case from fast to accurate: for this error, this setting, this time; where the default stands; then
/// for each setting that is beaten what its cost buys at best.
std::string front_text(const std::vector<ParetoRow>& rows);
/// FOLDER/pareto-ID.svg: run time, or processor time, against error, the front as stairs, the default with a ring.
void write_figure(const std::vector<ParetoRow>& rows, const std::string& title, bool by_processor,
                  const std::string& folder);

}  // namespace puffin::tools
