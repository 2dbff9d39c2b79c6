#pragma once
// Collision laws: 19 numbers in, 19 numbers out. A law knows no index and no memory; it is written once over a number
// type `Real` (a double in tests, a SIMD pack in production). Populations are shifted: g_i = f_i - w_i.
//
// Common notation (lattice units): rho density, u velocity, F body force, Pi non-equilibrium stress
//   Pi_ab = sum_i f_i c_a c_b - rho/3 d_ab - rho u_a u_b + (u_a F_b + u_b F_a)/2,
// tau relaxation time, omega = 1/tau. Order of symmetric tensors: xx, yy, zz, xy, xz, yz.

#include <cmath>

#include "lbm/d3q19.hpp"

namespace puffin::lbm {

/// A constant in the number type of a law: a plain number, or a SIMD pack of equal lanes.
template <class Real>
[[gnu::always_inline]] inline Real constant(double value) {
  if constexpr (requires { typename Real::value_type; })
    return Real(static_cast<typename Real::value_type>(value));
  else
    return static_cast<Real>(value);
}

/// What a law needs beside the populations; the same for every cell of a step.
struct CollisionConstants {
  double tau0 = 1.0;           // molecular relaxation time: nu = (tau0 - 1/2)/3
  double rescale = 1.0;        // ratio r = dt_new/dt_old, used in the one step in which the time step changes
  double tau0_rescaled = 1.0;  // relaxation time after the change
};

/// Density and velocity that a collision found; what interpolation, output and the health check want to know.
template <class Real>
struct CellMoments {
  Real density_excess;  // rho - 1
  Real ux, uy, uz;      // (j + F/2)/rho
};

namespace detail {

template <class Real>
struct Hydrodynamics {
  Real drho, rho, u[3], pi[6];
};

/// Moments of the shifted populations up to second order. Forced: F is the body force on the cell.
template <bool Forced, class Real>
[[gnu::always_inline]] inline Hydrodynamics<Real> hydrodynamics(const Real (&g)[19], const Real (&force)[3]) {
  Hydrodynamics<Real> h;
  const Real xy_p = g[7] + g[8], xy_m = g[9] + g[10];
  const Real xz_p = g[11] + g[12], xz_m = g[13] + g[14];
  const Real yz_p = g[15] + g[16], yz_m = g[17] + g[18];
  const Real x_axis = g[1] + g[2], y_axis = g[3] + g[4], z_axis = g[5] + g[6];
  const Real xy = xy_p + xy_m, xz = xz_p + xz_m, yz = yz_p + yz_m;
  h.drho = g[0] + ((x_axis + y_axis) + z_axis) + ((xy + xz) + yz);
  h.rho = constant<Real>(1) + h.drho;
  Real jx = (g[1] - g[2]) + ((g[7] - g[8]) + (g[9] - g[10])) + ((g[11] - g[12]) + (g[13] - g[14]));
  Real jy = (g[3] - g[4]) + ((g[7] - g[8]) - (g[9] - g[10])) + ((g[15] - g[16]) + (g[17] - g[18]));
  Real jz = (g[5] - g[6]) + ((g[11] - g[12]) - (g[13] - g[14])) + ((g[15] - g[16]) - (g[17] - g[18]));
  if constexpr (Forced) {
    jx = jx + constant<Real>(0.5) * force[0];
    jy = jy + constant<Real>(0.5) * force[1];
    jz = jz + constant<Real>(0.5) * force[2];
  }
  const Real inverse = constant<Real>(1) / h.rho;
  h.u[0] = jx * inverse;
  h.u[1] = jy * inverse;
  h.u[2] = jz * inverse;
  const Real third = h.drho * constant<Real>(1.0 / 3.0);
  h.pi[0] = (x_axis + xy + xz) - third - jx * h.u[0];
  h.pi[1] = (y_axis + xy + yz) - third - jy * h.u[1];
  h.pi[2] = (z_axis + xz + yz) - third - jz * h.u[2];
  h.pi[3] = (xy_p - xy_m) - jx * h.u[1];
  h.pi[4] = (xz_p - xz_m) - jx * h.u[2];
  h.pi[5] = (yz_p - yz_m) - jy * h.u[2];
  if constexpr (Forced) {
    h.pi[0] = h.pi[0] + h.u[0] * force[0];
    h.pi[1] = h.pi[1] + h.u[1] * force[1];
    h.pi[2] = h.pi[2] + h.u[2] * force[2];
    h.pi[3] = h.pi[3] + constant<Real>(0.5) * (h.u[0] * force[1] + h.u[1] * force[0]);
    h.pi[4] = h.pi[4] + constant<Real>(0.5) * (h.u[0] * force[2] + h.u[2] * force[0]);
    h.pi[5] = h.pi[5] + constant<Real>(0.5) * (h.u[1] * force[2] + h.u[2] * force[1]);
  }
  return h;
}

/// Smagorinsky closed form: tau = (tau0 + sqrt(tau0^2 + 18 sqrt2 L^2 |Pi|/rho))/2, |Pi| of the deviatoric part.
/// Source: Hou, Sterling, Chen & Doolen, Fields Inst. Comm. 6, 151 (1996). `les` = 18 sqrt2 L^2, L in cells.
template <class Real>
[[gnu::always_inline]] inline Real smagorinsky_tau(const Real (&pi)[6], Real inverse_rho, Real tau0, Real les) {
  using std::sqrt;
  const Real norm2 = pi[0] * pi[0] + pi[1] * pi[1] + pi[2] * pi[2] +
                     constant<Real>(2) * (pi[3] * pi[3] + pi[4] * pi[4] + pi[5] * pi[5]);
  return constant<Real>(0.5) * (tau0 + sqrt(tau0 * tau0 + les * sqrt(norm2) * inverse_rho));
}

}  // namespace detail

/// Recursive-regularised third-order collision (RR3) with the trace of the stress relaxed at 1.
/// Source: Malaspinas, arXiv 1505.06900 (2015); Coreixas et al., PRE 96, 033306 (2017); projected on D3Q19.
///   S_ab  = rho u_a u_b + (1-omega) Pi_ab + (u_a F_b + u_b F_a)/2
///   T_aab = rho u_a^2 u_b + (1-omega)(2 u_a Pi_ab + u_b Pi_aa) + (u_a^2 F_b + 2 u_a u_b F_a)/2
///   f*_0 = (rho - 3/2 trS)/3,   f*_{+-b} = (rho +- 3 j_b + 9/2 S_bb - 3/2 trS)/18 -+ (T_aab + T_ddb)/2,
///   f*_{(s_a,s_b)} = (rho + 3 (s_a j_a + s_b j_b) + 9/2 (S_aa + S_bb + 2 s_a s_b S_ab) - 3/2 trS)/36
///                    + (s_b T_aab + s_a T_abb)/4,   j = rho u + F/2.
/// Second order in space and time: nu = (tau - 1/2)/3. Linearly stable to |u| = 0.10 at tau = 0.5003.
/// Checked by tests/lbm/test_collision.cpp (conservation, equilibrium, projection) and test_shear_wave.cpp (viscosity).
struct Rr3 {
  static constexpr bool regularised = true;

