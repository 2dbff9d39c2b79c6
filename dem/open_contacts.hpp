#pragma once
// Contacts that nothing has ended yet, for the log: at the end of a run, or when a carrier is taken out.

#include <cstdint>
#include <span>
#include <vector>

#include "dem/events.hpp"
#include "dem/state.hpp"

namespace puffin::dem {

/// All live contacts, in the order of their places, as if they ended at `time` [s].
std::vector<ContactEnded> open_contacts(const State& state, double time);

/// Those of the carriers with chosen[i] != 0 (one entry a carrier) alone. Call it before remove().
std::vector<ContactEnded> open_contacts(const State& state, double time, std::span<const std::uint8_t> chosen);

/// 1/2 m v^2 [J] of a contact at first touch: m of one real carrier (mean of the two), v wall-normal or relative.
double impact_energy(const Contact& contact, double mean_mass);

}  // namespace puffin::dem
