#pragma once
// `base = "other.toml"` in a case file: the other case with this file's keys laid over it.

#include <toml++/toml.h>

#include <filesystem>

#include "cases/format/findings.hpp"

namespace puffin::cases::format {

/// Replaces the key `base` of a parsed file by what that file says. Tables are joined key by key; every other value of
/// this file, lists too, replaces the base's. `name` and `[reference]` belong to one case and are not inherited. A base
/// may have a base. Every value keeps its place in its own file; the texts are made known to `findings`.
/// Reports a base that cannot be read or leads back to itself; throws CaseError if a base is no TOML.
void inherit(toml::table& root, const std::filesystem::path& file, Findings& findings);

}  // namespace puffin::cases::format
