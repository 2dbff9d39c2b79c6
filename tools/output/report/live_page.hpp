#pragma once
// index.html of a run while it goes on: how far it is, and the curves so far. Refreshes itself; loads nothing.

#include <string>
#include <vector>

#include "tools/output/summary.hpp"
#include "tools/output/tables.hpp"

namespace puffin::output {

/// The page for a status and the history until now. Refreshes itself every three seconds while the state is "running";
/// afterwards it points to report.html.
std::string live_page(const Status& status, const std::vector<HistoryRow>& history);

}  // namespace puffin::output
