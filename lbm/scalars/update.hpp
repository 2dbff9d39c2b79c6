#pragma once
// One update of the scalars, and the walk over the runs that take part in it.

#include <tbb/parallel_for.h>

#include <cstddef>
#include <vector>

#include "lbm/flush_to_zero.hpp"
#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"
#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {

/// What does not change during one update.
template <class Real>
struct Update {
  const Rows& rows;
  const FaceFluxes& fluxes;
  const ScalarOptions& options;
  const std::vector<double>& resting;  // of the sub-step: busy_runs.hpp
  const std::vector<int>& moving;      // the scalars that it takes
  ScalarFields& fields;
  ScalarBudget& budget;

  Real* concentration(int k) const { return scratch().concentration.data() + k * rows.slots(); }
  Real* out_high(int k) const { return scratch().out_high.data() + k * rows.slots(); }
  Real* out_low(int k) const { return scratch().out_low.data() + k * rows.slots(); }
  ScalarScratch<Real>& scratch() const { return fields.work.scratch<Real>(); }

  /// Calls visit(run, room) for all computed runs, chunk by chunk in parallel; room: for the moving scalars of a run.
  template <class Visit>
  void for_each_run(const Visit& visit) const {
    const auto& chunks = rows.chunks();
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
      const FlushToZero flush;
      std::vector<SweepScalar<Real>> scalars(moving.size());
      for (int r = chunks[c].first_run; r < chunks[c].last_run; ++r)
        if (fields.work.computed[r]) visit(rows.runs()[r], scalars);
    });
  }
};

}  // namespace puffin::lbm
