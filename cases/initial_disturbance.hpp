#pragma once
// The seed of turbulence where nothing else breaks a symmetry.

#include <Eigen/Core>
#include <functional>

#include "cases/case.hpp"

namespace puffin::cases {

/// A shape that repeats along a periodic direction, air that starts uniform and an inlet that is the same along it give
/// cells that compute the same to the last bit: the flow would stay two-dimensional for ever, whatever its Reynolds
/// number (behind a sudden widening with area ratio 2 the pressure then recovers 0.28 of the dynamic pressure instead
/// of 0.50). So such a run starts with independent random velocities in each cell, at most 1e-4 of the reference speed
/// in each component, chosen by numerics.seed and the cell's place. Laminar flow forgets them.
///
/// Returns the velocity [m/s] to be added at a cell's centre. Empty, so nothing is added: without an eddy viscosity
/// (the flow is taken as laminar), with an initial field of its own, or without a periodic direction of several cells.
std::function<Eigen::Vector3d(const Eigen::Vector3d&)> initial_disturbance(const Case& c, double reference_speed,
                                                                           double dx, const Eigen::Vector3d& box,
                                                                           const std::array<bool, 3>& periodic);

}  // namespace puffin::cases
