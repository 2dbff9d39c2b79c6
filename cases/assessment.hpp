#pragma once
// What a case will be on the lattice, before it is run: cells, step, stability, memory, and what to watch.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/derived.hpp"
#include "cases/surface.hpp"
#include "lbm/geometry/voxels.hpp"

namespace puffin::cases {

struct InletNumbers {
  std::string patch;
  double area = 0.0;                // [m^2]
  double largest_mean_speed = 0.0;  // [m/s] until stop.time
  double hydraulic_diameter = 0.0;  // 4 area / perimeter of the opening [m]
  double reynolds = 0.0;            // of that speed and diameter
};

struct Assessment {
  double volume = 0.0, area = 0.0;  // of the surface [m^3], [m^2]
  std::vector<InletNumbers> inlets;
  double reference_speed = 0.0;           // [m/s]; 0 without a lattice
  std::optional<LatticeNumbers> lattice;  // air = "lbm"
  std::int64_t cells_fluid = 0;
  double volume_voxels = 0.0;  // [m^3]
  double narrowest_gap = 0.0;  // [m], infinity if no walls face each other; 0: not measured
  double thinnest_wall = std::numeric_limits<double>::infinity();  // [m], infinity if none lies between fluid
  std::size_t thin_walls = 0;                                      // pairs of fluid cells with a wall between them
  double memory = 0.0;                                             // [byte], an estimate
  std::vector<std::string> warnings;
};

/// Voxelises the surface (with a lattice) and measures. Throws as the geometry functions do: an opening that no
/// boundary tags, nothing inside, faces inside the fluid, a periodic
/// box that is no whole number of cells, more than four thousand million cells (all as GeometryError).
Assessment assess(const Case& c, const Surface& surface);

/// The periodic directions of a case, from the normals of its periodic patches.
std::array<bool, 3> periodic_directions(const Case& c, const Surface& surface);

}  // namespace puffin::cases
