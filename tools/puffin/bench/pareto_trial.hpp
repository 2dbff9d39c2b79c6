#pragma once
// One setting of a case of `puffin bench pareto`, run once under each of the case's variants.

#include <vector>

#include "cases/verification/pareto.hpp"
#include "tools/puffin/bench/child_run.hpp"
#include "tools/puffin/bench/pareto_figure.hpp"

namespace puffin::tools {

/// What the runs of a setting came to. n variants with values v_i and references r_i:
///     value = mean v_i,   value_spread = (max v_i - min v_i)/2,   deviation = sqrt(mean (v_i - r_i)^2),
/// so a setting whose value hangs on the variant pays for it though the mean is right. half_width = sqrt(sum w_i^2)/n
/// of the half widths w_i of their confidence intervals. One run, if there are no variants.
struct ParetoTrial {
  double seconds = 0.0, processor_seconds = 0.0;  // of all of them
  double foreign_load = 0.0;                      // the largest
  double value = not_known, value_spread = not_known, half_width = not_known;
  double reference = not_known, deviation = not_known;
  double cells = not_known, steps = not_known, cell_updates = not_known;  // of the first; updates of all
  double memory_peak = not_known;
  std::map<std::string, double> phases;  // of all of them
  std::string outcome = "ok";            // ok | diverged | exit N | no value; the first that is not ok
  std::string problem;
};

/// Runs the setting; the first variant that fails ends it. reference: instead of the check's own.
/// Throws as run_child.
ParetoTrial run_trial(const cases::ParetoCase& c, const std::vector<cases::Override>& sets, bool quick,
                      std::optional<double> reference, TemporaryFolder& place);

/// The trial's numbers as a row; `reference_uncertainty`: in the metric's unit.
void take(const ParetoTrial& trial, const cases::ParetoCase& c, double reference_uncertainty, ParetoRow& row);

}  // namespace puffin::tools
