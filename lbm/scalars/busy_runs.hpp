#pragma once
// Which runs of cells take part in a sub-step.

#include "lbm/rows.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

/// Marks work.computed: all runs that hold something, and those that the three sweeps, in the order x y z or reversed,
/// can carry it to: one cell a sweep. `all` marks every run. Runs that drop out are left clean, with no concentration.
/// Something means more than 1e-30 of what the scalar holds in all: less cannot be seen in any sum. Only the scalars of
/// work.moving count. Returns false if nothing is marked.
bool mark_busy_runs(const Rows& rows, bool all, ScalarFields& fields);

/// Sets work.moving: the scalars of which the domain holds more than options.negligible, or whose openings bring some.
void mark_moving_scalars(const Rows& rows, const ScalarOptions& options, ScalarFields& fields);

}  // namespace puffin::lbm
