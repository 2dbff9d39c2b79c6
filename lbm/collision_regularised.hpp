#pragma once
// Regularised laws: what a cell keeps are density, velocity and the relaxed stress; all 19 populations are made anew
// from these ten numbers. Four steps: read_moments sums the populations, find_stress divides, relax finds the factor of
// the stress, assemble writes the populations. A kernel does each for many cells before the next: the square roots and
// divisions then no longer wait for each other (2.5 times faster than cell by cell), and the positivity limiter can
// scale the stress.

#include "lbm/collision.hpp"

namespace puffin::lbm {

/// A cell between reading and writing.
template <class Real>
struct CellState {
  Real drho;
  Real j[3], u[3];  // momentum rho u and velocity
  Real p[6];        // stress without trace: Pi before relax, (1 - omega) Pi for assemble
};

/// Reads a cell: raw moments into drho, j and p.
template <class Real, class Get>
[[gnu::always_inline]] inline void read_moments(const Get& get, CellState<Real>& s) {
  const RawMoments<Real> r = raw_moments<Real>(get);
  s.drho = r.drho;
  for (int d = 0; d < 3; ++d) s.j[d] = r.j[d];
  for (int n = 0; n < 6; ++n) s.p[n] = r.m[n];
}

/// From raw moments to velocity and stress; the trace of the stress is relaxed at 1. `les` is 18 sqrt2 L^2, and over
/// the density on return.
template <bool Forced, class Real>
[[gnu::always_inline]] inline void find_stress(const Real (&force)[3], Real& les, CellState<Real>& s) {
  RawMoments<Real> r;
  r.drho = s.drho;
  for (int d = 0; d < 3; ++d) r.j[d] = s.j[d];
  for (int n = 0; n < 6; ++n) r.m[n] = s.p[n];
  Hydrodynamics<Real> h = hydrodynamics<Forced>(r, force);
  remove_trace(h.pi);
  les = les * h.inverse_rho;
  for (int d = 0; d < 3; ++d) s.j[d] = h.j[d];
  for (int d = 0; d < 3; ++d) s.u[d] = h.u[d];
  for (int n = 0; n < 6; ++n) s.p[n] = h.pi[n];
}

/// Both at once.
template <bool Forced, class Real, class Get>
[[gnu::always_inline]] inline void find_state(const Get& get, const Real (&force)[3], Real& les, CellState<Real>& s) {
  read_moments(get, s);
  find_stress<Forced>(force, les, s);
}

/// Relaxation of the stress: returns 1 - omega. `les` = 18 sqrt2 L^2/rho.
struct RelaxStress {
  static double old_force(const CollisionConstants&) { return 1.0; }  // factor of the force in the units of the state

  template <class Real>
  [[gnu::always_inline]] static inline Real relax(const CollisionConstants& c, const Real& les, CellState<Real>& s) {
    return constant<Real>(1) - constant<Real>(2) * Arithmetic<Real>::inverse(twice_tau(s.p, c, les));
  }
};

/// The same in the step in which the time step changes to dt' = r dt. The force is in the new units, F = F'/r^2 in the
/// old:  rho' = 1 + r^2 (rho - 1),  u' = r u,  tau' = tau0' + r (tau - tau0),  Pi' = r (tau'/tau) (rho'/rho) Pi.
/// Source: dimensional analysis of rho, u, Pi = -2 rho tau S/3; exact for a regularised state, which holds no more.
struct RelaxRescaled {
  static double old_force(const CollisionConstants& c) { return 1.0 / (c.rescale * c.rescale); }

