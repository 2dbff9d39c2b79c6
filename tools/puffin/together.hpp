#pragma once
// Several cases whose carriers do not act on the air, in one process and one flow.

#include <filesystem>
#include <vector>

#include "cases/case.hpp"
#include "cases/read_case.hpp"

namespace puffin::tools {

struct TogetherCase {
  std::filesystem::path case_file, out;
  std::vector<cases::Override> sets;
};

/// Why a case cannot feel a flow that is computed for another one; "" if it can.
std::string why_apart(const cases::Case& flow, const cases::Case& other);

/// Text equal for cases that can share a flow: geometry, air, numerics. Empty if the case has no carriers on a lattice.
std::string flow_key(const cases::Case& c);

/// Reads the list that `puffin batch` writes: a JSON array of { "case", "out", "set": [ "key=value" ] }. Throws
/// output::OutputError.
std::vector<TogetherCase> read_together(const std::filesystem::path& file);

/// Runs all of them to their ends and writes each one's folder as `puffin run` does. There are no checkpoints: after a
/// kill what is not finished begins anew. A population that diverges ends alone; air that diverges ends all. Returns 0,
/// 5 if any diverged, or, stopped by a signal, 75 or 130.
/// beds: as of RunOptions.
int run_together(const std::vector<TogetherCase>& list, std::string_view preset, int threads, bool quiet,
                 const std::filesystem::path& beds);

}  // namespace puffin::tools
