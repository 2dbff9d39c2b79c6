#pragma once
// One coated carrier hits a wall or another coated carrier: how many fines does it lose?

#include <cstdint>
#include <vector>

#include "micromodels/derivation/grains.hpp"
#include "micromodels/lift_off_law.hpp"

namespace puffin::micromodels::derivation {

struct Scene {
  double carrier_diameter = 70e-6, carrier_density = 1520.0;  // [m], [kg/m^3]
  double fine_diameter = 1.9e-6, fine_density = 1520.0;
  int fines = 2000;
  int patches = 0;      // 0: uniform coat
  double spread = 0.0;  // standard deviation of ln(adhesion of a fine)
  Partner target = Partner::wall;
  Surface surface;
  double air_viscosity = 1.82e-5, mean_free_path = 0.067e-6;  // [Pa s], [m]; between carrier and wall. 0: vacuum
};

/// Throws std::invalid_argument, naming the value, unless sizes, moduli, densities and gamma are positive, 0 <= nu <=
/// 0.5, 0 < restitution <= 1, fines >= 0, spread >= 0.
void check(const Scene& scene);
double carrier_mass(const Scene& scene);  // without fines [kg]
double fine_mass(const Scene& scene);     // [kg]
/// Contact of a fine whose adhesion is `adhesion` times the median with its carrier.
PairContact on_carrier(const Scene& scene, double adhesion);

/// Fines of one carrier after the impact; they add up to Scene::fines.
struct Outcome {
  int stayed = 0;               // on the carrier
  int detached = 0;             // in the air: lifted + rolled
  int rolled = 0;               // of these: kept their motion along the surface, too fast for it to hold them
  int to_wall = 0;              // on the wall
  int redeposited = 0;          // left, and stuck again: to the carrier, or to the other carrier
  double rebound = 0.0;         // normal speed of the carrier afterwards, over that before
  double deepest = 0.0;         // largest overlap of a fine, over its radius: where it is not small, a real fine yields
  double peak = 0.0;            // largest deceleration [m/s^2], averaged over 4 ns
  double lift_off_ratio = 0.0;  // m_f a / F0 at which a fine at the pole lifts off; 0: not needed
};

enum class Resolve {
  contact,  // the carriers and the fines that can come between them; the rest follows from the carrier's motion
  all       // every fine
};

/// speed [m/s]: normal to the wall, or relative between carriers; angle between velocity and surface [degrees], 90 =
/// head on. The seed places the fines and draws their adhesion.
///
/// Resolve::contact uses that fines which touch only their carrier are small systems of their own: what a fine needs to
/// lift off is found by resolving the normal motion of one fine on the carrier as it decelerates (not m_f a > F0, as
/// its contact vibrates), and applied to each fine by the part of the deceleration, and of the spin, that pulls it
/// outwards. A fine that is not lifted keeps 5/7 of its velocity along the surface (it rolls) and leaves if m_f v^2/(R
/// + R_f) exceeds its adhesion. It neglects the reaction of these fines on the carrier beyond their mass, fines that
/// hit each other, and their wandering during the impact. After the contact, fines fly on (flight.hpp): they stick to
/// what they meet below the capture speed, else they bounce. Throws std::invalid_argument for a bad scene,
/// speed or angle.
Outcome impact(const Scene& scene, double speed, double angle, std::uint64_t seed, Resolve resolve = Resolve::contact);

/// A carrier held in a flow: fines that a slip speed [m/s] in air would lift off, or set rolling or sliding. Force and
/// moment of a shear flow G on a sphere at a wall: 1.7009 6 pi mu R_f^2 G and 0.944 4 pi mu R_f^3 G (O'Neill, Chem.
/// Eng. Sci. 23 (1968) 1293); lift 9.22 rho G^2 R_f^4 (Leighton & Acrivos, ZAMP 36 (1985) 174). G = 1.5 (v/R) (1 + 0.3
/// sqrt(Re)) sin(theta) at the angle theta from the front: Stokes flow, and an estimate of its growth with Re = 2 R v
/// rho/mu.
struct HeldOutcome {
  int lifted = 0, sliding = 0, rolling = 0;  // a fine counts in the first that holds
};
HeldOutcome held_in_flow(const Scene& scene, double slip, double air_density, double air_viscosity, std::uint64_t seed);

}  // namespace puffin::micromodels::derivation
