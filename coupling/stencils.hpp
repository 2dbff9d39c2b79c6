#pragma once
// For every carrier the active cells it exchanges momentum with, and their weights.

#include <Eigen/Core>
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

/// The stencil of one carrier.
struct Stencil {
  std::int32_t carrier = -1;
  std::int32_t count = 0;                            // cells; 0: the carrier is outside (no active cell within reach)
  std::size_t begin = 0;                             // of its entries
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // carrier minus centre of its nearest cell [cells]
};

/// The stencils of a set of carriers. Walls cut the kernel: only active cells that are connected through cell faces,
/// within the stencil, to its heaviest active cell take part (air on the far side of a thin wall does not), and the
/// weights are scaled to sum 1. So what is spread is complete, and a uniform field is read as it is.
///
/// Order: the carriers are sorted into slabs across the longest side of the box, each at least as thick as the widest
/// stencil. Carriers of two even slabs (or of two odd ones) never touch the same cell: so adding into cells runs in
/// parallel without locks, and always in the same order: even slabs first, carriers in the order given.
class Stencils {
 public:
  /// in: positions [m] and radii [m] (of the tracked parcel) of all carriers; `carriers`: which of them are wanted.
  /// Throws std::invalid_argument from Kernel for carriers larger than 9 cells.
  void build(const CellIndex& cells, std::span<const Eigen::Vector3d> position, std::span<const double> radius,
             std::span<const int> carriers);

  const std::vector<Stencil>& stencils() const { return stencils_; }
  std::span<const StencilEntry> entries(const Stencil& s) const {
    return {entries_.data() + s.begin, static_cast<std::size_t>(s.count)};
  }
  /// Carriers without any active cell in reach, ascending. Their stencils are empty: they read zero and give nothing.
  const std::vector<int>& outside() const { return outside_; }
  /// Slab n holds stencils()[slabs()[n]] ... stencils()[slabs()[n + 1] - 1].
  const std::vector<int>& slabs() const { return slabs_; }
  /// Sets touched[run] = 1 for every run of cells in any stencil; never clears. Size: CellIndex::run_count().
  void mark_runs(const CellIndex& cells, std::vector<char>& touched) const;

 private:
  const Kernel& kernel_for(double diameter_in_cells);
  void sort_into_slabs(const CellIndex& cells, std::span<const Eigen::Vector3d> position, std::span<const int> carriers,
                       int reach);

  std::vector<Stencil> stencils_;
  std::vector<StencilEntry> entries_;   // only grows
  std::vector<const Kernel*> kernels_;  // by stencil
  std::map<double, Kernel> known_kernels_;
  std::vector<int> outside_, slabs_;
};

}  // namespace puffin::coupling
