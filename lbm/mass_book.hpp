#pragma once
// The mass of air that nothing lets in or out. Rounding in single precision takes about 1e-11 of it a step, always in
// one direction; in a device an outlet holds the density, in a closed or periodic box nothing does, and an hour's run
// would lose 1e-6 and more. So every `steps_between_looks` steps the sum of rho - 1 is compared with the one at the
// start, and what is missing is given back evenly to the populations at rest, which carry no momentum. What was lost
// and what was returned is counted, and belongs to the results of a run.
//
// A look costs as much as a step, so 0.05 % of the air's time. Nothing is given back below `least_return` a cell: there
// the populations themselves are no finer. Sums have a fixed order: equal bits for any number of threads.
// Decision 0011. Checked by: tests/lbm/test_mass_book.cpp

#include <cstdint>

#include "lbm/air.hpp"
#include "lbm/pore_space.hpp"

namespace puffin::lbm {

/// One air's mass. The sums are in cells of air at density 1.
struct MassBook {
  std::int64_t cells = 0;        // of air, over which is shared; 0: nothing has been booked yet
  double booked = 0.0;           // sum of rho - 1 at the first look
  double missing = 0.0;          // of that, at the last look
  double returned = 0.0;         // since the start
  std::int64_t corrections = 0;  // looks at which something was returned

  /// All that rounding has taken up to the last look, as a part of the air's mass.
  double lost_share() const { return cells > 0 ? (returned + missing) / static_cast<double>(cells) : 0.0; }
  double returned_share() const { return cells > 0 ? returned / static_cast<double>(cells) : 0.0; }
  double missing_share() const { return cells > 0 ? missing / static_cast<double>(cells) : 0.0; }
};

inline constexpr std::int64_t steps_between_looks = 2000;
/// [density] Populations at rest reach 2^-8 at a speed of 0.1, where single precision counts in steps of 2^-31.
inline constexpr double least_return = 1.0 / (1 << 28);

/// Whether no opening lets air in or out.
bool is_closed(const Air& air);

/// To be called after each step of a closed air; `rescale`: of that step (CollisionConstants), by whose square the
/// excess of density was multiplied. `pores`: of the volume-averaged equations, or empty.
void keep_mass(double rescale, const PoreSpace& pores, Air& air, MassBook& book);

}  // namespace puffin::lbm
