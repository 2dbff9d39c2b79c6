#pragma once
// The fines' part of one exchange interval.

#include <optional>

#include "coupling/state.hpp"
#include "lbm/scalars/sub_step.hpp"

namespace puffin::coupling {

/// Contacts count from here on [s]; before the first motion of a dose that settles there is no such time.
std::optional<double> counted_from(const Models& models, const State& s);

/// A scene without air: what comes off its carriers stays in the air where it is, and the air is one place, the only
/// "cell" of `sets` sets of scalars. So the books, the checkpoint and a replay are those of any other run.
void keep_fines_in_one_place(int sets, State& s);

/// Takes fines off the carriers by the contacts and the slip of an interval of `steps` air steps, `interval` [s].
void move_fines(const Models& models, std::int64_t steps, double interval, State& s);

/// How many air steps an update of the fines' transport covers, if the flow allows `allowed` of them (>= 1 assumed, 64
/// at most) and diffusion `followed`: as many as one sub-step holds, or two or three exchange intervals (>= 1 steps
/// each) where that costs less an air step. Cost in sweeps: cost_in_sweeps (lbm/scalars/sub_step.hpp), and 2.5 an
/// update for the fluxes and what is found from them (docs/decisions/0025-mirrored-pairs.md). Longer is not taken: what
/// is released in an update is carried over all of it, and the fluxes are those of its end.
double steps_per_update(const lbm::StepsAllowed& allowed, double followed, std::int64_t exchange);

/// Air steps over which diffusion stays second order in time: half a cell's width squared, n D <= 1/2 in lattice units
/// (lbm/scalars/diffuse_lines.hpp weighs old and new equally up to there), and never less than one step. A cloud
/// between absorbing plates 25 cells apart decays 5 % too slowly with n D = 6. Infinite without diffusion.
double steps_diffusion_follows(const lbm::ScalarOptions& options);

/// Carries the airborne fines over the steps since the last time: `now`, or when the next exchange would exceed
/// State::steps_per_scalar_update. Throws Diverged.
void carry_fines(const Models& models, bool now, State& s);

}  // namespace puffin::coupling
