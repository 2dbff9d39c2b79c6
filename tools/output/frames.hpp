#pragma once
// One moment of a run as plain arrays: the air on a block of cells, the carriers, the walls. SI units.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace puffin::output {

struct NamedArray {
  std::string name;
  std::vector<float> values;
};

/// A block of cubic cells, the whole grid or a part of it (a slice is one cell thick). x runs fastest.
/// Arrays that are empty are not written; values of cells that are not fluid are written as 0 and blanked.
struct FieldFrame {
  std::array<double, 3> origin{0, 0, 0};  // centre of cell (0,0,0) [m]
  double dx = 0.0;                        // edge of a cell [m]
  std::array<int, 3> size{0, 0, 0};       // cells in x, y, z
  std::vector<std::uint8_t> fluid;        // per cell: 1 fluid, 0 not
  std::vector<float> velocity;            // 3 per cell: u, v, w [m/s]
  std::vector<float> pressure;            // per cell [Pa], gauge
  std::vector<NamedArray> fines;          // per scalar: its name, number density per cell [1/m^3]
  std::vector<NamedArray> more;           // further per-cell arrays under their own names

  std::int64_t cells() const { return static_cast<std::int64_t>(size[0]) * size[1] * size[2]; }
};

/// The carriers (or parcels) in the device at one moment, in any order. All arrays have the same length.
struct CarrierFrame {
  std::vector<std::array<double, 3>> position;  // [m]
  std::vector<std::int32_t> id;
  std::vector<float> diameter;                 // of the tracked body: of the parcel if parcels are used [m]
  std::vector<std::array<float, 3>> velocity;  // [m/s]
  std::vector<std::array<float, 3>> spin;      // [rad/s]; may be empty
  std::vector<float> fines;                    // fines left on one carrier [-]; may be empty
  std::vector<std::uint8_t> asleep;            // 1: at rest and not computed; may be empty
};

struct WallPatch {
  std::string name;      // as in the case file
  bool opening = false;  // an inlet or outlet: not a wall
};

/// The device's own triangles with what has landed on them since the start.
struct WallFrame {
  std::vector<std::array<double, 3>> vertices;  // [m]
  std::vector<std::array<int, 3>> triangles;    // indices into vertices
  std::vector<std::int32_t> patch;              // per triangle: index into patches
  std::vector<WallPatch> patches;
  std::vector<double> fines;   // per triangle: number of fines per area [1/m^2], of the first scalar; may be empty
  std::vector<double> hits;    // per triangle: number of carrier impacts [-]; may be empty
  std::vector<double> energy;  // per triangle: sum of the impact energies [J]; may be empty
  std::vector<std::pair<std::string, std::vector<double>>> further_fines;  // name and map of each further scalar
};

}  // namespace puffin::output
