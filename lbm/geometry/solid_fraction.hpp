#pragma once
// How much of a cell is fluid: exact volumes of the cells that the surface cuts.

#include <cstdint>
#include <vector>

#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxels.hpp"

namespace puffin::lbm::geometry {

/// A cell that the surface cuts. Shares of its volume: inside the surface; beyond an opening (swept from the opening
/// outwards along the axis nearest to its normal, so that an opening that cuts a cell is no wall); the rest is solid.
struct CutCell {
  std::int64_t cell = 0;  // Voxels::index
  double fluid = 0.0;
  double beyond = 0.0;

  double solid() const { return 1.0 - fluid - beyond; }
};

/// Every cell whose share of fluid differs by more than 1e-9 from that of its centre (1 or 0, as `voxels` says), and
/// every cell that an opening cuts, sorted by cell; all others are wholly fluid or wholly solid as `voxels` says. Cells
/// farther than a neighbour (of 26) from any fluid cell are left out: those of dropped pockets, and the tips of gaps
/// that hold no cell centre. `openings`: per triangle 1 = part of an opening; empty: none.
///
/// Method: with the winding number w that a line along x has picked up from triangles before it, the integral of w over
/// a cell is sum_t s_t integral clamp(x_high - x_t(y,z), 0, dx) dy dz over the part of triangle t's shadow in the
/// cell's column, s_t = -1, +1 the sign of its normal along x: a sum over triangles clipped to the cell (Sutherland &
/// Hodgman, Commun. ACM 17, 32 (1974)), exact to rounding (below 1e-9) wherever w is 0 or 1. A surface that overlaps
/// itself has cells where w is neither; cells in which it crosses itself are then measured along lines
/// (union_fraction.hpp): error below 1e-3. Cost and memory in proportion to the cut cells.
///
/// Throws GeometryError if the surface is not closed or inside out, std::invalid_argument for openings of the wrong
/// length.
/// Checked by: tests/lbm/geometry/test_solid_fraction.cpp
std::vector<CutCell> cut_cells(const TriangleTree& tree, const Voxels& voxels, const std::vector<char>& openings = {});

}  // namespace puffin::lbm::geometry
