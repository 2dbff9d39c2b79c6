#pragma once
// The laws of the carriers as immutable values: contact, adhesion, gravity, walls, integration.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <variant>

namespace puffin::dem {

/// Coulomb friction, F_t <= mu F_n (thesis eq. 2.4), with one coefficient.
struct ConstantFriction {
  double coefficient = 0.3;  // mu, >= 0
};

/// mu as a function of the sliding speed v (thesis eq. 2.4; the friction collision law of Fluent's DEM).
/// v < slip_speed: mu = stick + (stick - slip) (v/slip_speed - 2) v/slip_speed, which falls smoothly from stick to
/// slip; slip_speed <= v < limit_speed: linear from slip to limit; beyond: limit.
struct SpeedFriction {
  double stick = 0.5, slip = 0.2, limit = 0.1;  // coefficients, >= 0
  double slip_speed = 1.0, limit_speed = 10.0;  // 0 < slip_speed < limit_speed [m/s]
};

using Friction = std::variant<ConstantFriction, SpeedFriction>;

/// Linear spring and dashpot (thesis eq. 2.3) with Coulomb friction on a tangential spring (Cundall & Strack 1979).
struct LinearContact {
  double restitution = 0.6;  // e of the dashpot, 0 < e <= 1, the same at every stiffness
  Friction friction = ConstantFriction{};
  double rolling_friction = 0.0;        // mu_r: rolling moment <= mu_r R* F_n; needs Models::rotation
  std::optional<double> stiffness;      // k [N/m] of every contact; empty: each contact its own, from max_overlap
  double max_overlap = 0.02;            // largest overlap of an impact, as a part of the (smaller) diameter
  double tangential_ratio = 2.0 / 7.0;  // k_t / k
};

/// Elasticity of one body.
struct Elasticity {
  double youngs_modulus = 0.0;  // E [Pa], > 0
  double poisson = 0.0;         // nu, 0 to 0.5
};

/// Hertz-Mindlin (hertz.hpp): F_n = 4/3 E* sqrt(R*) delta^1.5 with the dashpot of Tsuji et al. (1992) that returns the
/// restitution, F_t on a spring 8 G* a with Coulomb's limit. The force never pulls without adhesion.
struct HertzContact {
  double restitution = 0.6;  // 0 < e <= 1
  Friction friction = ConstantFriction{};
  double rolling_friction = 0.0;  // as LinearContact
  Elasticity body, partner;       // of the carrier, and of what it touches
};

using ContactModel = std::variant<LinearContact, HertzContact>;

/// Surface energies of the carriers differ: log-normal with `sigma` around the given value, the median
/// (adhesion_spread.hpp).
struct Spread {
  double sigma = 0.0;  // of ln(gamma), >= 0
  std::uint64_t seed = 1;
};

struct NoAdhesion {};

/// How the adhesion of a parcel of diameter ratio l = R_parcel/R_single grows: l^1 is the sphere-size law on the
/// parcel's own radius (Fluent DDPM, the thesis), l^2 keeps force per area, l^3 keeps force and energy per mass.
enum class ParcelScaling { ddpm, energy, mass };

/// van der Waals adhesion of smooth spheres (Hamaker) with the force limited below the gap d0:
/// F0 = H R*/(6 d0^2) = 4 pi gamma R* at contact, well depth U = H R*/(6 d0) = F0 d0 (thesis eq. 2.5-2.6).
struct Hamaker {
  double surface_energy = 0.0;  // gamma [J/m^2], > 0
  double hamaker = 0.0;         // H [J]; 0: from gamma and d0. Else it must agree with 24 pi d0^2 gamma within 5 %
  double cutoff_gap = 4e-10;    // d0 [m]
  ParcelScaling parcel_scaling = ParcelScaling::ddpm;
  Spread spread = {};
};

/// DMT (dmt.hpp), pull-off 4 pi gamma R*. With HertzContact: the force law itself, which needs the true moduli. With
/// LinearContact the spring is softer than the body, and a constant attraction would store energy in it that nature
/// does not: then force and well are booked as for Hamaker, U = F0 cutoff_gap.
struct Dmt {
  double surface_energy = 0.0;  // gamma [J/m^2], > 0
  double cutoff_gap = 4e-10;    // [m]
  ParcelScaling parcel_scaling = ParcelScaling::ddpm;
  Spread spread = {};
};

/// JKR (jkr.hpp), pull-off 3 pi gamma R*, with its hysteresis. Needs HertzContact, with the true moduli.
struct Jkr {
  double surface_energy = 0.0;  // gamma [J/m^2], > 0
  ParcelScaling parcel_scaling = ParcelScaling::ddpm;
  Spread spread = {};
};

using Adhesion = std::variant<NoAdhesion, Hamaker, Dmt, Jkr>;

/// One kind of touching pair: carrier on carrier, or carrier on wall.
struct Surfaces {
  ContactModel contact = LinearContact{};
  Adhesion adhesion = NoAdhesion{};
};

/// What a wall does to a carrier that touches it.
enum class OnWall { bounce, stick };

/// How the motion is computed. The defaults are safe; the numbers trade time for error.
struct Integration {
  double steps_per_contact = 20.0;  // sub-steps in the contact time t_c of the stiffest live contact, >= 10
  double skin = 0.2;                // of the neighbour list, in mean diameters
  bool sleep = true;                // carriers at rest cost nothing
  bool free_flight = true;          // what touches nothing moves in closed form; false: by steps as contacts take
  int sleep_steps = 50;             // air steps at rest before a carrier sleeps
  double sleep_use = 0.8;    // a carrier sleeps only while each contact holds with at most this part of its limit
  double wake_change = 0.1;  // a sleeper wakes when its force has changed by this part of what holds it
};

struct Models {
  Surfaces carrier;                                   // carrier on carrier
  Surfaces wall;                                      // carrier on wall
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // [m/s^2]
  bool rotation = true;                               // false: no spin; friction acts on the translation alone
  OnWall on_wall = OnWall::bounce;
  Integration integration;
  /// Asked within a step that takes long, by any thread; true: advance() throws Interrupted (failure.hpp).
  std::function<bool()> asked_to_stop = nullptr;
};

/// Throws std::invalid_argument, naming the value and what to do, unless all values make sense.
void check(const Models& models);

}  // namespace puffin::dem
