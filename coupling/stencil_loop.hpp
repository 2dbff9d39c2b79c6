#pragma once
// Parallel loops over stencils that add into cells: no locks, and the same order of sums for any number of threads.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "coupling/stencils.hpp"

namespace puffin::coupling {

/// Calls visit(tile, stencil) for every stencil: the tiles of one colour in parallel, colour by colour; inside a tile
/// in order. No two concurrent calls have a cell in common, and every cell is visited in the same order however many
/// threads run.
template <class Visit>
void for_each_by_tile(const Stencils& stencils, const Visit& visit) {
  const auto& tiles = stencils.tiles();
  const auto [across, up] = stencils.tile_counts();
  for (int colour = 0; colour < 4; ++colour) {
    const int y = colour % 2, z = colour / 2;
    const int columns = (across - y + 1) / 2, layers = (up - z + 1) / 2;
    tbb::parallel_for(0, columns * layers, [&, columns = columns, across = across](int n) {
      const int tile = 2 * (n % columns) + y + across * (2 * (n / columns) + z);
      for (int s = tiles[tile]; s < tiles[tile + 1]; ++s) visit(tile, stencils.stencils()[s]);
    });
  }
}

/// Calls visit(stencil) for every stencil, in parallel; for visitors that only write what belongs to the carrier.
template <class Visit>
void for_each_stencil(const Stencils& stencils, const Visit& visit) {
  const auto& all = stencils.stencils();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, all.size(), 64), [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s) visit(all[s]);
  });
}

}  // namespace puffin::coupling
