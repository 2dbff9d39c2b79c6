#pragma once
// What a run needs to go on as if it had never stopped, bit for bit, with any number of threads.
//
// Saved is what the next step reads and cannot find again: populations and their parity, carriers with contacts, rest,
// neighbours and remembered walls, fines, ledgers, counts. Left out is what is built from the case (cells, links,
// models) and what each step makes anew (moments, forces in the cells, stencils, mass fluxes, scratch).

#include <cstdint>

#include "coupling/checkpoint/file.hpp"
#include "coupling/state.hpp"

namespace puffin::coupling {

/// Sections "time", "air", "carriers" and "fines" of the state; other sections stay as they are. The state must be
/// between two calls of advance().
void save(const State& state, Checkpoint& checkpoint);

/// Into a state that was built from the same case. Throws CheckpointDamaged if a section is missing, does not suffice
/// or contradicts itself or the state's lattice; the state may then be half changed and must be restored from another
/// checkpoint, which it is ready for, or thrown away.
void restore(const Checkpoint& checkpoint, State& state);

/// A number that two lattices share only if cells, walls and openings are the same; 0 without air.
std::uint64_t fingerprint(const State& state);

// The part of the carriers, carriers.cpp.
void save_carriers(const dem::State& carriers, std::vector<std::byte>& bytes);
void restore_carriers(const std::vector<std::byte>& bytes, dem::State& carriers);

}  // namespace puffin::coupling
