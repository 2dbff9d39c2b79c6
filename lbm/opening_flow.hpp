#pragma once
// How much air the links of an inlet bring.

#include <vector>

#include "lbm/links.hpp"

namespace puffin::lbm {

/// A link at the edge of an inlet, taken by a wall that slides: the wall carries air along in the links that it cuts,
/// from one end to the other, and the inlet's other links must bring so much less. Both for a unit speed of their own,
/// the wall's and the inlet's: what the link would have brought goes to the inlet's face of the cell, less what the
/// wall carries.
struct InletEdge {
  std::ptrdiff_t slot = 0;
  std::int16_t face = 0, wall = 0, inlet = 0, part = 0;
  double own = 0.0, carried = 0.0;
};

/// Inlets: the mean speed over the cells of the opening is the one asked for. On a grid that does not fit the opening
/// the cells cover a slightly different area; keeping the speed keeps the dynamic head, to which the pressure drop is
/// proportional (keeping the flow rate instead would put the error of the area twice into the pressure).
/// Where the profile falls to zero at the walls (exact_flow) the sum over the cells is the midpoint rule for the flow
/// rate whatever the fit, and the flow rate is kept.
/// Each face of an inlet of several is brought to its own share. Fills opening_cells_area, of outlets too. Throws
/// GeometryError if an opening, or a face of an inlet that has a hundredth of its area, touches no cell, or if a
/// profile does not point into the fluid.
void set_inlet_flow(const Rows& rows, const LinkGeometry& surface, const std::vector<InletEdge>& edges, Links& links);

}  // namespace puffin::lbm
