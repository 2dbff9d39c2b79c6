#pragma once
// A TOML file as text and as a table.

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace puffin::cases::format {

/// The whole file. Throws std::system_error if it cannot be read, CaseError if it is longer than 64 MB.
std::string read_text(const std::filesystem::path& file);

/// Throws CaseError with the place of the first syntax error.
toml::table parse_toml(std::string_view text, const std::string& file);

/// A study has cases, sweeps, replicates or things to share and no device of its own; a case has a name, a schema or a
/// device and none of these.
bool describes_study(const toml::table& root);
bool describes_case(const toml::table& root);

}  // namespace puffin::cases::format
