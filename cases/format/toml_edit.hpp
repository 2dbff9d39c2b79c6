#pragma once
// Changes to a parsed case file before it is read: a preset's values, then the user's --set.

#include <toml++/toml.h>

#include "cases/presets.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases::format {

/// Sets a dotted key; lists are entered with [i] or a whole number ("output.fields[0].every",
/// "air.boundary.1.pressure"). Tables on the way are made. The value keeps its source: "--set key". Throws
/// std::invalid_argument if the way leads through a value that is no table, or an index is out of range.
void apply_override(toml::table& root, const Override& o);

/// Scales numerics.dx (to three digits) or numerics.cells and cuts stop.time, where the file has readable ones; the
/// source of what changed is "--preset NAME".
void apply_preset(toml::table& root, const Preset& preset);

}  // namespace puffin::cases::format
