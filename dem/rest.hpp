#pragma once
// Falling asleep and waking.
//
// A carrier sleeps when, for Integration::sleep_steps air steps in a row,
//   * the net force on it is below 5 % of what holds it: the weakest of its contacts' pull-off and friction limits, and
//   of
//     its rolling resistance where it could roll away,
//   * it is so slow that this force would stop it within 1e-6 of its radius,
//   * no contact uses more than sleep_use of its limit.
// A sleeper is a fixed place to those that touch it. It wakes when the force on it (air, weight, and contacts with
// awake carriers) differs by more than wake_change of what holds it from the force it fell asleep under, when something
// new touches it, or when a neighbour is removed. Since sleep_use + wake_change <= 1 it wakes before any contact
// reaches its limit: release is computed awake.
// Waking in the middle of a step throws away what its cluster had computed. So a carrier whose sleep was shorter than
// ten times its wait must rest twice as long before the next, up to 64 times sleep_steps; after a sleep that lasted the
// wait is sleep_steps again.

#include <span>

#include "dem/cluster.hpp"
#include "dem/state.hpp"

namespace puffin::dem {

/// Wakes sleepers whose load has changed too much.
void wake_by_load(const Rules& rules, std::span<const Load> loads, State& state);

/// After a step: counts the steps at rest of the cluster's carriers and lets them fall asleep; notes how the contact
/// forces on its sleepers have changed.
void settle(const Rules& rules, const Cluster& cluster, State& state);

}  // namespace puffin::dem
