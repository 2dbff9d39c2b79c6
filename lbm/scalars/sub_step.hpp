#pragma once
// The length of a sub-step of the transport, and which scalars diffuse implicitly in it.

#include <optional>
#include <vector>

#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/max_steps.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

/// One sweep of a sub-step.
struct Stroke {
  int direction = 0;
  double steps = 0.0;  // air steps
};

/// How an update is cut up, found from the whole flow so that what happens to a scalar does not depend on where others
/// are, only on which move: one sub-step after the other, or pairs of them, mirrored, whose two sweeps in the middle
/// are one. A pair does with five sweeps what takes six; it is symmetric, so of second order in time by itself (Strang
/// 1968), with half of what drifts into walls taken before it and half after.
struct Cut {
  std::optional<int> middle;  // direction of the sweep in the middle of a pair; none: no pairs
  double share = 0.0;         // air steps of a sub-step, or of a pair
};

struct SubStep {
  double steps = 0.0;  // air steps
  bool any_implicit = false;
  std::vector<bool> implicit;  // [scalar] diffuses along lines, not inside the sweeps
};

/// Largest diffusivity that all scalars have in common.
double largest_eddy(const FaceFluxes& fluxes);

/// What one sub-step of the scalars `moving` may cover by the flow, and what a pair may by the flow and by explicit
/// diffusion.
StepsAllowed allowed_steps(const StepLimit& whole, const ScalarOptions& options, const std::vector<int>& moving,
                           double eddy);

/// So many sub-steps, or so many pairs of them.
struct Pieces {
  double count = 1.0;
  bool pairs = false;
};
/// The cheaper ones for `steps`, by cost_in_sweeps.
Pieces pieces_of(double steps, const StepsAllowed& allowed);
/// Three a sub-step or five a pair, and half a sweep to prepare each.
double cost_in_sweeps(const Pieces& pieces);

/// Pairs go around the direction that allows most.
Cut cut_update(double steps, const StepLimit& whole, const StepsAllowed& allowed);

/// The sweeps of a sub-step or of a pair. reversed: z y x.
std::vector<Stroke> strokes(const Cut& cut, double steps, bool reversed);

/// The next sub-step or pair of `remaining` air steps, for the scalars `moving`: equal parts of what remains, each
/// within `limit` and the share, and within what explicit diffusion allows unless that costs more than half of it: then
/// the scalar diffuses implicitly (never in a pair). Throws std::runtime_error where the fluxes would empty a cell
/// within any step.
SubStep plan_sub_step(const StepLimit& limit, const ScalarOptions& options, const std::vector<int>& moving, double eddy,
                      const Cut& cut, double remaining);

}  // namespace puffin::lbm
