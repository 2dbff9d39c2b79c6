#pragma once
// [fines]: what they ride on and where they stay.

#include <optional>
#include <string>
#include <vector>

#include "cases/case_values.hpp"

namespace puffin::cases {

enum class WallDeposition { none, inertial, drift_only };
enum class ScalarScheme { upwind, minmod, van_leer, mc };
enum class ScalarWall { reflect, absorb };
struct GaussianBlob {          // an initial cloud of `amount` fines in all
  Vec3 center = Vec3::Zero();  // [m]
  double sigma = 0.0;          // [m]
  double amount = 0.0;         // [1]
  bool operator==(const GaussianBlob&) const = default;
};
struct Scalar {
  std::string name;
  double diffusion = 0.0;  // [kg/(m s)]: rho D
  ScalarScheme scheme = ScalarScheme::mc;
  ScalarWall wall = ScalarWall::reflect;
  std::optional<GaussianBlob> initial;
  bool operator==(const Scalar&) const = default;
};
struct ScalarBoundary {  // a fixed value on a patch
  std::string patch, scalar;
  double value = 0.0;  // [1/m^3]
  bool operator==(const ScalarBoundary&) const = default;
};
struct Fines {
  std::string micromodels;  // file as it can be opened; empty: nothing moves the fines (scalar scenes)
  WallDeposition wall_deposition = WallDeposition::none;
  double diameter = 0.0;             // [m]
  double density = 0.0;              // [kg/m^3]
  Vec3 gravity = Vec3(0, 0, -9.81);  // [m/s^2] on fines with inertia
  double turbulent_schmidt = 0.0;    // of the unresolved eddies; 0: they mix no fines
  double reattachment = 0.0;         // part of the airborne fines meeting a carrier that stays on it; 0: off
  double pick_up = 0.0;              // part of the wall's fines in reach of a hit that the carrier takes; 0: off
  std::vector<Scalar> scalars;
  std::vector<ScalarBoundary> boundaries;
  bool operator==(const Fines&) const = default;
};

}  // namespace puffin::cases
