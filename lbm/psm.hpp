#pragma once
// Walls as partially saturated cells: a cell that is solid in part relaxes in part towards the solid.
//
//   f*_i = (1 - B) f*_i(fluid) + B [ f_o + feq_i(rho, u_s) - feq_o(rho, u) ],      o opposite to i,
//   B = eps (tau - 1/2) / ((1 - eps) + (tau - 1/2)),
// eps the solid share of the cell, u_s the velocity of the surface; the term in brackets turns round what is not
// equilibrium. Source: Noble & Torczynski, Int. J. Mod. Phys. C 9, 1189 (1998). Conserves mass; eps = 0: fluid,
// eps = 1: full-way bounce-back. Links to cells that are wholly solid reflect half-way.
//
// As tau -> 1/2 the weight B vanishes and a cell that is half solid would let the air pass; so tau is taken at least as
// `least_tau`, whatever the viscosity (docs/decisions/0007-walls.md).

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/active_cells.hpp"
#include "lbm/rows.hpp"
#include "lbm/wall_kernels.hpp"

namespace puffin::lbm {

/// The cells that are solid in part, in the order of the rows.
struct PartialCells {
  std::vector<CellSegment> segments;
  std::vector<std::size_t> chunks;          // boundaries of the parts of `segments` given to threads
  std::vector<float> solid;                 // eps, one a cell
  std::array<std::vector<float>, 3> wall;   // velocity of the surface for a unit wall speed; empty: at rest
  std::vector<std::int16_t> patch;          // of the nearest wall
  std::array<std::vector<float>, 3> taken;  // momentum that the solid took in the last step
  std::vector<float> kept_float;            // between a collision and the links: [20][cells], B f_i(solid) and B
  std::vector<double> kept_double;
  std::size_t cells() const { return solid.size(); }
};

/// Smallest tau in B.
extern const double psm_least_tau;
/// Cells with a smaller share of fluid are taken as solid.
inline constexpr double least_fluid = 0.01;

/// B of the equation above.
inline double solid_weight(double eps, double tau) { return eps * (tau - 0.5) / ((1.0 - eps) + (tau - 0.5)); }

/// Finds the cut cells among the rows of `cells.computed`.
PartialCells find_partial_cells(const Rows& rows, const ActiveCells& cells, const LinkGeometry& surface,
                                bool double_precision);

}  // namespace puffin::lbm
