#pragma once
// The blow-up map as a picture.

#include <nlohmann/json.hpp>
#include <string>

namespace puffin::tools {

/// A panel for each scene, a line for each variation, a field for each speed: ran, healed by smaller steps, diverged,
/// refused. `rows` as `puffin bench stability` makes them. Returns SVG text, a file of its own.
std::string stability_map(const nlohmann::json& rows);

}  // namespace puffin::tools
