#pragma once
// What the air does to carriers beside drag: lift, spin, its own pressure gradient, the nearness of walls.

#include <span>
#include <vector>

#include "coupling/state.hpp"

namespace puffin::coupling {

/// Adds to the loads, which hold air velocity and drag already:
///   models.lift              : forces of lift.hpp; with Magnus also the torque on the spin, if carriers rotate
///   models.pressure_gradient (and always with VolumeFraction::averaged): -V grad p; in frozen air V rho (u . grad) u,
///   the same for a steady inviscid flow
/// Vorticity and gradients come from the carriers' stencils, in frozen air from differences over a radius. A carrier
/// without a stencil gets nothing. Forces and torques are those of a single carrier times the carriers of a parcel; the
/// parcel's spin changes as the single carrier's would.
/// in: the interval [s] over which the loads will be held; terms that could overshoot in it are taken implicitly.
void add_field_forces(const Models& models, double interval, State& state);

/// How much more drag a carrier has beside the nearest wall, by near_wall.hpp: factors along and across it.
struct WallFactors {
  Vec3 normal = Vec3::Zero();
  double along = 1.0, across = 1.0;
};

/// By carrier; empty unless models.near_wall.
std::vector<WallFactors> find_wall_factors(const Models& models, const State& state);

/// Adds to the loads the force of what drag is more across walls than along them: `excess` [kg/s] by carrier index.
void add_drag_across(std::span<const WallFactors> factors, std::span<const double> excess, double interval,
                     State& state);

/// What of those forces [N] on carrier `p` the air gives, beside drag. With VolumeFraction::averaged the pressure's
/// part is left out: it stands in the air's own equation.
Vec3 force_beside_drag(std::size_t p, const State& state);

}  // namespace puffin::coupling
