#pragma once
// Scalars carried by the air: what is stored, what can be chosen, what has left.
//
// A scalar is kept as the AMOUNT in each cell (a number of fines, say), so that sums over cells are the ledger. What
// the air carries is the concentration Y = amount / air mass of the cell. Equation (thesis 2.12 with alpha = 1):
//   d(rho Y)/dt + div(rho u Y - Gamma grad Y) = source.
// Any number of scalars share one flow. Ghost and padding slots always hold zero.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lbm/rows.hpp"
#include "lbm/scalars/compensated_sum.hpp"
#include "lbm/scalars/limiters.hpp"

namespace puffin::lbm {

enum class WallRule {
  reflect,  // nothing passes a closed face
  absorb    // Y = 0 on every closed face, half a cell away: what diffuses there is taken out and booked
};

/// How one scalar is carried.
struct ScalarLaw {
  Scheme scheme = Scheme::mc;
  double diffusivity = 0.0;  // Gamma / reference density, lattice units: dx^2 per air step; >= 0
  WallRule wall = WallRule::reflect;
  /// [patch] the concentration held on an opening or a wall: the scalar diffuses to and from the face, half a cell
  /// away, and inflow brings it. No value (or a shorter list): inflow brings none, nothing diffuses through an opening,
  /// and a wall does as `wall` says.
  std::vector<std::optional<double>> fixed = {};
};

struct ScalarOptions {
  std::vector<ScalarLaw> scalar;
  double cfl = 0.8;  // largest part of a cell's air that leaves it in one sweep, in (0, 1)
  /// Leave out runs whose cells all rest (each less than 1e-30 of the scalar) and that have no other neighbour. Changes
  /// no bit unless diffusion limits the sub-steps, or a second one is needed: then they come from the computed runs.
  bool skip_empty = true;
  /// A scalar of which the domain holds no more than this rests where it is until there is more; 0: none rests.
  double negligible = 0.0;
  /// Concentrations, and with them what a face passes, in float: half the traffic, twice the numbers in a register. The
  /// amounts stay double, what leaves one cell enters the next to the bit; a constant concentration is constant to
  /// 1e-6 over 300 updates of a random flow.
  bool single = false;
};

/// What passed the boundaries since the start, in amounts.
struct ScalarBudget {
  ScalarBudget() = default;
  ScalarBudget(const Rows& rows, int scalars, int patches);

  std::vector<std::vector<CompensatedSum>> left, entered;  // [scalar][patch], both >= 0
  std::vector<std::vector<double>> absorbed_at;            // [scalar][slot] taken by the closed faces of a cell
  double air_mismatch = 0.0;   // largest |carried air - the lattice's density| / density seen at the start of an update
  std::int64_t sub_steps = 0;  // sub-steps and pairs done
  std::int64_t cells_computed = 0, cells_skipped = 0;  // cells x sub-steps and pairs
};
double absorbed(const ScalarBudget& budget, int scalar);
/// left - entered over all patches, plus absorbed.
double gone(const ScalarBudget& budget, int scalar);

/// Of each scalar and slot, [scalar * slots + slot]: made at the first update that asks for it.
template <class Real>
struct ScalarScratch {
  std::vector<Real> concentration, out_high, out_low;  // out: leaves through a face in one sweep
};

/// Scratch of advance_scalars, what it derives once from the rows, and held_walls, which the caller gives. No state: a
/// checkpoint leaves it out.
struct ScalarWork {
  struct OpeningFace {
    std::ptrdiff_t cell, ghost;
    int patch;
    bool ghost_is_high;  // the ghost lies in + direction of the cell
  };
  std::array<std::vector<OpeningFace>, 3> openings;  // [d]
  /// A closed face of a cell, on its high side or its low one, and the patch that it belongs to.
  struct WallFace {
    std::ptrdiff_t cell = 0;
    int patch = 0;
    bool high = false;
  };
  std::array<std::vector<WallFace>, 3>
      held_walls;  // [d] those on which some scalar may hold a value; given from outside
  std::array<std::vector<std::array<std::ptrdiff_t, 2>>, 3>
      periodic;                      // [d] (ghost beside a cell in d, cell it mirrors)
  std::vector<std::int32_t> run_of;  // [slot] -1: no active cell
  std::vector<int> opening_patch;    // [slot] -1: not in an opening
  std::array<std::vector<std::int32_t>, 3> neighbour_begin, neighbour_runs;  // [d] runs that share a face in d, by run
  /// [d][run] everything behind the faces in d lies in the run's own chunk: no opening, no periodic face.
  std::array<std::vector<std::uint8_t>, 3> local;
  ScalarScratch<float> narrow;                                      // used where ScalarOptions::single
  ScalarScratch<double> wide;                                       // or where not
  std::vector<double> seen;                                         // [slot] what diffuse_lines lets diffuse
  std::vector<double> held_count, held_sum;                         // [slot] 0, but for cells at held faces in there
  std::vector<std::uint8_t> computed;                               // [run] taking part in this update
  std::vector<int> moving;                                          // the scalars that do
  std::array<std::vector<std::int32_t>, 3> line_slots, line_begin;  // [d] lines of cells for implicit diffusion
  std::array<std::vector<std::uint8_t>, 3> line_closes;             // [d][line] its ends are periodic neighbours
  bool checked = false;                                             // the fluxes have been checked

  template <class Real>
  ScalarScratch<Real>& scratch() {
    if constexpr (sizeof(Real) == sizeof(float))
      return narrow;
    else
      return wide;
  }
};

struct ScalarFields {
  ScalarFields() = default;
  /// opening_patch[slot]: patch index of the ghosts that lie in an opening of the domain, -1 elsewhere (size
  /// rows.slots(); may be empty if there are no openings). Throws std::invalid_argument if the sizes disagree.
  ScalarFields(const Rows& rows, int scalars, const std::vector<int>& opening_patch = {});

  int scalars() const { return static_cast<int>(amount.size()); }

  std::vector<std::vector<double>> amount;  // [scalar][slot] >= 0; add sources here, at active cells
  bool reversed = false;                    // the next update sweeps z, y, x (state: belongs in a checkpoint)
  std::vector<double> air;                  // [slot] carried air mass of the cells last computed, lattice units
  ScalarWork work;
};

/// Everything of one scalar that is in the domain; compensated, in the order of the slots.
double total(const ScalarFields& fields, int scalar);

}  // namespace puffin::lbm
