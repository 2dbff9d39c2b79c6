#pragma once
// Walls as a diffuse immersed boundary: markers on the surface hold the air around them at the velocity of the wall.
//
// The cells of a band behind the wall are alive. Each marker k reads the velocity around it and returns a force that
// brings it to that of the wall within the step (direct forcing; u contains half of the other forces):
//   U_k = sum_j w_kj u_j,   a_k = 2 c_k (U_wall - U_k),   F_j = rho_j sum_k w_kj a_k,
// w the three-point kernel of Roma, Peskin & Berger, J. Comput. Phys. 153, 509 (1999), scaled to sum 1 over the live
// cells on the marker's side. Interpolation after spreading is not the identity; the gain c_k undoes it in the sense of
// row sums, sum_l sum_j w_kj w_lj c_l = 1, so no iteration over the markers is needed (the idea of Gsell & Favier,
// J. Comput. Phys. 435, 110265 (2021)). The matrix is non-negative with row sums of at most 1, so its eigenvalues are
// at most 1 and the forcing never overshoots.
//
// A marker lies `retraction` cells behind the surface: the kernel reaches 1.5 cells to both sides, and what is held
// still in the fluid would narrow it (docs/decisions/0007-walls.md).

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/band_level.hpp"
#include "lbm/marker_options.hpp"
#include "lbm/rows.hpp"
#include "lbm/wall_kernels.hpp"
#include "lbm/wall_sides.hpp"

namespace puffin::lbm {

/// One side of the coupling in compressed rows: entries [first[n], first[n+1]) of `other` and `weight`.
struct Weights {
  std::vector<std::int32_t> first{0}, other;
  std::vector<float> weight;
};

struct Markers {
  // Cells that some marker touches, in the order of the rows; numbered by place.
  std::vector<CellSegment> segments;
  std::vector<std::size_t> segment_chunks;  // boundaries of the parts given to threads
  std::vector<float> state;                 // [cells][4]: u_x, u_y, u_z, rho before the collision
  std::vector<std::int32_t> slot;           // per cell
  Weights cell_markers;                     // per cell: its markers
  // Markers, sorted by the cell they lie in.
  Weights marker_cells;             // per marker: its cells
  std::vector<float> gain;          // 2 c_k
  std::vector<float> wall;          // [markers][4]: velocity of the surface for a unit wall speed
  std::vector<float> push;          // [markers][4]: a_k of the last step
  std::vector<float> mass;          // [markers] sum_j w_kj rho_j of the last step
  std::vector<std::int16_t> patch;  // per marker
  // What the kernel reads: force of the markers and all others, and the flags of the runs.
  std::array<std::vector<float>, 3> force;  // per slot
  std::vector<std::uint8_t> run_flags;      // per run
  std::vector<std::uint8_t> touched_runs;   // per run: has a marker's cell
  std::vector<std::uint8_t> foreign_runs;   // per run: others' forces were copied in the last step
  BandLevel level;
  std::size_t few_cells = 0;  // markers with fewer than 4 live cells

  std::size_t cells() const { return slot.size(); }
  std::size_t count() const { return gain.size(); }
};

/// The kernel of Roma, Peskin & Berger, of a distance in cells.
double roma_kernel(double r);

/// The retraction [cells] with which laminar walls lie where they are: 0.78 where tau0 <= 0.51, 0.6 from 0.6 on, linear
/// between (measured: docs/decisions/0007-walls.md).
double retraction_for(double tau0);

/// Places markers on all walls. Throws std::runtime_error if a wall got none.
Markers place_markers(const Rows& rows, const WallSides& sides, const LinkGeometry& surface,
                      const MarkerOptions& options);

/// Scales `gain` so that row sums of interpolation after spreading are 1: see above. Exposed for the tests.
std::vector<double> row_sum_gain(const Weights& marker_cells, const Weights& cell_markers,
                                 const std::vector<double>& area);

}  // namespace puffin::lbm
