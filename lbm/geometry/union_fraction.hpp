#pragma once
// The share of one cell inside a surface that overlaps itself. Used by cut_cells only.

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Share of the cube of edge `dx` around `centre` where |winding number| > 1/2, of a closed surface; `mean_winding` is
/// the exact mean of the winding number over the cube. If the corners and the centre of the cube lie in 0 or 1 turns,
/// that mean is the answer; if all lie in at least one turn, the answer is 1. Else (the surface crosses itself in the
/// cube) the length inside is summed over 4096 lines through the cube along x, spread by the additive recurrence of the
/// plastic number (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018): each is exact along
/// itself, and a plane along the lines is off by the discrepancy of the points, below 1e-3.
double union_fraction(const TriangleTree& tree, const Vec3& centre, double dx, double mean_winding);

}  // namespace puffin::lbm::geometry
