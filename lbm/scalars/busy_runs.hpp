#pragma once
// Which runs of cells take part in a sub-step.

#include "lbm/rows.hpp"
#include "lbm/scalars/scalar_fields.hpp"
#include "lbm/scalars/sub_step.hpp"
#include "lbm/scalars/sweep.hpp"

namespace puffin::lbm {

using RunContents = std::vector<std::vector<Content>>;  // [scalar][run]

/// A cell that holds no more than this part of a scalar gives nothing away: it cannot be seen in any sum.
inline constexpr double resting_part = 1e-30;

/// [scalar] what a cell must hold more of, or it rests: resting_part of what all runs hold.
std::vector<double> find_resting(const RunContents& contents);

/// Marks work.computed: all runs that hold something, and those that the sweeps, in their order, can carry it to: one
/// cell a sweep. `all` marks every run. Runs that drop out are left clean, with no concentration.
/// Something means a cell that does not rest, so it changes no bit which runs are left out. Only the scalars of
/// work.moving count. Returns false if nothing is marked.
bool mark_busy_runs(const Rows& rows, bool all, const RunContents& contents, const std::vector<double>& resting,
                    const std::vector<Stroke>& sweeps, ScalarFields& fields);

/// Sets work.moving: the scalars of which the domain holds more than options.negligible, or whose openings or walls
/// bring some.
void mark_moving_scalars(const ScalarOptions& options, const RunContents& contents, ScalarFields& fields);

}  // namespace puffin::lbm
