#pragma once
// Carriers that do not move: asleep, stuck to a wall, or not yet let go.

#include <cstddef>

#include "dem/carriers.hpp"

namespace puffin::coupling {

inline bool rests(const dem::Carriers& c, std::size_t p) { return c.rest[p] != dem::Rest::awake; }

/// How fast the air sees the carrier move [m/s]. One that is held has the velocity that it will be let go with.
inline Eigen::Vector3d motion_of(const dem::Carriers& c, std::size_t p) {
  return rests(c, p) ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : c.velocity[p];
}

}  // namespace puffin::coupling
