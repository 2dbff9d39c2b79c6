#pragma once
// Laws of the velocity gradient, written once over a number type as the collisions are (collision.hpp).

#include "lbm/collision.hpp"

namespace puffin::lbm {

/// Strain rate without trace, order xx, yy, zz, xy, xz, yz; g[a][b] = du_b/dx_a.
template <class Real>
[[gnu::always_inline]] inline void deviatoric_strain(const Real (&g)[3][3], Real (&s)[6]) {
  const Real mean = constant<Real>(1.0 / 3.0) * ((g[0][0] + g[1][1]) + g[2][2]), half = constant<Real>(0.5);
  for (int d = 0; d < 3; ++d) s[d] = g[d][d] - mean;
  s[3] = half * (g[0][1] + g[1][0]);
  s[4] = half * (g[0][2] + g[2][0]);
  s[5] = half * (g[1][2] + g[2][1]);
}

/// Vreman's eddy viscosity in lattice units:
///   nu_t = c sqrt(B/(g_ab g_ab)),  beta_ab = Delta^2 g_ma g_mb,
///   B = beta_xx beta_yy - beta_xy^2 + beta_xx beta_zz - beta_xz^2 + beta_yy beta_zz - beta_yz^2.
/// Source: Vreman, Phys. Fluids 16, 3670 (2004), eqs. 5-8. Zero where there is no gradient, and in pure shear and every
/// other flow for which B vanishes; B is a sum of squares (of the 2x2 minors of g), taken as such: no cancellation and
/// no negative value in float.
/// in: g[a][b] = du_b/dx_a; c_length2 = c Delta^2 with c = 2.5 C_s^2 (C_s: the constant of Smagorinsky's model).
template <class Real>
[[gnu::always_inline]] inline Real vreman_viscosity(const Real (&g)[3][3], const Real& c_length2) {
  using std::sqrt;
  // Cauchy-Binet: B/Delta^4 is the sum of the squares of all nine 2x2 minors of g.
  Real minors = constant<Real>(0), squares = constant<Real>(0);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
      const Real minor = g[a1][b1] * g[a2][b2] - g[a1][b2] * g[a2][b1];
      minors = minors + minor * minor;
      squares = squares + g[a][b] * g[a][b];
    }
  // A floor below every gradient that a float lattice holds (1e-14 squared, minors 1e-28 squared) keeps 0/0 at 0.
  return c_length2 * sqrt(minors / (squares + constant<Real>(1e-30)));
}

}  // namespace puffin::lbm
