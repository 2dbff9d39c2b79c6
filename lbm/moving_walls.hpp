#pragma once
// Where the mass goes that a moving wall gives and takes.
//
// Reflection at a wall that moves with u adds -6 w_i c_i.u to the population that comes back along link i (links.hpp):
// mass for the cell on one side of a wall that slides, as much less for the cell before it. That is the half of the
// flow beside the wall which goes through the links that the wall has cut: mass carried along the wall from one cell to
// the next, so both keep what they got. At the end of the wall, where a wall at rest stands across, nothing is carried
// on: the link through that edge gains nothing. Without this every cell gave back what it gained, and the flow
// u dx/6 beside a lid ran on through the corners of its cavity: eddies 1.8 dx/L too weak.
// What finds no partner (a wall askew to the grid) is given back to its cell; so is all in a domain with openings: what
// the wall carries would pass them beside their links, and the books of the openings do not know of it.
// Checked by tests/lbm/test_moving_walls.cpp.

#include "lbm/links.hpp"
#include "lbm/rows.hpp"

namespace puffin::lbm {

/// Fills `returned` and `carried`, and takes the gain from links through edges to walls at rest. `moving` is there.
void carry_along_walls(const Rows& rows, const LinkGeometry& surface, Links& links);

}  // namespace puffin::lbm
