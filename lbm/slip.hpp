#pragma once
// Slip walls: the air slides along without friction. Specular reflection at the faces of the cells.
//
// A population that runs against the wall comes back with its wall-normal velocity turned round and its tangential
// velocity kept: what arrives at x in direction (-n, -t) left x + t in direction (n, -t) half a step before it met the
// wall between. Mass and tangential momentum are kept exactly, so there is no shear stress at the wall. Exact for
// planes along the grid that lie on cell faces; other planes along the grid act where the nearest cell faces are. In
// corners and beside walls with friction, where no such cell exists, the population comes back the way it went. Source:
// Succi, The Lattice Boltzmann Equation (2001), section 6.2.2 (free slip).

#include <vector>

#include "lbm/links.hpp"
#include "lbm/populations.hpp"

namespace puffin::lbm {

/// Finds for every slip link the cell and direction whose population it returns. In: links in the order of the slots
/// with slot, run, direction and patch set.
void join_slip_links(const Rows& rows, std::vector<SlipLink>& links);

/// To be done between a collision of kind `last` and the next, in any order with the other links.
template <class T>
void reflect_at_slip_walls(const Rows& rows, const std::vector<SlipLink>& links, Parity last, Populations<T>& p);

}  // namespace puffin::lbm
