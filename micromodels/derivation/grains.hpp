#pragma once
// A few spheres and a wall with the contact laws of their materials, nothing softened: the resolved part of a
// derivation. Small systems of short life, so plain loops over pairs.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <vector>

namespace puffin::micromodels::derivation {

using Eigen::Vector3d;

struct Grain {
  Vector3d position = Vector3d::Zero(), velocity = Vector3d::Zero(), spin = Vector3d::Zero();
  double radius = 0.0, mass = 0.0;  // [m], [kg]
  double adhesion = 1.0;            // factor on the pull-off force of its contacts
  bool carrier = false;
};

struct Material {
  double youngs_modulus = 0.0, poisson = 0.0;  // [Pa]
  /// Largest mean pressure that a contact of the material bears, about its hardness [Pa]. Infinite: never yields.
  double yield_pressure = std::numeric_limits<double>::infinity();
};

struct Surface {
  Material grains, wall;
  double surface_energy = 0.0;  // gamma [J/m^2], of one surface, the same everywhere
  double cutoff_gap = 4e-10;    // d0 [m]
  double restitution = 0.7;     // of the dashpot
  double friction = 0.3;
};

/// Hertz contact of two bodies: repulsion (4/3) E* sqrt(R*) d^(3/2), adhesion F0 = 4 pi gamma R* (Derjaguin, Muller &
/// Toporov 1975), which fades with the gap h as F0/(1 + h/d0)^2 (Hamaker with the force limited at d0).
struct PairContact {
  double modulus = 0.0, shear = 0.0, radius = 0.0, mass = 0.0;      // E*, G* [Pa], R* [m], m* [kg]
  double pull = 0.0, gap = 0.0;                                     // F0 [N], d0 [m]
  double damping = 0.0;                                             // 2 sqrt(5/6) |beta| (Tsuji et al. 1992)
  double yield_pressure = std::numeric_limits<double>::infinity();  // p_y of the softer body [Pa]

  /// Hertz repulsion less adhesion [N] at an overlap [m] (negative: a gap) that grows at `rate` [m/s].
  double normal_force(double overlap, double rate) const;
  double stiffness(double overlap) const;  // [N/m] of the Hertz part
};

/// What yielding has left behind at a contact: it parts at the overlap `offset` from surfaces of relative radius
/// `radius`, and is elastic up to `deepest`.
///
/// Loading: Hertz up to d_y = (pi p_y/(2 E*))^2 R*, where the pressure in the middle is p_y; beyond, the contact of
/// radius a^2 = R* d bears p_y more on every new part of it, F = F_y + pi p_y R* (d - d_y); deeper than R* (a sphere
/// pressed in to its equator) it bears no more. Unloading and loading again: Hertz of the flattened radius
/// R_p = 4 E* a^3/(3 F) at the deepest point, from d_p = d - a^2/R_p. The adhesion is 4 pi gamma R_p: what has been
/// flattened sticks better.
/// Source: C. Thornton & Z. Ning, Powder Technol. 99, 154 (1998); the adhesion is DMT's as in PairContact, not JKR's.
struct Flattened {
  double radius = 0.0, offset = 0.0, deepest = 0.0;  // [m]; radius 0: nothing has yielded yet
};
/// Normal force [N] without dashpot, split: `load` > 0 pushes apart. `flattened` grows with an overlap deeper than
/// ever.
struct NormalForce {
  double load = 0.0, adhesion = 0.0;      // [N]
  double stiffness = 0.0, overlap = 0.0;  // [N/m] of the load; of the surfaces as they now are [m], negative: a gap
};
NormalForce normal_force(const PairContact& contact, double overlap, Flattened& flattened);

/// radius_b, mass_b infinite: the wall, with the wall's moduli if `wall`.
PairContact pair_contact(const Surface& surface, double radius_a, double radius_b, double mass_a, double mass_b,
                         bool wall, double adhesion);

/// Moves grains by contact forces; the wall is z = 0 (absent if there is none). Explicit steps, at most 0.14 of the
/// fastest contact's 1/omega. Tangential: Mindlin spring 8 G* sqrt(R* d) with its dashpot, limited by friction times
/// the Hertz force (load plus adhesion). No rolling resistance: its arm is a hundredth of a fine's radius.
class GrainSystem {
 public:
  GrainSystem(std::vector<Grain> grains, const Surface& surface, bool wall);

  /// One step; returns its length [s], at most `longest`.
  double step(double longest);

  const std::vector<Grain>& grains() const { return grains_; }
  double time() const { return time_; }
  /// Acceleration of a grain in the last step [m/s^2].
  Vector3d acceleration(std::size_t grain) const { return force_[grain] / grains_[grain].mass; }
  /// Overlap of two grains [m]; b = -1: with the wall.
  double overlap(int a, int b) const;
  /// Whether two grains (b = -1: the wall) attract or push each other: gap below 5 d0.
  bool touch(int a, int b) const {
    const double gap = -overlap(a, b), reach = 5.0 * surface_.cutoff_gap;
    return gap < reach && gap + dent(a, b) < reach;
  }
  double deepest_fine_overlap() const { return deepest_; }  // so far [m]

 private:
  struct Pair {
    int a, b;  // b = -1: wall
    PairContact law;
    Vector3d spring = Vector3d::Zero();
    Flattened flattened{};
  };
  double dent(int a, int b) const;  // overlap at which a contact that has yielded parts [m]
  void find_pairs();
  void add_forces(Pair& pair, double dt);

  std::vector<Grain> grains_;
  Surface surface_;
  bool wall_;
  std::vector<Pair> pairs_;
  std::vector<Vector3d> force_, torque_;
  double time_ = 0.0, stiffest_ = 0.0, lightest_ = 0.0, slack_ = 0.0, skin_ = 0.0, deepest_ = 0.0, last_dt_ = 0.0;
};

}  // namespace puffin::micromodels::derivation
