#pragma once
// Where a cell lives in memory. Only active cells and one layer of ghosts around them are stored, as rows along x.
//
// A row is a maximal stretch of consecutive stored slots with the same (y,z). Inside a row the slots of x, x+1, ... are
// neighbours in memory. Every cell within one step (D3Q19) of an active cell is stored: so for a run of active cells
// the neighbours in direction (cx,cy,cz) are again consecutive in memory, at the constant offset
//     slot(x + cx, y + cy, z + cz) = slot(x, y, z) + cx + run.shift[cy][cz].
// A kernel needs one offset a run and direction, no index a cell, and no test for walls: what streams out of the fluid
// lands in a ghost slot, where the links (walls, inlet, outlet, periodic faces) pick it up.
//
// Rows follow each other without a gap. In a straight duct all rows are equally long, so all of its runs have the same
// shifts: together they are one span of slots, of which a kernel can take whole packs, ghosts between the rows
// included, with a mask of the lanes that are cells (docs/decisions/0024-packs-across-rows.md).

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lbm/geometry/voxels.hpp"
#include "lbm/run.hpp"

namespace puffin::lbm {

class Rows {
 public:
  /// Vector lanes a row may be over-read by: before the first and behind the last slot in use are this many more.
  static constexpr int padding = 16;

  Rows() = default;
  /// Lays out the active cells of `voxels`. `periodic[d]`: the voxel box wraps around in direction d.
  /// Throws std::invalid_argument if there is no active cell.
  explicit Rows(const geometry::Voxels& voxels, std::array<bool, 3> periodic = {false, false, false});

  std::size_t slots() const { return slots_; }  // array length for one value a slot (active, ghost, padding)
  std::size_t active_cells() const { return active_; }
  const std::vector<Run>& runs() const { return runs_; }
  const std::vector<Chunk>& chunks() const { return chunks_; }
  /// Bit b of number n: slot 16 n + b is an active cell.
  const std::vector<std::uint16_t>& active_lanes() const { return active_lanes_; }
  /// Slot of cell (i,j,k), or -1 where nothing is stored. Periodic directions are not wrapped.
  std::ptrdiff_t slot(int i, int j, int k) const;
  /// Slot of cell (i,j,k) if that cell is active (periodic directions wrapped), else -1.
  std::ptrdiff_t active_slot(int i, int j, int k) const;
  bool is_active(std::ptrdiff_t slot) const { return kind_[slot] == Kind::active; }
  bool is_ghost(std::ptrdiff_t slot) const { return kind_[slot] == Kind::ghost; }
  /// Voxel indices of a stored slot (ghosts may lie outside the voxel box).
  std::array<int, 3> cell(std::ptrdiff_t slot) const { return cell_[slot]; }
  /// Ghost slots that are images of active cells across a periodic face: (ghost, the active cell it mirrors).
  const std::vector<std::array<std::ptrdiff_t, 2>>& periodic_images() const { return images_; }

  const geometry::Vec3& origin() const { return origin_; }  // centre of voxel (0,0,0)
  double dx() const { return dx_; }
  geometry::Vec3 centre(std::ptrdiff_t slot) const {
    const auto c = cell_[slot];
    return origin_ + dx_ * geometry::Vec3(c[0], c[1], c[2]);
  }
  std::array<int, 3> box() const { return box_; }
  std::array<bool, 3> periodic() const { return periodic_; }

 private:
  /// Rows in the order in which they lie in memory: along the shorter one of y and z first, so that neighbours of a
  /// cell in a flat device are not far.
  std::size_t row(int j, int k) const;
  template <class Body>
  void for_each_row(int margin, const Body& body) const;  // body(j, k); margin 1: the rows of ghosts around too
  enum class Kind : std::uint8_t { padding, ghost, active };
  struct Stretch {
    int x = 0, count = 0;
    std::ptrdiff_t first = 0;
  };
  std::size_t slots_ = 0, active_ = 0;
  std::vector<Run> runs_;
  std::vector<Chunk> chunks_;
  std::vector<std::uint16_t> active_lanes_;
  std::vector<Kind> kind_;
  std::vector<std::array<int, 3>> cell_;
  std::vector<std::array<std::ptrdiff_t, 2>> images_;
  std::vector<Stretch> stretches_;       // stored stretches, row by row
  std::vector<std::int32_t> row_begin_;  // per row() incl. the ghost border: first stretch; size rows+1
  geometry::Vec3 origin_ = geometry::Vec3::Zero();
  double dx_ = 0.0;
  std::array<int, 3> box_{0, 0, 0};
  std::array<bool, 3> periodic_{false, false, false};
};

}  // namespace puffin::lbm
