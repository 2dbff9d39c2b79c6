#pragma once
// What memory allows: plain loops without arithmetic, over arrays laid out as populations are.

#include <cstddef>

namespace puffin::bench {

/// Cell updates a second [1/s] of the least that an in-place D3Q19 step must do: each of 19 arrays of `cells` values is
/// read and written once, in blocks of a few hundred cells. `bytes_each`: 4 or 8.
double stream_updates_per_second(std::size_t cells, std::size_t bytes_each, double seconds);

/// Bandwidth [B/s], read and write counted, of a copy between two arrays that together are `bytes` large.
double copy_bandwidth(std::size_t bytes, double seconds);

}  // namespace puffin::bench
