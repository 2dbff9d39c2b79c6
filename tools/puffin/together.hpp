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

/// How one of them ended: 0 if it finished.
struct TogetherEnd {
  std::filesystem::path out;
  int code = 0;  // as `puffin run` would have returned for it alone
  std::string message;
};

/// LIST.json.ends: those of the list that have ended of themselves, in that order.
std::filesystem::path ends_file(const std::filesystem::path& list);
/// Empty if there is no such file.
std::vector<TogetherEnd> read_ends(const std::filesystem::path& list);
/// Throws output::OutputError.
void write_ends(const std::vector<TogetherEnd>& ends, const std::filesystem::path& list);

struct TogetherOptions {
  std::filesystem::path list;
  std::string preset;  // "" none
  int threads = 0;     // 0: all
  bool quiet = false;
  std::filesystem::path beds;  // as of RunOptions
};

/// Runs all of the list to their ends and writes each one's folder as `puffin run` does. There are no checkpoints:
/// after a kill what is not finished begins anew. What goes wrong with one, before it begins or on the way, ends that
/// one; air that diverges ends all. Returns 0, the code of the first that failed, or, stopped by a signal, 75 or 130;
/// write_ends keeps the code of each.
int run_together(const TogetherOptions& options);

}  // namespace puffin::tools
