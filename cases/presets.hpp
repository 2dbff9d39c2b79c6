#pragma once
// The presets of `puffin run`: how fine a grid, and how long.

#include <span>
#include <string_view>

namespace puffin::cases {

/// A preset scales the cell size that the case asks for (its case files give the default one) and may shorten the run.
struct Preset {
  std::string_view name;
  double coarsening;    // of dx; the number of cells goes with its inverse cube
  double longest_time;  // [s] stop.time is cut to this
};

/// quick: dx 0.4 mm where the case says 0.234 mm, and at most 150 ms; fast: 0.3 mm; default: as the case says;
/// accurate: 0.16 mm.
std::span<const Preset> presets();

/// Throws std::invalid_argument for an unknown name, naming the known ones.
const Preset& preset_of(std::string_view name);

}  // namespace puffin::cases