  template <bool Forced, class Real>
  [[gnu::always_inline]] static inline void assemble(Real drho, Real rho, const Real (&u)[3], const Real (&p)[6],
                                                     const Real (&force)[3], Real (&g)[19]) {
    // p = (1-omega) Pi
    const Real jx = rho * u[0], jy = rho * u[1], jz = rho * u[2];
    Real sxx = jx * u[0] + p[0], syy = jy * u[1] + p[1], szz = jz * u[2] + p[2];
    Real sxy = jx * u[1] + p[3], sxz = jx * u[2] + p[4], syz = jy * u[2] + p[5];
    const Real two = constant<Real>(2), half = constant<Real>(0.5);
    // third order, named by their two equal indices first: txxy = T_xxy
    Real txxy = u[0] * (jx * u[1] + two * p[3]) + u[1] * p[0];
    Real txxz = u[0] * (jx * u[2] + two * p[4]) + u[2] * p[0];
    Real tyyx = u[1] * (jy * u[0] + two * p[3]) + u[0] * p[1];
    Real tyyz = u[1] * (jy * u[2] + two * p[5]) + u[2] * p[1];
    Real tzzx = u[2] * (jz * u[0] + two * p[4]) + u[0] * p[2];
    Real tzzy = u[2] * (jz * u[1] + two * p[5]) + u[1] * p[2];
    Real kx = jx, ky = jy, kz = jz;  // post-collision momentum
    if constexpr (Forced) {
      const Real fx = force[0], fy = force[1], fz = force[2];
      sxx = sxx + u[0] * fx;
      syy = syy + u[1] * fy;
      szz = szz + u[2] * fz;
      sxy = sxy + half * (u[0] * fy + u[1] * fx);
      sxz = sxz + half * (u[0] * fz + u[2] * fx);
      syz = syz + half * (u[1] * fz + u[2] * fy);
      txxy = txxy + half * u[0] * (u[0] * fy + two * u[1] * fx);
      txxz = txxz + half * u[0] * (u[0] * fz + two * u[2] * fx);
      tyyx = tyyx + half * u[1] * (u[1] * fx + two * u[0] * fy);
      tyyz = tyyz + half * u[1] * (u[1] * fz + two * u[2] * fy);
      tzzx = tzzx + half * u[2] * (u[2] * fx + two * u[0] * fz);
      tzzy = tzzy + half * u[2] * (u[2] * fy + two * u[1] * fz);
      kx = kx + half * fx;
      ky = ky + half * fy;
      kz = kz + half * fz;
    }
    const Real base = drho - constant<Real>(1.5) * (sxx + syy + szz);
    g[0] = constant<Real>(1.0 / 3.0) * base;
    const Real a18 = constant<Real>(1.0 / 18.0), sixth = constant<Real>(1.0 / 6.0), quarter = constant<Real>(0.25);
    const auto axis = [&](Real s, Real k, Real t, Real & plus, Real & minus) __attribute__((always_inline)) {
      const Real even = a18 * base + quarter * s;  // 4.5/18
      const Real odd = sixth * k - half * t;
      plus = even + odd;
      minus = even - odd;
    };
    axis(sxx, kx, tyyx + tzzx, g[1], g[2]);
    axis(syy, ky, txxy + tzzy, g[3], g[4]);
    axis(szz, kz, txxz + tyyz, g[5], g[6]);
    const Real a36 = constant<Real>(1.0 / 36.0), twelfth = constant<Real>(1.0 / 12.0), eighth = constant<Real>(0.125);
    const auto diagonal = [&](Real saa, Real sbb, Real sab, Real ka, Real kb, Real taab, Real tbba, Real & pp,
                              Real & mm, Real & pm, Real & mp) __attribute__((always_inline)) {
      const Real even = a36 * base + eighth * (saa + sbb);
      const Real cross = quarter * sab;
      const Real odd_a = twelfth * ka + quarter * tbba, odd_b = twelfth * kb + quarter * taab;
      const Real same = even + cross, other = even - cross;
      pp = same + (odd_a + odd_b);
      mm = same - (odd_a + odd_b);
      pm = other + (odd_a - odd_b);
      mp = other - (odd_a - odd_b);
    };
    diagonal(sxx, syy, sxy, kx, ky, txxy, tyyx, g[7], g[8], g[9], g[10]);
    diagonal(sxx, szz, sxz, kx, kz, txxz, tzzx, g[11], g[12], g[13], g[14]);
    diagonal(syy, szz, syz, ky, kz, tyyz, tzzy, g[15], g[16], g[17], g[18]);
  }
};

/// Single-relaxation-time collision (BGK) with the second-order equilibrium and Guo forcing.
/// Source: Qian, d'Humieres & Lallemand, EPL 17, 479 (1992); Guo, Zheng & Shi, PRE 65, 046308 (2002).
/// A comparator: at tau near 1/2 it is stable only for slow, well-resolved flow.
struct Bgk {
  static constexpr bool regularised = false;
};

}  // namespace puffin::lbm
