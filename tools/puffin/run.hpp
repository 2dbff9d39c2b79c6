#pragma once
// `puffin run`: what the command line asked for, and the function that does it.

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "cases/read_case.hpp"

namespace puffin::tools {

struct RunOptions {
  std::filesystem::path case_file;
  std::string preset;                                      // "" as the file says
  std::filesystem::path out;                               // empty: runs/NAME/TIMESTAMP
  int threads = 0;                                         // 0: as the case says
  std::vector<cases::Override> sets;                       // --set
  double until = std::numeric_limits<double>::infinity();  // [s] simulated
  bool resume = false;
  double walltime = std::numeric_limits<double>::infinity();  // [s]
  std::filesystem::path beds;  // settled beds are kept there and taken from there; empty: nowhere
  bool quiet = false;
  bool json = false;   // one JSON object on stdout, nothing else there
  bool report = true;  // report.html at the end
};

/// Runs the case; returns an exit code of the interface (0, 5, 75, 130). Errors are thrown.
int run_command(const RunOptions& options);

}  // namespace puffin::tools
