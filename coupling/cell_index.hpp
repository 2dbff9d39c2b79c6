#pragma once
// Fast look-up: which slot does a voxel have, and to which run does a slot belong?

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "lbm/rows.hpp"

namespace puffin::coupling {

/// Slots of the active cells, row by row and dense between the first and the last active cell of a row (4 bytes a cell,
/// two loads a look-up). Rows itself searches the stretches of a row; that is too slow for 27 cells a carrier and step.
class CellIndex {
 public:
  CellIndex() = default;
  /// Throws std::invalid_argument beyond 2^31 slots.
  explicit CellIndex(const lbm::Rows& rows) : CellIndex(rows, {}) {}
  /// Cells with fluid[slot] == 0 (behind a wall, in the band of an immersed boundary) count as not active.
  CellIndex(const lbm::Rows& rows, const std::vector<std::uint8_t>& fluid);

  /// Slot of cell (i,j,k) if it is active, else -1; periodic directions are wrapped.
  std::int32_t active_slot(int i, int j, int k) const {
    if (!wrap(i, 0) || !wrap(j, 1) || !wrap(k, 2)) return -1;
    const Row& row = rows_[j + static_cast<std::size_t>(box_[1]) * k];
    return i < row.first || i >= row.last ? -1 : slots_[row.begin + (i - row.first)];
  }
  /// Slots of the cells (i, j, k) ... (i + count - 1, j, k), as active_slot gives them. Returns whether all are active.
  bool active_slots(int i, int j, int k, int count, std::int32_t* slots) const {
    if (!wrap(j, 1) || !wrap(k, 2)) {
      std::fill_n(slots, count, -1);
      return false;
    }
    const Row& row = rows_[j + static_cast<std::size_t>(box_[1]) * k];
    bool all = true;
    if (i >= row.first && i + count <= row.last) {
      const std::int32_t* from = slots_.data() + row.begin + (i - row.first);
      for (int n = 0; n < count; ++n) {
        slots[n] = from[n];
        all = all && from[n] >= 0;
      }
      return all;
    }
    for (int n = 0; n < count; ++n) {
      slots[n] = active_slot(i + n, j, k);
      all = all && slots[n] >= 0;
    }
    return all;
  }
  /// Index into Rows::runs() of an active slot.
  std::int32_t run(std::int32_t slot) const { return runs_[slot]; }
  std::size_t run_count() const { return run_count_; }
  std::size_t slots() const { return runs_.size(); }

  double dx() const { return dx_; }
  const lbm::geometry::Vec3& origin() const { return origin_; }
  std::array<int, 3> box() const { return box_; }
  std::array<bool, 3> periodic() const { return periodic_; }

 private:
  struct Row {
    std::int32_t first = 0, last = 0;  // active cells lie in [first, last)
    std::size_t begin = 0;
  };
  bool wrap(int& i, int d) const {
    if (static_cast<unsigned>(i) < static_cast<unsigned>(box_[d])) return true;
    if (!periodic_[d]) return false;
    i = (i % box_[d] + box_[d]) % box_[d];
    return true;
  }
  std::vector<Row> rows_;            // [j + box_y k]
  std::vector<std::int32_t> slots_;  // -1: not active
  std::vector<std::int32_t> runs_;   // by slot; -1: not active
  std::size_t run_count_ = 0;
  double dx_ = 0.0;
  lbm::geometry::Vec3 origin_ = lbm::geometry::Vec3::Zero();
  std::array<int, 3> box_{0, 0, 0};
  std::array<bool, 3> periodic_{false, false, false};
};

}  // namespace puffin::coupling
