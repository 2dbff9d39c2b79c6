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

}  // namespace puffin::cases::format
