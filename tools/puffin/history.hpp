#pragma once
// A moment of a run as a row of history.csv and of stats.h5.

#include <string>
#include <vector>

#include "cases/build.hpp"
#include "tools/output/stats_file.hpp"
#include "tools/output/tables.hpp"
#include "tools/puffin/sampling.hpp"

namespace puffin::tools {

/// One row of the history at this moment.
output::HistoryRow history_row(const cases::Simulation& s, const DropReader& drops);

/// The scalars of the case, if its fines are transported; the state has each once for every way of detachment.
std::vector<std::string> scalar_names(const cases::Simulation& s);
/// Of the fines loaded, scalar by scalar: FFE, FFW, FFCR, FFCE, in the air, what the books are off by.
std::vector<double> fates_of_scalars(const cases::Simulation& s);

/// Columns of stats.h5: those of history.csv, then the totals of the domain, then of each scalar FFE_NAME, FFW_NAME,
/// FFCR_NAME, FFCE_NAME, in_air_NAME, ledger_error_NAME.
std::vector<output::StatsColumn> stats_columns(const std::vector<std::string>& scalars);

}  // namespace puffin::tools
