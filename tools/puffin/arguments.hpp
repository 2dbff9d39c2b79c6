#pragma once
// Pieces of a command line that several commands share.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/read_case.hpp"
#include "cases/units.hpp"

namespace CLI {
class App;
}

namespace puffin::tools {

/// A TIME, LENGTH, ... argument: "80ms", "0.2mm", or a bare SI number. `what` names the option in the message.
/// Throws UsageError unless it is positive and of the right dimension.
double positive_quantity(const std::string& text, const cases::Unit& unit, const std::string& what);

/// CASE.toml, --preset, --set, --json: as given.
struct CaseArguments {
  std::filesystem::path file;
  std::string preset;
  std::vector<std::string> sets;
  bool json = false;

  void add_to(CLI::App& app);
  /// Throws UsageError for a --set without '='.
  std::vector<cases::Override> overrides() const;
  cases::Case read() const;
};

}  // namespace puffin::tools
