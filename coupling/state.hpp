#pragma once
// Everything that changes during a run, and everything that does not. Both plain data.
// A new member of State: coupling/checkpoint/state.cpp asks whether it belongs in a checkpoint.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/collisions.hpp"
#include "coupling/drag.hpp"
#include "coupling/fines.hpp"
#include "coupling/fines_drift.hpp"
#include "coupling/first_motion.hpp"
#include "coupling/lift.hpp"
#include "coupling/mesh_walls.hpp"
#include "coupling/regain_fines.hpp"
#include "coupling/release_fines.hpp"
#include "coupling/scale.hpp"
#include "coupling/time_step.hpp"
#include "coupling/transfer.hpp"
#include "dem/loads.hpp"
#include "dem/models.hpp"
#include "dem/state.hpp"
#include "lbm/air.hpp"
#include "lbm/inlet_turbulence.hpp"
#include "lbm/mass_book.hpp"
#include "lbm/mass_fluxes.hpp"
#include "lbm/pore_space.hpp"
#include "lbm/scalars/advance_scalars.hpp"
#include "micromodels/fines_models.hpp"

namespace puffin::coupling {

using Vec3 = Eigen::Vector3d;

/// What drives one patch of the surface, in SI units, as a function of time [s].
struct PatchDrive {
  std::string patch;
  std::function<double(double)> speed;     // inlet: section mean into the domain; moving wall: its speed [m/s]
  std::function<double(double)> pressure;  // outlet: gauge pressure [Pa]
  bool is_inlet = false, is_outlet = false;
  double area = 0.0;  // [m^2]
};

/// Where the carriers' own volume counts: nowhere, in the drag law, there and in the equations of the air and the
/// fines.
enum class VolumeFraction { none, in_drag, averaged };

/// Immutable during a run.
struct Models {
  Air air;                                       // density, viscosity (SI)
  std::vector<PatchDrive> patches;               // one for each boundary of lbm::Air
  std::vector<lbm::InletTurbulence> turbulence;  // of the inlets that have some
  std::function<Vec3(double)> body_force;        // [N/m^3]; empty: none
  std::function<Vec3(const Vec3&)> frozen_air;   // velocity [m/s] where there is no lattice; empty: no air at all
  TimeStepRule time_step;
  DragLaw drag = SchillerNaumann{};
  VolumeFraction volume_fraction = VolumeFraction::in_drag;
  Lift lift = Lift::none;
  bool pressure_gradient = false;  // force of the air's own pressure gradient on the carriers
  bool near_wall = false;          // drag grows beside walls
  dem::Models carriers;
  std::shared_ptr<const MeshWalls> walls;
  std::vector<int> opening_of_triangle;  // per triangle of the surface: patch if it is an opening, else -1
  bool two_way = true;
  bool settling = true;         // a dose settles first: its contacts before the first motion are not counted
  double carriers_start = 0.0;  // [s] until then carriers are held
  std::optional<micromodels::FinesModels> fines;
  double turbulent_schmidt = 0.0;   // of the eddies that the cells do not resolve; 0: they mix no fines
  std::vector<double> diffusion;    // per scalar: Gamma / rho [m^2/s]
  lbm::ScalarOptions scalars;       // diffusivity is set from `diffusion` each step
  std::optional<FinesDrift> drift;  // fines have inertia
  std::optional<Regain> regain;     // fines come back to carriers
  std::vector<int>
      triangle_of_slot;        // where walls can take fines: the nearest triangle to a cell beside a wall, else -1
  int steps_per_exchange = 5;  // air steps between two exchanges with moving carriers
  int steps_per_exchange_asleep = 16;
  bool idle_transport = true;   // leave the transport out until more than scalars.negligible fines are airborne
  bool transport_steps = true;  // transport in longer steps than the exchange interval where the flow allows it
};

/// A carrier that left through an opening.
struct Departure {
  std::int64_t id = -1;
  double time = 0.0;  // [s]
  int patch = -1;
  double carriers = 1.0;
};

/// From what stencils were built: enough to build them again.
struct StencilPlaces {
  std::vector<Vec3> position;  // [m]
  std::vector<double> radius;  // [m]
};

/// Seconds by phase of the work, and counts of what was left out.
struct Effort {
  double air = 0.0, links = 0.0, exchange = 0.0, carriers = 0.0, fines = 0.0, scalars = 0.0;  // [s]
  std::int64_t exchanges = 0, exchanges_saved = 0;      // saved: while every carrier slept
  std::int64_t scalar_steps = 0, scalar_steps_off = 0;  // off: air steps before that
  std::int64_t rescalings = 0;
  double steps_at_reference_dt = 0.0;  // air steps that a fixed time step would have taken
};

/// Largest departures from what the method is made for, since the start.
struct Extremes {
  double max_speed_lu = 0.0;
  double min_dt = 1e300, max_dt = 0.0, min_tau = 1e300;
};

struct State {
  double time = 0.0;  // [s]
  Scale scale;
  double step_factor = 1.0;  // of the time step; halved by each retreat from a failure

  std::optional<lbm::Air> air;
  lbm::MassBook air_mass;
  lbm::Drive drive;
  std::vector<double> inlet_way;  // [m] that the mean flow has gone since the start; one entry a Models::turbulence
  CellIndex cells;
  std::vector<char> touched;  // scratch: runs near carriers

  dem::State carriers;
  Fines fines;
  Collisions collisions;
  FirstMotion first_motion;
  std::vector<Departure> departures;
  dem::Events events;  // of the last exchange; the caller may read and must not keep references

  Stencils stencils;                 // of the last interval's start; the reaction of that interval belongs to them
  StencilPlaces stencils_at;         // what they were built from
  std::vector<std::int32_t> forced;  // cells on which the carriers' forces lie
  AirSamples samples;
  AirGradients gradients;  // only where a model needs them
  Spreader spreader;
  std::vector<Vec3> impulse_on_air;  // [N s] by place in `stencils`, to be given to the air in the next exchange
  std::vector<Vec3> force_on_air;    // [N] likewise, of carriers that rest: it acts throughout the next exchange
  double exchange_seconds = 0.0;     // [s] in which the carriers gathered the impulse, the last exchange
  double load_rate = 1e300;          // [1/s] the load G of drag_limit.hpp in a second, at most, at the last exchange
  MomentumBooking momentum;          // sums since the start [N s]
  std::vector<dem::Load> loads;
  lbm::PoreSpace pores;               // of VolumeFraction::averaged
  std::vector<Vec3> pressure_forces;  // [N] by carrier, the part of `loads` without reaction; only if averaged
  FinesRelease release;

  lbm::ScalarFields scalars;
  lbm::ScalarBudget budget;
  lbm::FaceFluxes fluxes;
  lbm::FluxRoutes routes;
  std::int64_t steps_since_scalars = 0;
  double steps_per_scalar_update = 1.0;
  bool airborne = false;      // enough fines have been released to carry them
  DriftVelocity fines_drift;  // empty without Models::drift

  Effort effort;
  Extremes extremes;
};

/// The physics left the range in which the method means anything.
class Diverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Moves everything by one exchange interval, at most to `until`: some air steps, one step of the carriers, fines.
/// This is the only place that orders the physics. Throws Diverged naming step, cell or carrier, value and limit.
void advance(const Models& models, double until, State& state);

}  // namespace puffin::coupling
