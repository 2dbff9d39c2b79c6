#pragma once
// The laws of one kind of pair (carrier-carrier or carrier-wall), resolved once a step to plain numbers, and what
// follows for one pair of given radii.

#include <algorithm>
#include <cstdint>
#include <limits>

#include "dem/hertz.hpp"
#include "dem/jkr.hpp"
#include "dem/models.hpp"

namespace puffin::dem {

/// How adhesion enters.
enum class Attraction {
  none,
  well,  // booked at first touch and separation, a breaking spring in between (contact_step.cpp)
  dmt,   // a constant force while the surfaces touch
  jkr    // the curve of jkr.hpp instead of Hertz's
};

/// Numbers of one kind of pair.
struct SurfaceLaw {
  double zeta = 0.0;  // damping ratio of the dashpot; Hertz: the part of critical damping at the present stiffness
  double peak = 1.0;  // peak_overlap_factor(zeta)
  double restitution = 1.0;
  double stick = 0.0, slip = 0.0, limit = 0.0;  // friction coefficients
  double slip_speed = 0.0, limit_speed = 0.0;   // [m/s]; 0: constant friction
  double rolling = 0.0;
  double stiffness = 0.0;  // fixed [N/m]; 0: each contact its own
  double max_overlap = 0.02;
  double tangential_ratio = 2.0 / 7.0;
  bool hertz = false;     // else linear
  PairModuli moduli;      // E*, G* [Pa]
  double rayleigh = 0.0;  // Rayleigh time over sqrt(m/R) of a carrier, dt_R = rayleigh sqrt(m/R)
  Attraction attraction = Attraction::none;
  double pull_per_radius = 0.0;  // F0/R* = 4 pi gamma, JKR 3 pi gamma [N/m]
  double cutoff_gap = 0.0;       // d0 [m]
  int scaling_power = 1;         // n of the parcel rule l^n
  Spread spread;

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
  double pull_stiffness = 0.0;  // F0^2/(2U): a spring that breaks at F0 having stored U [N/m]; 0 without a well
  double constant_pull = 0.0;   // DMT: F0 [N]; then pull_off, well and pull_stiffness are 0
  JkrCurve jkr;                 // JKR; likewise
  double bend = 0.0;            // DMT, JKR: overlap over which adhesion matters [m]
  double longest_step =
      std::numeric_limits<double>::infinity();  // of a Hertz contact: a fifth of the Rayleigh time [s]

  /// The largest force that adhesion takes to pull apart [N].
  double largest_pull() const { return std::max({pull_off, constant_pull, jkr.pull_off}); }
};

/// F0 = 4 pi gamma R* l^(n-1), U = F0 d0: the sphere-size law on the entry's radius is l^1 of a single carrier's force.
/// in : radii of the entries and of one real carrier each [m]; radius_b = infinity for a wall; reduced mass [kg];
///      `strength`: factor on the surface energy of this pair
PairLaw pair_law(const SurfaceLaw& law, double radius_a, double single_a, double radius_b, double single_b,
                 double reduced_mass, double strength = 1.0);

/// Overlap [m] that an impact between carriers may use whose centres are `length` apart at touch and approach at
/// `closing` of their relative speed `speed`. While they overlap the line between their centres turns, by v_t t_c /
/// length; in a glancing impact, where straight paths would overlap by no more than length (closing/speed)^2 / 2, they
/// slipped past each other: b = 0.9 length gave 0.87 of the impulse of hard spheres, 0.98 length less than half. A
/// twentieth of that overlap gives 0.96 or more of it, down to a tenth of what is allowed otherwise (b = 0.96 length).
double glancing_overlap(const PairLaw& pair, double length, double closing, double speed);

/// Stiffness [N/m] of a contact that begins at `speed`, may overlap by `overlap` and must carry `load` at rest (largest
/// of weight and drag) [N]. Hertz: the largest that such an impact, such a load, or adhesion alone brings about.
double first_stiffness(const SurfaceLaw& law, const PairLaw& pair, double speed, double load, double overlap);

}  // namespace puffin::dem
