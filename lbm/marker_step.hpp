#pragma once
// The markers' part of a step.

#include "lbm/air.hpp"

namespace puffin::lbm {

/// Reads the air around the markers and lays their force, with that of others in air.force, where the kernel reads it.
/// To be done before each collision. Same bits for every number of threads: each marker and each cell sums its own
/// entries in a fixed order.
void push_from_markers(const Drive& drive, double wall_speed, Air& air);

}  // namespace puffin::lbm
