#pragma once
// One sweep of the scalar transport along one direction, for one run of cells.
//
// A cell with air mass theta and concentration Y loses through its high face, if the air flows out there by the mass
// a > 0, the amount
//   a (Y + (1 - a/theta)/2 slope),   slope: limited rise of Y across the cell (limiters.hpp),
// and through its low face the mirror image; with diffusion, gamma Y' more through each face that is open to a
// neighbour, which does the same in return. `outgoing` computes what each cell loses, `update` takes it from there and
// gives it to the neighbour, and carries the air: theta <- theta - (net outflow). Both sides use the same number:
// conservative to rounding.
//
// No new extremum: the values at the faces lie between the cell and its neighbour, for the slope is at most twice the
// smaller difference. What stays behind, per air staying behind, is Y + b slope with |b| <= 1/2 max(a)/theta: again
// between the cell and its neighbours while the outflow through both faces is at most theta. The new Y is the
// air-weighted mean of what stayed and what came.
//
// With diffusion Y' = Y - drift slope is the concentration after the air has moved on, drift = (net outflow to the high
// side)/theta, at most 1/2, so that it too lies between the cell and its neighbour: advection and diffusion of one
// sweep are of second order in time together (with half the drift a cloud was 0.06 cells ahead whatever the size of the
// cells). What stays is (1 - nu) theta (Y - drift/2 slope), nu = outflow / theta, of which diffusion takes its
// exchange, gamma times the exchanging faces, times Y': the neighbour upstream and Y itself count with positive weights
// while that exchange is at most (1 - nu) theta/2. It is at most (1 - nu)^2 theta (sub_step.cpp); a cell where it is
// more than the half takes half the drift.
//
// Scalars that drift through the air leave with a = air + drift; the air does not move with them. So a cell between
// walls in which they gather gets a larger Y, not more air: in equilibrium Y falls as exp(-w z/D). Without new extrema
// in the part that follows the air; where the drift converges Y must grow.
// Source of the scheme: B. van Leer, J. Comput. Phys. 23, 276 (1977); of the carried air: R. C. Easter, Mon. Weather
// Rev. 121, 297 (1993).

#include <array>
#include <cstddef>
#include <cstdint>

#include "lbm/scalars/limiters.hpp"

namespace puffin::lbm {

/// Amounts below this are always left where they are: their products would be denormal numbers, which some processors
/// do slowly.
inline constexpr double dust = 1e-200;

/// A run of cells and its faces in the direction of the sweep; pointers are to the first cell. Up to Rows::padding
/// values beyond the last cell are read, none is written.
struct SweepRun {
  int count = 0;
  std::ptrdiff_t low = 0, high = 0;    // slot offsets to the neighbours
  const double* mass = nullptr;        // [cell] flux through the high face, lattice units per air step
  const std::uint8_t* open = nullptr;  // [cell] the high face: 0 closed, 1 open, 2 opening of the domain
  double steps = 0.0;                  // air steps
  double* air = nullptr;               // [cell] theta
  const double* eddy = nullptr;        // [cell] diffusivity of all scalars on top, at the high face; null: none
  const double* drift = nullptr;       // [cell] the scalars' own flux on top, as mass of air; null: none
};

/// One scalar along the run. What a face passes is rounded to Real before anything is taken or given: amounts are
/// conservative to the rounding of double for either.
template <class Real>
struct SweepScalar {
  Scheme scheme = Scheme::mc;
  double exchange = 0.0;  // gamma = steps * Gamma [lattice mass]
  double resting = dust;  // cells that hold no more than this give nothing away
  double* amount = nullptr;
  Real* concentration = nullptr;  // `update` leaves it out where it is null
  Real* out_high = nullptr;       // what leaves through the high and the low face
  Real* out_low = nullptr;
};

/// The faces of a run in all three directions, and what they ask of the number of steps (max_steps.hpp).
struct LimitRun {
  int count = 0;
  const double* mass[3] = {};        // [cell] through the high face
  const std::uint8_t* open[3] = {};  // [cell] of the high face
  std::ptrdiff_t low[3] = {};        // slot offsets to the low neighbours
  const double* air = nullptr;       // [cell] theta
  double cfl = 0.0;
  const double* drift[3] = {};  // [cell] on top of mass, or null
};
struct LimitFound {
  double demand = 0.0;           // largest cfl / steps
  std::array<double, 3> pair{};  // [middle] the same for each half of a mirrored pair of sub-steps
  double least_air = 0.0;        // smallest theta
};

/// What a run holds.
struct Content {
  double sum = 0.0, most = 0.0;  // most: of one cell
};

template <class Real>
struct RunSweep {
  void (*outgoing)(const SweepRun&, const SweepScalar<Real>*, int scalars) = nullptr;
  void (*update)(const SweepRun&, const SweepScalar<Real>*, int scalars) = nullptr;
  /// concentration = amount / air, 0 for what rests.
  void (*concentrate)(int count, const double* air, const SweepScalar<Real>*, int scalars) = nullptr;
};
struct SweepKernel {
  RunSweep<float> narrow;
  RunSweep<double> wide;
  LimitFound (*limit)(const LimitRun&) = nullptr;
  Content (*content)(int count, const double* amount) = nullptr;
  /// Largest |air - density| / density.
  double (*mismatch)(int count, const double* air, const double* density) = nullptr;
  template <class Real>
  const RunSweep<Real>& of() const {
    if constexpr (sizeof(Real) == sizeof(float))
      return narrow;
    else
      return wide;
  }
};

/// The same arithmetic, compiled for several processors: equal bits.
SweepKernel baseline_sweep();
// Null functions where the build does not contain them.
SweepKernel avx2_sweep();
SweepKernel avx512_sweep();
/// The best that this processor offers.
SweepKernel select_sweep();

}  // namespace puffin::lbm
