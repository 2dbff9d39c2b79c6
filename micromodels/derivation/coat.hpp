#pragma once
// Where the fines sit on a carrier.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace puffin::micromodels::derivation {

/// Directions (unit vectors from the carrier's centre) of `fines` spheres of radius `fine` [m] that touch a carrier of
/// radius `carrier` [m] and do not overlap: placed one after the other at random (random sequential addition).
/// patches = 0: over the whole carrier; else only within so many equal round patches at random places, as large as it
/// takes to cover 3/4 of the carrier.
/// Throws std::invalid_argument if they find no room.
std::vector<Eigen::Vector3d> place_fines(int fines, double fine, double carrier, int patches, std::uint64_t seed);

}  // namespace puffin::micromodels::derivation