  template <class Real>
  [[gnu::always_inline]] static inline Real relax(const CollisionConstants& c, const Real& les, CellState<Real>& s) {
    const Real one = constant<Real>(1), r = constant<Real>(c.rescale);
    const Real tau = constant<Real>(0.5) * twice_tau(s.p, c, les);
    const Real tau_new = constant<Real>(c.tau0_rescaled) + r * (tau - constant<Real>(c.tau0));
    const Real old_rho = one + s.drho;
    s.drho = constant<Real>(c.rescale * c.rescale) * s.drho;
    const Real rho = one + s.drho;
    for (int d = 0; d < 3; ++d) s.u[d] = s.u[d] * r;
    for (int d = 0; d < 3; ++d) s.j[d] = rho * s.u[d];
    return (one - one / tau_new) * (r * (tau_new / tau) * (rho / old_rho));
  }
};

namespace detail {

/// Quantities of both regularised laws, in the units in which they are added: T'_aab = T_aab/4 and so on.
template <class Real>
struct Assembly {
  Real s[6];     // S_ab = rho u_a u_b + p_ab + (u_a F_b + u_b F_a)/2
  Real h[3];     // j*_a/12, j* = rho u + F/2
  Real t[3][3];  // t[a][b] = T_abb/4, a != b: what carries momentum along a across the plane (a,b)
};

/// T_aab = rho u_a^2 u_b + 2 u_a p_ab + u_b p_aa + (u_a^2 F_b + 2 u_a u_b F_a)/2 = u_a (S_ab + p_ab) + u_b q_aa, where
/// q_aa = p_aa + u_a F_a/2 and S_ab + p_ab holds the force once.
template <bool Forced, class Real>
[[gnu::always_inline]] inline Assembly<Real> third_order(const CellState<Real>& r, const Real (&force)[3]) {
  Assembly<Real> a;
  const Real quarter = constant<Real>(0.25), half = constant<Real>(0.5);
  const Real u4[3] = {quarter * r.u[0], quarter * r.u[1], quarter * r.u[2]};
  Real q[3];
  for (int d = 0; d < 3; ++d) {
    a.s[d] = r.j[d] * r.u[d] + r.p[d];
    q[d] = r.p[d];
    a.h[d] = constant<Real>(1.0 / 12.0) * r.j[d];
    if constexpr (Forced) {
      const Real work = r.u[d] * force[d];
      a.s[d] = a.s[d] + work;
      q[d] = q[d] + half * work;
      a.h[d] = a.h[d] + constant<Real>(1.0 / 24.0) * force[d];
    }
  }
  const auto pair = [&](int d, int e, int n) __attribute__((always_inline)) {
    a.s[n] = r.j[d] * r.u[e] + r.p[n];
    if constexpr (Forced) a.s[n] = a.s[n] + half * (r.u[d] * force[e] + r.u[e] * force[d]);
    const Real both = a.s[n] + r.p[n];
    a.t[d][e] = u4[e] * both + u4[d] * q[e];
    a.t[e][d] = u4[d] * both + u4[e] * q[d];
  };
  pair(0, 1, 3);
  pair(0, 2, 4);
  pair(1, 2, 5);
  return a;
}

/// The odd part of an axis is what the diagonals leave of the momentum; the even parts are given.
template <class Real, class Put, int Plus, int Minus>
[[gnu::always_inline]] inline void put_axis(const Put& put, Index<Plus> plus, Index<Minus> minus, Real even, Real odd) {
  put(plus, even + odd);
  put(minus, even - odd);
}

/// Four diagonals of a plane (a,b): even part, S_ab/4, and the odd parts along a and b.
template <class Real, class Put, int First>
[[gnu::always_inline]] inline void put_plane(const Put& put, Index<First>, Real even, Real cross, Real odd_a,
                                             Real odd_b) {
  const Real same = even + cross, other = even - cross, sum = odd_a + odd_b, difference = odd_a - odd_b;
  put(Index<First>(), same + sum);
  put(Index<First + 1>(), same - sum);
  put(Index<First + 2>(), other + difference);
  put(Index<First + 3>(), other - difference);
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
/// Checked by tests/lbm/test_collision.cpp (conservation, equilibrium, projection) and test_air.cpp (viscosity).
struct Rr3 : RelaxStress {
  template <bool Forced, class Real, class Put>
  [[gnu::always_inline]] static inline void assemble(const CellState<Real>& r, const Real (&force)[3], const Put& put) {
    const auto a = detail::third_order<Forced>(r, force);
    const Real trace = (a.s[0] + a.s[1]) + a.s[2];
    const Real base = constant<Real>(1.0 / 36.0) * r.drho - constant<Real>(1.5 / 36.0) * trace;
    const Real eighth = constant<Real>(0.125), quarter = constant<Real>(0.25), two = constant<Real>(2);
    put(Index<0>(), constant<Real>(12) * base);
    const Real ex = base + eighth * a.s[0], ey = base + eighth * a.s[1], ez = base + eighth * a.s[2];
    const Real qy = eighth * a.s[1], qz = eighth * a.s[2];
    detail::put_plane(put, Index<7>(), ex + qy, quarter * a.s[3], a.h[0] + a.t[0][1], a.h[1] + a.t[1][0]);
    detail::put_plane(put, Index<11>(), ex + qz, quarter * a.s[4], a.h[0] + a.t[0][2], a.h[2] + a.t[2][0]);
    detail::put_plane(put, Index<15>(), ey + qz, quarter * a.s[5], a.h[1] + a.t[1][2], a.h[2] + a.t[2][1]);
    detail::put_axis(put, Index<1>(), Index<2>(), two * ex, two * (a.h[0] - (a.t[0][1] + a.t[0][2])));
    detail::put_axis(put, Index<3>(), Index<4>(), two * ey, two * (a.h[1] - (a.t[1][0] + a.t[1][2])));
    detail::put_axis(put, Index<5>(), Index<6>(), two * ez, two * (a.h[2] - (a.t[2][0] + a.t[2][1])));
  }
};

/// RR3 in the step in which the time step changes.
struct Rr3Rescaled : RelaxRescaled {
  template <bool Forced, class Real, class Put>
  [[gnu::always_inline]] static inline void assemble(const CellState<Real>& r, const Real (&force)[3], const Put& put) {
    Rr3::assemble<Forced>(r, force, put);
  }
};

/// Hybrid recursive-regularised collision: RR3 whose stress is blended with the one that the strain rate S of the
/// velocity field asks for,  Pi <- sigma Pi + (1 - sigma)(-2/3 rho tau S),  S by finite differences and without trace
/// (velocity_gradients.hpp). The whole stress is blended, in the second and the third order.
/// Source: Jacob, Malaspinas & Sagaut, J. Turbulence 19, 1051 (2018). sigma = 1: RR3. Linearly stable to |u| = 0.15 at
/// tau = 0.5003, sigma = 0.98. tau is that of the cell's own stress. Second order: nu = (tau - 1/2)/3.
struct Hrr : RelaxStress {
  template <class Real>
  [[gnu::always_inline]] static inline void blend(const CollisionConstants& c, const Real& les, const Real (&strain)[6],
                                                  CellState<Real>& s) {
    const Real own = constant<Real>(c.hrr_sigma);
    const Real field =
        constant<Real>((c.hrr_sigma - 1.0) / 3.0) * ((constant<Real>(1) + s.drho) * twice_tau(s.p, c, les));
    for (int n = 0; n < 6; ++n) s.p[n] = own * s.p[n] + field * strain[n];
  }

  template <bool Forced, class Real, class Put>
  [[gnu::always_inline]] static inline void assemble(const CellState<Real>& r, const Real (&force)[3], const Put& put) {
    Rr3::assemble<Forced>(r, force, put);
  }
};

/// Central moments with all but the deviatoric stress relaxed at 1: the third central moments vanish, the fourth are
/// those of the Maxwellian, rho/9.
/// Source: Geier, Greiner & Korvink, PRE 73, 066705 (2006); De Rosis, PRE 95, 013310 (2017); D3Q19 in closed form:
///   M_aabb = rho/9 + rho (u_a^2 + u_b^2)/3 + rho u_a^2 u_b^2 + 4 u_a u_b p_ab + u_a^2 p_bb + u_b^2 p_aa,
///   f*_{(s_a,s_b)} = (M_aabb + s_a M_abb + s_b M_aab + s_a s_b M_ab)/4,  f*_{+-a} from M_aa and M_a less the
///   diagonals.
/// With zero third central moments M_aab is that of RR3. Forces enter S and T as there.
/// Second order: nu = (tau - 1/2)/3. At tau = 0.5003 linearly unstable in a uniform flow (growth 5e-3 a step at
/// |u| = 0.10), so it wants an eddy viscosity; a comparator.
struct CentralMoments : RelaxStress {
  template <bool Forced, class Real, class Put>
  [[gnu::always_inline]] static inline void assemble(const CellState<Real>& r, const Real (&force)[3], const Put& put) {
    const auto a = detail::third_order<Forced>(r, force);
    const Real quarter = constant<Real>(0.25), third = constant<Real>(1.0 / 3.0), half = constant<Real>(0.5);
    const Real ninth = constant<Real>(1.0 / 9.0) * r.drho;
    const Real u2[3] = {r.u[0] * r.u[0], r.u[1] * r.u[1], r.u[2] * r.u[2]};
    const Real k[3] = {r.j[0] * r.u[0], r.j[1] * r.u[1], r.j[2] * r.u[2]};
    // M_aabb less the shift 1/9, over 4
    const auto fourth = [&](int d, int e, int n) __attribute__((always_inline)) {
      const Real cross = r.u[d] * r.u[e];
      return quarter * (ninth + third * (k[d] + k[e]) + k[d] * u2[e] + constant<Real>(4) * cross * r.p[n] +
                        u2[d] * r.p[e] + u2[e] * r.p[d]);
    };
    const Real xy = fourth(0, 1, 3), xz = fourth(0, 2, 4), yz = fourth(1, 2, 5);
    const Real m[3] = {third * r.drho + a.s[0], third * r.drho + a.s[1], third * r.drho + a.s[2]};
    put(Index<0>(), (r.drho - ((m[0] + m[1]) + m[2])) + constant<Real>(4) * ((xy + xz) + yz));
    detail::put_plane(put, Index<7>(), xy, quarter * a.s[3], a.h[0] + a.t[0][1], a.h[1] + a.t[1][0]);
    detail::put_plane(put, Index<11>(), xz, quarter * a.s[4], a.h[0] + a.t[0][2], a.h[2] + a.t[2][0]);
    detail::put_plane(put, Index<15>(), yz, quarter * a.s[5], a.h[1] + a.t[1][2], a.h[2] + a.t[2][1]);
    const Real two = constant<Real>(2);
    detail::put_axis(put, Index<1>(), Index<2>(), half * m[0] - two * (xy + xz),
                     two * (a.h[0] - (a.t[0][1] + a.t[0][2])));
    detail::put_axis(put, Index<3>(), Index<4>(), half * m[1] - two * (xy + yz),
                     two * (a.h[1] - (a.t[1][0] + a.t[1][2])));
    detail::put_axis(put, Index<5>(), Index<6>(), half * m[2] - two * (xz + yz),
                     two * (a.h[2] - (a.t[2][0] + a.t[2][1])));
  }
};

}  // namespace puffin::lbm
