#pragma once
// The air at the start: velocity and pressure of the named fields, or of a file.

#include <functional>
#include <optional>

#include "cases/case.hpp"

namespace puffin::cases {

struct InitialAir {
  std::function<Vec3(const Vec3&)> velocity;    // [m/s] at a point
  std::function<double(const Vec3&)> pressure;  // [Pa], gauge, or over what all outlets have in common
  bool gauge = false;                           // the former: a file gives it
};

/// The initial field in a box [m]; empty: air at rest. U is the norm of initial_velocity, k = 2 pi over the edge,
/// places from the low corner.
///   taylor-green  a cube (edges equal to 1 %): u = U (sin x cos y cos z, -cos x sin y cos z, 0),
///                 p = rho U^2/16 (cos 2x + cos 2y) (cos 2z + 2)   [Taylor & Green, Proc. R. Soc. A 158, 499 (1937)]
///                 other boxes, two-dimensional: u = (-U cos x sin y, V sin x cos y, 0), V = U Ly/Lx,
///                 p = -rho/4 (U^2 cos 2x + V^2 cos 2y); in a slab thinner than a quarter of both its other edges in
///                 its plane, whichever that is
///   shear-layer   two layers of thickness 1/80 of the box with a 5 % disturbance
///                 [Minion & Brown, J. Comput. Phys. 138, 734 (1997)]
///   { file }      the points of the file (point_field.hpp); pressure from its column p [Pa] if it has one, else zero
/// Throws std::invalid_argument for a file that cannot be used.
std::optional<InitialAir> initial_air(const Air& air, const Vec3& corner, const Vec3& box);

}  // namespace puffin::cases
