#pragma once
// Whether the numbers in events.h5 can be those of a run: the file may have been altered, or damaged on its way.

#include <filesystem>
#include <vector>

#include "tools/output/events_file.hpp"
#include "tools/output/replay_tables.hpp"

namespace puffin::tools {

/// Throws output::OutputError naming file, data set, row, member, value and what it must be, for the first value that
/// no run writes: no number, a carrier that is not there, a negative number of fines, an angle beyond 90 degrees, fines
/// of a mechanism that do not add up to what it released. What it lets pass, a replay turns into finite parts of
/// the dose, none of them negative. It does not say whether a possible number is the one that the run wrote.
void demand_sound(const std::filesystem::path& file, const output::ReplayTables& tables,
                  const std::vector<output::EventRecord>& events);

}  // namespace puffin::tools
