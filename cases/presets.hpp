#pragma once
// The presets of `puffin run`: how fine a grid, how large a step, and how long.

#include <span>
#include <string_view>

namespace puffin::cases {

/// A preset scales the cell size that the case asks for (its case files give the default one), with it a time step in
/// seconds, and may shorten the run; a pressure window or an average that would begin after that takes its default.
struct Preset {
  std::string_view name;
  double coarsening;      // of dx; the number of cells goes with its inverse cube
  double longest_time;    // [s] stop.time is cut to this
  double speeding = 1.0;  // of numerics.lattice_speed, to 0.15 at most
};

/// quick: 1.5 times the case's dx (0.375 mm for 0.25 mm) and at most 121 ms; fast: 1.2 times, with steps
/// 1.4 times as long, which the trade-off of the device found to cost no accuracy (docs/accuracy-and-speed.md);
/// default: as the case says; accurate: 2/3 of its dx. Such factors keep a dx that fits the device's lengths fitting as
/// many of them as possible.
std::span<const Preset> presets();

/// Throws std::invalid_argument for an unknown name, naming the known ones.
const Preset& preset_of(std::string_view name);

}  // namespace puffin::cases
