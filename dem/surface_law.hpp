#pragma once
// The laws of one kind of pair (carrier-carrier or carrier-wall), resolved once a step to plain numbers, and what
// follows for one pair of given radii.

#include <cstdint>

#include "dem/models.hpp"

namespace puffin::dem {

/// Numbers of one kind of pair.
struct SurfaceLaw {
  double zeta = 0.0;  // damping ratio of the dashpot
  double peak = 1.0;  // peak_overlap_factor(zeta)
  double restitution = 1.0;
  double stick = 0.0, slip = 0.0, limit = 0.0;  // friction coefficients
  double slip_speed = 0.0, limit_speed = 0.0;   // [m/s]; 0: constant friction
  double rolling = 0.0;
  double stiffness = 0.0;  // fixed [N/m]; 0: each contact its own
  double max_overlap = 0.02;
  double tangential_ratio = 2.0 / 7.0;
  double pull_per_radius = 0.0;  // F0/R* = 4 pi gamma [N/m]
  double cutoff_gap = 0.0;       // d0 [m]
  int scaling_power = 1;         // n of the parcel rule l^n

  explicit SurfaceLaw(const Surfaces& surfaces);

  /// mu at the sliding speed [m/s] (SpeedFriction in models.hpp).
  double friction(double speed) const;
  double largest_friction() const;
};

/// Numbers of one pair.
struct PairLaw {
  double mass = 0.0;            // m*, with fixed partners taken as infinitely heavy [kg]
  double radius = 0.0;          // R* [m]
  double allowed = 0.0;         // overlap that an impact shall not exceed [m]
  double pull_off = 0.0;        // F0 [N]
  double well = 0.0;            // U [J]
  double pull_stiffness = 0.0;  // F0^2/(2U): a spring that breaks at F0 having stored U [N/m]; 0 without adhesion
};

/// F0 = 4 pi gamma R* l^(n-1), U = F0 d0: the sphere-size law on the entry's radius is l^1 of a single carrier's force.
/// in : radii of the entries and of one real carrier each [m]; radius_b = infinity for a wall; reduced mass [kg]
PairLaw pair_law(const SurfaceLaw& law, double radius_a, double single_a, double radius_b, double single_b,
                 double reduced_mass);

/// Stiffness [N/m] of a contact that begins at `speed` and must carry `load` at rest (largest of weight and drag) [N].
double first_stiffness(const SurfaceLaw& law, const PairLaw& pair, double speed, double load);

}  // namespace puffin::dem
