#pragma once
// Stencils that walls cut: which cells belong to them, and what leads their reading back to the carrier's place.
//
// Cut and scaled to sum 1, the weights w_j have their mean place x_m further from the wall than the carrier's x_p, by
// up to a cell: 36 um above a floor, on cells of 250 um, a shear flow would be read at 144 um. The reading is
//     u_p = sum_j w_j u_j + g.(x_p - x_m),   g = C^-1 sum_j v_j (x_j - x_v) u_j,                                   (1)
// C = sum_j v_j (x_j - x_v)(x_j - x_v)^T, x_v = sum_j v_j x_j: exact for linear fields, for any weights v > 0. They are
// w where the cells of the stencil differ in every direction, so that C is regular; where they lie in one layer (a
// carrier whose nearest cell is solid), those of a block one cell wider. In a direction in which that one is flat too,
// in a gap of one cell, nothing is corrected. (1) is linear in the u_j; its weights depend on places alone and are kept
// with them:
//     u_p = sum_j w_j u_j + sum_j s_j u_j,   sum s_j = 0.
// How far the second sum may go: transfer.hpp. Spreading keeps w: it conserves momentum, and s has both signs.
// Rejected: reading u_m on a straight line to the wall, with the wall's distance and speed. It never overshoots, but
// has to know what each wall does (rests, moves, slips, is modelled), and costs a search of the surface a carrier.
// Checked by: tests/coupling/test_cut_stencil.cpp

#include <array>
#include <span>
#include <vector>

#include "coupling/cell_index.hpp"
#include "coupling/stencils.hpp"

namespace puffin::coupling {

/// Room for one block of cells around a carrier.
struct Block {
  std::vector<std::int32_t> slots;
  std::vector<double> weights;
  std::vector<char> reached;
  std::vector<int> todo;
};

/// Drops the weights of cells of a block of width^3 that are not connected, through faces of its active cells, to its
/// cell `seed`; -1: to the heaviest active one.
void keep_connected(int width, Block& block, int seed = -1);

/// s_j of eq. (1). in: the nearest cell `base` of the carrier and the carrier's place `offset` from its centre [cells];
/// reach of the stencil; its entries, whose weights sum to 1.
void find_shifts(const CellIndex& cells, const std::array<int, 3>& base, const Eigen::Vector3d& offset, int reach,
                 std::span<const StencilEntry> entries, Block& block, std::vector<Shift>& shifts);

}  // namespace puffin::coupling
