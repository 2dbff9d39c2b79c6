#pragma once
// Which cells of a uniform grid have their centre inside a closed surface.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Consecutive fluid cells [begin, end) of a row along x; end > begin.
struct FluidRun {
  std::int32_t begin = 0, end = 0;
  bool operator==(const FluidRun&) const = default;
};

/// A box of cubic cells, of which only the fluid ones take memory: as runs along x, and a number a row. Cell (i,j,k)
/// has its centre at origin + dx (i,j,k).
struct Voxels {
  Vec3 origin = Vec3::Zero();  // centre of cell (0,0,0)
  double dx = 0.0;             // edge of a cell
  std::array<int, 3> size{0, 0, 0};
  std::vector<std::size_t> first;  // runs of row j + size[1] k: [first[row], first[row + 1]); length rows() + 1
  std::vector<FluidRun> runs;      // rising within a row, with a cell that is not fluid between two of them

  std::size_t rows() const { return static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]); }
  std::span<const FluidRun> row(std::size_t r) const { return {runs.data() + first[r], first[r + 1] - first[r]}; }
  /// Nothing for a row outside the box.
  std::span<const FluidRun> row(int j, int k) const {
    if (j < 0 || k < 0 || j >= size[1] || k >= size[2]) return {};
    return row(static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  std::int64_t index(int i, int j, int k) const {
    return i + static_cast<std::int64_t>(size[0]) * (j + static_cast<std::int64_t>(size[1]) * k);
  }
  std::array<int, 3> place(std::int64_t index) const {
    const std::int64_t row = index / size[0];
    return {static_cast<int>(index % size[0]), static_cast<int>(row % size[1]), static_cast<int>(row / size[1])};
  }
  /// False outside the box too. Takes the logarithm of the row's runs.
  bool is_fluid(int i, int j, int k) const { return any_fluid(i, i + 1, j, k); }
  /// Is one of the cells [begin, end) of a row fluid?
  bool any_fluid(int begin, int end, int j, int k) const {
    const auto r = row(j, k);
    const auto at = std::partition_point(r.begin(), r.end(), [&](const FluidRun& f) { return f.end <= begin; });
    return at != r.end() && at->begin < end;
  }
  /// Fluid cells.
  std::size_t cells() const {
    std::size_t sum = 0;
    for (const FluidRun& r : runs) sum += static_cast<std::size_t>(r.end - r.begin);
    return sum;
  }
  Vec3 centre(int i, int j, int k) const { return origin + dx * Vec3(i, j, k); }

  /// Makes those cells of the box fluid for which is_fluid(i, j, k) is true.
  template <class Fluid>
  void fill(const Fluid& fluid) {
    first.assign(1, 0);
    runs.clear();
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j) {
        add_row(
            size[0], [&](int i) { return static_cast<bool>(fluid(i, j, k)); }, runs);
        first.push_back(runs.size());
      }
  }
  /// Appends the runs of one row of `length` cells.
  template <class Fluid>
  static void add_row(int length, const Fluid& fluid, std::vector<FluidRun>& to) {
    for (int i = 0; i < length; ++i) {
      if (!fluid(i)) continue;
      const int begin = i;
      while (i < length && fluid(i)) ++i;
      to.push_back({begin, i});
    }
  }
};

}  // namespace puffin::lbm::geometry
