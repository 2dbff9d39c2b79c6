#pragma once
// The carriers' part of one air step.

#include <span>

#include "dem/events.hpp"
#include "dem/loads.hpp"
#include "dem/models.hpp"
#include "dem/state.hpp"
#include "dem/walls.hpp"

namespace puffin::dem {

/// Moves all carriers over `duration` [s] under constant `loads` (one a carrier), gravity and contacts.
///
/// Only what needs small steps pays for them. Carriers that touch nothing take the closed form of free flight; carriers
/// that touch, or may touch, are gathered in clusters, and each cluster takes sub-steps as its stiffest contact asks;
/// sleeping carriers are fixed places that watch the force on them. The clusters are a guess that is checked: if a
/// carrier left its predicted path so far that it may have met one outside its cluster, or if a sleeper was pushed
/// beyond its limit, the clusters are enlarged and only those are computed again. Nothing is written to `state` before.
///
/// Changes `state` (carriers, histories, drag_impulse of this call, time, statistics) and appends to `events`.
/// The result has the same bits for every number of threads.
/// Throws std::invalid_argument for a bad duration, models, or number of loads; Failure (failure.hpp) if a carrier's
/// state is not finite, or its contacts need too many sub-steps; Interrupted if the models' asked_to_stop says so.
void advance(double duration, const Models& models, const Walls& walls, std::span<const Load> loads, State& state,
             Events& events);

}  // namespace puffin::dem
