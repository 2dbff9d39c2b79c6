#pragma once
// From a run to events.h5 and back: what a replay of its fines needs.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/build.hpp"
#include "coupling/replay_fines.hpp"
#include "tools/output/replay_tables.hpp"
#include "tools/output/summary.hpp"

namespace puffin::tools {

/// Empty if the run carries no fines through air.
std::optional<output::ReplayTables> replay_tables(const cases::Simulation& s);

/// A finished run to replay.
struct StoredRun {
  coupling::FinesRecord record;
  std::vector<std::string> scalars;  // names of the record's sets
};
/// From the folder of a run. Throws output::OutputError if there is no events.h5 or nothing to replay in it.
StoredRun read_stored_run(const std::filesystem::path& folder);

/// As in summary.json.
std::vector<output::FinesSummary> summaries(const coupling::Replayed& replayed,
                                            const std::vector<std::string>& scalars);

}  // namespace puffin::tools
