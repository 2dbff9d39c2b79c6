#pragma once
// The populations of one air: 19 arrays over the slots of Rows, updated in place (AA pattern, see kernel.hpp).

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lbm/huge_pages.hpp"
#include "lbm/kernel.hpp"
#include "lbm/rows.hpp"

namespace puffin::lbm {

/// Slot offset from a cell of `run` to its neighbour in direction i.
inline std::ptrdiff_t neighbour_offset(const Run& run, int i) {
  const auto& c = d3q19::velocity[i];
  return c[0] + run.shift[c[1] + 1][c[2] + 1];
}

template <class T>
struct Populations {
  std::vector<T, HugePages<T>> f;  // shifted populations g_i = f_i - w_i, [19][stride]
  std::size_t stride = 0;
  Parity next = Parity::even;  // kind of the step to come

  Populations() = default;
  explicit Populations(std::size_t slots) {
    // An odd number of cache lines between directions keeps 19 streams out of each other's cache sets.
    std::size_t lines = (slots * sizeof(T) + 63) / 64;
    while (lines % 64 != 5) ++lines;
    stride = lines * 64 / sizeof(T);
    f.resize(19 * stride);
    // Each part is first written by the thread that will work on it, and so lies in that thread's memory.
    constexpr std::size_t parts = 64;
    oneapi::tbb::parallel_for(
        std::size_t{0}, parts,
        [&](std::size_t k) {
          for (std::size_t i = 0; i < 19; ++i) {
            T* const direction = f.data() + i * stride;
            std::fill(direction + stride * k / parts, direction + stride * (k + 1) / parts, T(0));
          }
        },
        oneapi::tbb::static_partitioner());
  }
  /// The population in direction i that has arrived at an active slot of `run`, before its next collision.
  const T& arrived(const Run& run, std::ptrdiff_t slot, int i) const { return f[place(run, slot, i)]; }
  T& arrived(const Run& run, std::ptrdiff_t slot, int i) { return f[place(run, slot, i)]; }
  /// The post-collision population in direction i that left the cell in the last step (valid between a collision and
  /// the links, at every active slot). `last` is the parity of that step.
  T departed(const Run& run, std::ptrdiff_t slot, int i, Parity last) const {
    if (last == Parity::even) return f[d3q19::opposite(i) * stride + slot];
    return f[i * stride + slot + neighbour_offset(run, i)];
  }

 private:
  std::size_t place(const Run& run, std::ptrdiff_t slot, int i) const {
    if (next == Parity::even) return i * stride + slot;
    const int o = d3q19::opposite(i);
    return o * stride + slot + neighbour_offset(run, o);
  }
};

}  // namespace puffin::lbm
