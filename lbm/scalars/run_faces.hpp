#pragma once
// Slot offsets from the cells of a run to their neighbours in direction d.

#include "lbm/rows.hpp"

namespace puffin::lbm {

inline std::ptrdiff_t offset_high(const Run& run, int d) {
  return d == 0 ? 1 : d == 1 ? run.shift[2][1] : run.shift[1][2];
}
inline std::ptrdiff_t offset_low(const Run& run, int d) {
  return d == 0 ? -1 : d == 1 ? run.shift[0][1] : run.shift[1][0];
}

}  // namespace puffin::lbm
