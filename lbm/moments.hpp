#pragma once
// Density and velocity of the air at the cells where somebody asked for them, in lattice units.

#include <vector>

namespace puffin::lbm {

/// One value a slot of Rows; meaningful only at the active cells whose moments were requested in the last step.
struct Moments {
  std::vector<float> density_excess;  // rho - 1
  std::vector<float> ux, uy, uz;      // velocity [dx/dt]
};

/// Force on the air in each cell [lattice units: mass dx/dt^2]; non-zero only in runs marked as forced.
struct BodyForce {
  std::vector<float> x, y, z;  // one value a slot
};

}  // namespace puffin::lbm
