#pragma once
// What the air does to carriers beside drag: lift, spin, its own pressure gradient, the nearness of walls.

#include "coupling/state.hpp"

namespace puffin::coupling {

/// Adds to the loads, which hold air velocity and drag already:
///   models.lift              : forces of lift.hpp; with Magnus also the torque on the spin, if carriers rotate
///   models.pressure_gradient (and always with VolumeFraction::averaged): -V grad p; in frozen air V rho (u . grad) u,
///   the same for a steady inviscid flow models.near_wall         : factors of near_wall.hpp on the drag along and
///   across the nearest wall
/// Vorticity and gradients come from the carriers' stencils, in frozen air from differences over a radius. A carrier
/// without a stencil gets nothing. Forces and torques are those of a single carrier times the carriers of a parcel; the
/// parcel's spin changes as the single carrier's would.
/// in: the interval [s] over which the loads will be held; terms that could overshoot in it are taken implicitly.
void add_field_forces(const Models& models, double interval, State& state);

/// The reaction of those forces on the air: adds to `impulse_on_air` [N s] what carriers that move took from it besides
/// drag. With VolumeFraction::averaged the pressure's part is left out: it stands in the air's own equation.
void add_field_reaction(double interval, State& state);

}  // namespace puffin::coupling
