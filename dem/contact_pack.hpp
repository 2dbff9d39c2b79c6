#pragma once
// The common live contact, linear and between two carriers, eight at a time. What is rare or general goes one by one
// through contact_step.cpp, which follows the same law text (contact_law.inc.hpp).

#include <cstdint>

#include "dem/body.hpp"
#include "dem/springs.hpp"

namespace puffin::dem {

/// Forces of the live linear contacts between carriers of one block after a sub-step h [s]; their springs move. Returns
/// the largest next sub-step [s] that they allow. Sets the bits in `events` of lanes where a contact ends or bonds;
/// these are left as they were. Writes nothing but the block and its eight pulls: blocks run in parallel.
using PairContacts = double(const SpringLaw& law, double h, const Body* bodies, const PairConstants* pairs,
                            Springs& block, Pull* pulls, std::uint32_t& events);

namespace baseline {
PairContacts* pair_contacts();
}
namespace avx2 {
PairContacts* pair_contacts();
}
namespace avx512 {
PairContacts* pair_contacts();
}

/// The one for this processor; the environment's PUFFIN_ISA = baseline, avx2 or avx512 asks for less. All give the same
/// bits.
PairContacts* pair_contacts();

}  // namespace puffin::dem
