#pragma once
// A text as TOML writes it.

#include <string>
#include <string_view>

namespace puffin::cases {

/// As a basic string in quotes: quotes and backslashes behind a backslash, control characters by their code.
std::string toml_string(std::string_view text);

}  // namespace puffin::cases
