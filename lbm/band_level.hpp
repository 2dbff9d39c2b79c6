#pragma once
// The pressure in the live band behind a wall with markers (markers.hpp) is that of the air before the wall.
//
// Markers brake the two or three rows of cells around them alike, while the air drags the first of them alone. So the
// air in the band is driven against the flow. In a band without ends it goes round slowly; in one that ends at openings
// a pressure has to hold it, about ten rho/2 U^2 in a channel, which the cells of the fluid feel through their links.
// Therefore each cell b of the band is reckoned to the fluid cell that is nearest to it through open faces, its root r,
// and before every eighth collision takes over from it
//   m_b = share_r (rho_r - rho_b),   f_i(b) += w_i m_b,   f_i(r) -= w_i m_b:
// mass that keeps its place among root and band, and so all balances, and no momentum.
// Measured: docs/results/walls/ibm-openings.csv.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lbm/links.hpp"
#include "lbm/populations.hpp"

namespace puffin::lbm {

struct BandLevel {
  struct Cell {
    std::ptrdiff_t slot = -1;
    std::int32_t run = -1;
  };
  std::vector<Cell> roots;             // fluid cells with cells of the band behind them
  std::vector<std::int32_t> first{0};  // of `cells`, one more than roots
  std::vector<Cell> cells;             // of the band
  std::vector<float> share;            // per root: 0.16, or less where more than three cells belong to it
};

/// [slot] the root of each computed cell: itself for a fluid cell, -1 where no open faces lead to one. Nearest by the
/// number of faces; of several the first in the order of the rows and axes.
std::vector<std::ptrdiff_t> band_roots(const Rows& rows, const std::vector<std::uint8_t>& fluid, const Links& links);

BandLevel find_band_level(const Rows& rows, const std::vector<std::uint8_t>& fluid, const Links& links);

inline constexpr int steps_between_levels = 8;

/// To be done before a collision, once in steps_between_levels. Same bits for every number of threads.
template <class T>
void level_band(const BandLevel& level, const Rows& rows, Populations<T>& p);

}  // namespace puffin::lbm
