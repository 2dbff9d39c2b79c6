#pragma once
// Runs of active cells: what the hot loops iterate over. See rows.hpp for the storage they live in.

#include <array>
#include <cstddef>

namespace puffin::lbm {

/// Consecutive active cells along x in one row.
struct Run {
  int x = 0, y = 0, z = 0;                               // first cell, in voxel indices
  int count = 0;                                         // active cells, >= 1
  std::ptrdiff_t first = 0;                              // slot of the first cell
  std::array<std::array<std::ptrdiff_t, 3>, 3> shift{};  // [cy+1][cz+1]: slot offset to row (y+cy, z+cz) at equal x
  int span = 0;  // consecutive runs with equal numbers have equal shifts: what lies between them can be stepped over
};

/// A contiguous range of runs, given as a whole to one thread. The partition does not depend on the number of threads.
struct Chunk {
  int first_run = 0, last_run = 0;  // [first_run, last_run)
};

}  // namespace puffin::lbm
