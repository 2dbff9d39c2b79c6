#pragma once
// Case file (TOML) -> Case.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.hpp"
#include "cases/case_error.hpp"

namespace puffin::cases {

/// One `--set key=value`: a dotted key and a TOML value ("carriers.count", "1000"). A value that is no TOML is taken as
/// a string, so that the shell's quotes may be left out: --set numerics.dx=0.4mm.
struct Override {
  std::string key;
  std::string value;
};

/// Splits "key=value" at the first '='. Throws std::invalid_argument without one or with an empty key.
Override parse_override(std::string_view text);

/// Reads and checks a case file, with the preset's values over the file's and the overrides over both.
/// preset: "quick", "fast", "default", "accurate" or "" (as the file says).
/// Throws CaseError with every problem of the file, std::system_error if it cannot be read, std::invalid_argument for
/// an unknown preset.
Case read_case(const std::filesystem::path& file, const std::vector<Override>& overrides = {},
               std::string_view preset = {});

/// The same for a text in memory; `file` names it in messages and anchors relative paths.
Case parse_case(std::string_view toml, const std::filesystem::path& file, const std::vector<Override>& overrides = {},
                std::string_view preset = {});

/// Parameters of a generator from overrides alone, with units, names and ranges checked as in a case file.
/// Throws CaseError with every problem, std::invalid_argument for an unknown kind.
std::map<std::string, Parameter> parse_parameters(const std::string& kind, const std::vector<Override>& overrides);

}  // namespace puffin::cases
