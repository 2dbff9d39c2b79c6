#pragma once
// For every carrier the active cells it exchanges momentum with, and their weights.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "coupling/cell_index.hpp"
#include "coupling/kernel.hpp"

namespace puffin::coupling {

/// One cell of a stencil.
struct StencilEntry {
  std::int32_t slot = -1;           // active slot of Rows
  std::int8_t x = 0, y = 0, z = 0;  // cell minus the carrier's nearest cell
  double weight = 0.0;              // > 0
};

/// What one cell adds to the reading of a carrier whose kernel a wall cuts.
struct Shift {
  std::int32_t slot = -1;
  double weight = 0.0;  // of either sign; those of a stencil sum to 0
};

/// The stencil of one carrier.
struct Stencil {
  std::int32_t carrier = -1;
  std::int32_t count = 0;                            // cells; 0: the carrier is outside (no active cell within reach)
  std::size_t begin = 0;                             // of its entries
  double squares = 0.0;                              // sum of the squared weights
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // carrier minus centre of its nearest cell [cells]
};

/// The stencils of a set of carriers. Walls cut the kernel: only active cells that are connected through cell faces,
/// within the stencil, to its heaviest active cell take part (air on the far side of a thin wall does not), and the
/// weights are scaled to sum 1. So what is spread is complete, and a uniform field is read as it is. The mean place of
/// what is left lies further from the wall than the carrier: shifts() leads the reading back (cut_stencil.hpp).
///
/// Order: the carriers are sorted into tiles of the cross-section (y, z), each at least as wide as the widest stencil,
/// and inside a tile by their nearest cell (z, y, x: the order of the memory) and by index. Tiles have one of four
/// colours, 2 x 2; carriers of two tiles of one colour never touch the same cell. So adding into cells runs in parallel
/// without locks, and always in the same order, which depends on the positions alone. (Slabs across x, the longest
/// axis, were tried first: every cell of a stencil then lies in a page of its own, and spreading took 2 to 5 times as
/// long.)
class Stencils {
 public:
  /// in: positions [m] and radii [m] (of the tracked parcel) of all carriers; `carriers`: which of them are wanted.
  /// Carriers that have not moved since the last call keep their entries: `cells` must be those of the call before.
  /// Throws std::invalid_argument from Kernel for carriers larger than 9 cells.
  void build(const CellIndex& cells, std::span<const Eigen::Vector3d> position, std::span<const double> radius,
             std::span<const int> carriers);

  const std::vector<Stencil>& stencils() const { return stencils_; }
  std::span<const StencilEntry> entries(const Stencil& s) const {
    return {entries_.data() + s.begin, static_cast<std::size_t>(s.count)};
  }
  /// What stencils()[n] reads beside its entries; empty away from walls.
  std::span<const Shift> shifts(std::size_t n) const { return shifts_[n]; }
  /// The active cells of all stencils and shifts, each once, ascending. Some tens of carriers of a bed share each of
  /// them, so what can be done a cell is not done a stencil.
  const std::vector<std::int32_t>& cells() const { return used_; }
  /// Carriers without any active cell in reach, ascending. Their stencils are empty: they read zero and give nothing.
  const std::vector<int>& outside() const { return outside_; }
  /// Tile t holds stencils()[tiles()[t]] ... stencils()[tiles()[t + 1] - 1]; t = ty + tile_counts()[0] * tz.
  const std::vector<int>& tiles() const { return tiles_; }
  std::array<int, 2> tile_counts() const { return tile_counts_; }
  /// Sets touched[run] = 1 for every run of cells() that the stencils use; never clears. Size: CellIndex::run_count().
  void mark_runs(const CellIndex& cells, std::vector<char>& touched) const;

 private:
  const Kernel& kernel_for(double diameter_in_cells);
  void sort_into_tiles(const CellIndex& cells, std::span<const Eigen::Vector3d> position, std::span<const int> carriers,
                       int reach);

  void find_cells(std::size_t slots);

  /// What the entries of a stencil were made for.
  struct Made {
    std::int32_t carrier = -1;
    double diameter = 0.0;  // [cells]
    Eigen::Vector3d position;
    std::size_t begin = 0;
  };
  struct Place {
    std::int64_t key = 0;  // tile, z, y, x
    std::int32_t carrier = -1;
    bool operator<(const Place& other) const { return key != other.key ? key < other.key : carrier < other.carrier; }
  };

  std::vector<Stencil> stencils_;
  std::vector<StencilEntry> entries_;       // only grows
  std::vector<std::vector<Shift>> shifts_;  // by stencil
  std::vector<const Kernel*> kernels_;      // by stencil
  std::vector<Made> made_;                  // by stencil
  std::vector<std::int32_t> used_;          // cells()
  std::vector<std::uint64_t> marks_;        // a bit a slot; zero between calls
  std::map<double, Kernel> known_kernels_;
  std::vector<int> outside_, tiles_{0};
  std::array<int, 2> tile_counts_{0, 0};
  std::vector<int> carriers_;  // of the last build
  std::vector<Place> order_;   // of the last build: nearly the next one's
};

}  // namespace puffin::coupling
