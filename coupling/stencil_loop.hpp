#pragma once
// Parallel loops over stencils that add into cells: no locks, and the same order of sums for any number of threads.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "coupling/stencils.hpp"

namespace puffin::coupling {

/// Calls visit(slab, stencil) for every stencil: the even slabs in parallel, then the odd ones; inside a slab in order.
/// No two concurrent calls have a cell in common, and every cell is visited in the same order however many threads run.
template <class Visit>
void for_each_by_slab(const Stencils& stencils, const Visit& visit) {
  const auto& slabs = stencils.slabs();
  const int count = static_cast<int>(slabs.size()) - 1;
  for (int parity = 0; parity < 2; ++parity)
    tbb::parallel_for(0, (count - parity + 1) / 2, [&](int n) {
      const int slab = 2 * n + parity;
      for (int s = slabs[slab]; s < slabs[slab + 1]; ++s) visit(slab, stencils.stencils()[s]);
    });
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
