#pragma once
// What the momentum of links, partial cells and markers leaves out of the force on a wall (force_on_patch in air.hpp).

#include <vector>

#include "lbm/air.hpp"
#include "lbm/links.hpp"

namespace puffin::lbm {

/// Volume of the computed cells beyond the walls, less the fluid between the cells and the walls, per boundary [dx^3].
/// Walls end inside cells and immersed boundaries have a live band behind them; a body force G [force a volume] acts on
/// whole computed cells, and the walls take it: the force on a wall is force_on_patch less G times its excess.
/// A cell counts by its distance to the nearest wall along the normal: exact on average for any plane wall, to second
/// order in dx for curved ones.
std::vector<double> wall_excess(const Air& air, const LinkGeometry& surface);

}  // namespace puffin::lbm
