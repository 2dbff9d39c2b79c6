#pragma once
// Sections of a run's page that are charts of its history and of where its fines ended.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/output/csv_file.hpp"
#include "tools/output/summary.hpp"

namespace puffin::output {

/// What a run's page is made from.
struct RunResults {
  std::filesystem::path folder;
  Summary summary;
  CsvTable history;

  std::vector<double> column(const std::string& name, double factor = 1.0) const {
    std::vector<double> values = history.numbers(name);
    for (double& value : values) value *= factor;
    return values;
  }
};

/// " of NAME, the first of 2 scalars" where there are several; "" where there is nothing to tell apart.
std::string of_first_scalar(const Summary& summary);
/// Carriers and fines over time.
std::string emission_section(const RunResults& run);
/// Flow rate and pressure drops over time, and their means.
std::string flow_section(const RunResults& run);
/// Where the fines ended, beside the given values.
std::string outcome_section(const RunResults& run);

}  // namespace puffin::output
