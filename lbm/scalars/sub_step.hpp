#pragma once
// The length of a sub-step of the transport, and which scalars diffuse implicitly in it.

#include <vector>

#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/max_steps.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

struct SubStep {
  double steps = 0.0;  // air steps
  bool any_implicit = false;
  std::vector<bool> implicit;  // [scalar] diffuses along lines, not inside the sweeps
};

/// Largest diffusivity that all scalars have in common.
double largest_eddy(const FaceFluxes& fluxes);

/// The next sub-step of `remaining` air steps, for the scalars `moving`: equal parts of what remains, each within
/// `limit` and `share`, and within what explicit diffusion allows unless that costs more than half of it: then the
/// scalar diffuses implicitly. `share` comes from the whole flow, so that a scalar's steps do not depend on where other
/// scalars are. Throws std::runtime_error where the fluxes would empty a cell within any step.
SubStep plan_sub_step(const StepLimit& limit, const ScalarOptions& options, const std::vector<int>& moving, double eddy,
                      double share, double remaining);

}  // namespace puffin::lbm
