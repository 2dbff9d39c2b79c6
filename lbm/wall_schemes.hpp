#pragma once
// What walls that act on whole cells do around a collision; nothing for walls that act on links alone.

#include "lbm/air.hpp"

namespace puffin::lbm {

/// Speed of the walls that move [lattice units].
double wall_speed(const Drive& drive, const Air& air);

/// Before a collision, on what arrived: partially saturated cells keep what the solid makes of it, markers lay their
/// forces.
void prepare_walls(const CollisionConstants& constants, const Drive& drive, Air& air);

/// Brings what walls keep between steps up to the present populations, for those who read the air: forces of markers.
void settle_walls(const Drive& drive, Air& air);

/// After a collision and before the links: partially saturated cells mix in what they kept.
void blend_partial_cells(Air& air);

/// What markers or partial cells took from the air in the last step, of one boundary: the force on it.
std::array<double, 3> force_on_cells(const Air& air, int boundary);

}  // namespace puffin::lbm
