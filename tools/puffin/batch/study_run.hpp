#pragma once
// The runs of a study, started, watched and booked.

#include "tools/puffin/batch/book.hpp"

namespace puffin::tools {

struct BatchOptions {
  std::filesystem::path study, out;  // out empty: studies/NAME
  int jobs = 0;                      // runs at a time; 0: as many as there are cores
  int threads = 0;                   // cores to share; 0: all
  std::string only;                  // glob over the cases' names; "" all
  std::string preset;
  bool retry_failed = false, json = false, quiet = false;
  bool slurm = false;  // as a job array of Slurm; threads: cores of each run, jobs: runs at a time, 0 no limit
};

/// Runs whatever is not finished yet; returns 0, 8 (some run failed) or, stopped by a signal, 75 or 130. On Slurm a
/// signal ends the watching alone: the array goes on, and the same command watches it again.
int run_jobs(const BatchOptions& options, const cases::Study& study, const Jobs& plan, Book& book);

}  // namespace puffin::tools
