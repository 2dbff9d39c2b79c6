#pragma once
// What the links of an inlet bring: the populations that come back from a surface that blows with a velocity u.
//
// In a uniform flow f_i - f_o = -2 f_o^odd, o the direction towards the opening: what comes back differs from what left
// by the odd part of the equilibrium. Of first order that is -6 w c.u (Ladd, J. Fluid Mech. 271, 285 (1994), eq. 3.2).
// Laws whose equilibrium has moments of third order, T_abb = rho u_a u_b^2, add
//   on a diagonal (c_a, c_b)   -(c_a u_a u_b^2 + c_b u_b u_a^2)/2
//   on an axis c_a             +c_a u_a (u_b^2 + u_c^2).
// It brings no mass through a whole face of a cell, but momentum along it: without it an oblique inlet's velocity along
// the opening is too small by 3 u_n^2 of itself, 1.8 % at 0.08 (tests/lbm/test_oblique_inlet.cpp).

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm {

/// Population gained through a link in `direction` for a velocity of the surface u [lattice units], first order in u.
double gain_of(int direction, const geometry::Vec3& u);

/// Its part of third order in u.
double cubic_gain_of(int direction, const geometry::Vec3& u);

}  // namespace puffin::lbm
