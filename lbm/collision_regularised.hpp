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
  sum_moments(get, s.drho, s.j, s.p);
}

/// From raw moments to velocity and stress; the trace of the stress is relaxed at 1, so what belongs to it (rho/3) need
/// not be subtracted. `les` is 18 sqrt2 L^2, and over the density on return.
template <bool Forced, class Real>
[[gnu::always_inline]] inline void find_stress(const Real (&force)[3], Real& les, CellState<Real>& s) {
  const Real half = constant<Real>(0.5);
  if constexpr (Forced) each<3>([&](auto d) __attribute__((always_inline)) { s.j[d] = s.j[d] + half * force[d]; });
  const Real inverse_rho = Arithmetic<Real>::inverse(constant<Real>(1) + s.drho);
  les = les * inverse_rho;
  each<3>([&](auto d) __attribute__((always_inline)) { s.u[d] = s.j[d] * inverse_rho; });
  const auto less_flow = [&](auto d, auto e, auto n) __attribute__((always_inline)) {
    Real p = s.p[n] - s.j[d] * s.u[e];
    if constexpr (Forced) p = p + half * (s.u[d] * force[e] + s.u[e] * force[d]);
    return p;
  };
  const Real xx = less_flow(Index<0>(), Index<0>(), Index<0>()), yy = less_flow(Index<1>(), Index<1>(), Index<1>()),
             zz = less_flow(Index<2>(), Index<2>(), Index<2>());
  const Real mean = ((xx + yy) + zz) * constant<Real>(1.0 / 3.0);
  s.p[0] = xx - mean;
  s.p[1] = yy - mean;
  s.p[2] = zz - mean;
  s.p[3] = less_flow(Index<0>(), Index<1>(), Index<3>());
  s.p[4] = less_flow(Index<0>(), Index<2>(), Index<4>());
  s.p[5] = less_flow(Index<1>(), Index<2>(), Index<5>());
}

/// Both at once.
template <bool Forced, class Real, class Get>
[[gnu::always_inline]] inline void find_state(const Get& get, const Real (&force)[3], Real& les, CellState<Real>& s) {
  read_moments(get, s);
  find_stress<Forced>(force, les, s);
}

/// Relaxation of the stress: returns 1 - omega. `les` = 18 sqrt2 L^2/rho. On return stress2 is no less than the square
/// of the relaxed stress.
struct RelaxStress {
  static double old_force(const CollisionConstants&) { return 1.0; }  // factor of the force in the units of the state

  template <class Real>
  [[gnu::always_inline]] static inline Real relax(const CollisionConstants& c, const Real& les, CellState<Real>& s,
                                                  Real& stress2) {
    stress2 = square_of(s.p);  // |1 - omega| < 1
    return constant<Real>(1) - constant<Real>(2) * Arithmetic<Real>::inverse(twice_tau(stress2, c, les));
  }
};

/// The same in the step in which the time step changes to dt' = r dt. The force is in the new units, F = F'/r^2 in the
/// old:  rho' = 1 + r^2 (rho - 1),  u' = r u,  tau' = tau0' + r (tau - tau0),  Pi' = r (tau'/tau) (rho'/rho) Pi.
/// Source: dimensional analysis of rho, u, Pi = -2 rho tau S/3; exact for a regularised state, which holds no more.
struct RelaxRescaled {
  static double old_force(const CollisionConstants& c) { return 1.0 / (c.rescale * c.rescale); }

  template <class Real>
  [[gnu::always_inline]] static inline Real relax(const CollisionConstants& c, const Real& les, CellState<Real>& s,
                                                  Real& stress2) {
    stress2 = constant<Real>(1);  // not known
    const Real one = constant<Real>(1), r = constant<Real>(c.rescale);
    const Real tau = constant<Real>(0.5) * twice_tau(s.p, c, les);
    const Real tau_new = constant<Real>(c.tau0_rescaled) + r * (tau - constant<Real>(c.tau0));
    const Real old_rho = one + s.drho;
    s.drho = constant<Real>(c.rescale * c.rescale) * s.drho;
    const Real rho = one + s.drho;
    each<3>([&](auto d) __attribute__((always_inline)) { s.u[d] = s.u[d] * r; });
    each<3>([&](auto d) __attribute__((always_inline)) { s.j[d] = rho * s.u[d]; });
    return (one - one / tau_new) * (r * (tau_new / tau) * (rho / old_rho));
  }
};

namespace detail {

/// Quantities of both regularised laws, in the units in which they are added.
template <class Real>
struct Assembly {
  Real s[6];       // S_ab = rho u_a u_b + p_ab + (u_a F_b + u_b F_a)/2
  Real j4[3];      // j*_a/4, j* = rho u + F/2
  Real odd[3][3];  // odd[a][b] = j*_a/12 + T_abb/4, a != b: what diagonals of the plane (a,b) carry along a
};

/// T_aab = rho u_a^2 u_b + 2 u_a p_ab + u_b p_aa + (u_a^2 F_b + 2 u_a u_b F_a)/2 = u_a (S_ab + p_ab) + u_b q_aa, where
/// q_aa = p_aa + u_a F_a/2 and S_ab + p_ab holds the force once.
template <bool Forced, class Real>
[[gnu::always_inline]] inline Assembly<Real> third_order(const CellState<Real>& r, const Real (&force)[3]) {
  Assembly<Real> a;
  const Real quarter = constant<Real>(0.25), half = constant<Real>(0.5);
  const Real u4[3] = {quarter * r.u[0], quarter * r.u[1], quarter * r.u[2]};
  Real q[3], j12[3];
  each<3>([&](auto d) __attribute__((always_inline)) {
    a.s[d] = r.j[d] * r.u[d] + r.p[d];
    q[d] = r.p[d];
    Real j = r.j[d];
    if constexpr (Forced) {
      const Real work = r.u[d] * force[d];
      a.s[d] = a.s[d] + work;
      q[d] = q[d] + half * work;
      j = j + half * force[d];
    }
    a.j4[d] = quarter * j;
    j12[d] = constant<Real>(1.0 / 12.0) * j;
  });
  const auto pair = [&](auto d, auto e, auto n) __attribute__((always_inline)) {
    a.s[n] = r.j[d] * r.u[e] + r.p[n];
    if constexpr (Forced) a.s[n] = a.s[n] + half * (r.u[d] * force[e] + r.u[e] * force[d]);
    const Real both = a.s[n] + r.p[n];
    a.odd[d][e] = u4[e] * both + (u4[d] * q[e] + j12[d]);
    a.odd[e][d] = u4[d] * both + (u4[e] * q[d] + j12[e]);
  };
  pair(Index<0>(), Index<1>(), Index<3>());
  pair(Index<0>(), Index<2>(), Index<4>());
  pair(Index<1>(), Index<2>(), Index<5>());
  return a;
}

/// The odd part of an axis a is what the diagonals leave of the momentum, 2 (j*_a/4 - odd[a][b] - odd[a][c]); `even` is
/// half of the even part.
template <class Real, class Put, int Plus, int Minus>
[[gnu::always_inline]] inline void put_axis(const Put& put, Index<Plus> plus, Index<Minus> minus, Real even, Real j4,
                                            Real odd_b, Real odd_c) {
  const Real two = constant<Real>(2), both = two * even, odd = j4 - (odd_b + odd_c);
  put(plus, both + two * odd);
  put(minus, both - two * odd);
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

/// Where no population of Rr3 without a force can be below w_i/10, so that the positivity limiter need not look at
/// them:
///   |u|^2/0.3^2 + |p|^2/0.02^2 + (rho - 1)^2/0.1^2 < 1,
/// p the relaxed stress. For a diagonal, m = c u (abs(m) <= sqrt2 u), and by Cauchy-Schwarz in the stress,
///   f/w >= rho (1 + 3 m + 9/2 m^2 - 3/2 u^2 - 6.4 u^3) - (9 + 20.2 u) |p|
/// is at least 0.11 there; axes and rest have more. Checked by tests/lbm/test_collision.cpp.
/// Returns that sum.
template <class Real>
[[gnu::always_inline]] inline Real distance_from_rest(const Real& drho, const Real& speed2, const Real& stress2) {
  const Real tenths = constant<Real>(10) * drho;
  return tenths * tenths + (constant<Real>(1.0 / 0.09) * speed2 + constant<Real>(2500) * stress2);
}

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
  static constexpr bool positive_near_rest = true;
  template <bool Forced, class Real, class Put>
  [[gnu::always_inline]] static inline void assemble(const CellState<Real>& r, const Real (&force)[3], const Put& put) {
    const auto a = detail::third_order<Forced>(r, force);
    const Real trace = (a.s[0] + a.s[1]) + a.s[2];
    const Real base = constant<Real>(1.0 / 36.0) * r.drho - constant<Real>(1.5 / 36.0) * trace;
    const Real eighth = constant<Real>(0.125), quarter = constant<Real>(0.25);
    put(Index<0>(), constant<Real>(12) * base);
    const Real ex = base + eighth * a.s[0], ey = base + eighth * a.s[1], ez = base + eighth * a.s[2];
    detail::put_plane(put, Index<7>(), ex + eighth * a.s[1], quarter * a.s[3], a.odd[0][1], a.odd[1][0]);
    detail::put_plane(put, Index<11>(), ex + eighth * a.s[2], quarter * a.s[4], a.odd[0][2], a.odd[2][0]);
    detail::put_plane(put, Index<15>(), ey + eighth * a.s[2], quarter * a.s[5], a.odd[1][2], a.odd[2][1]);
    detail::put_axis(put, Index<1>(), Index<2>(), ex, a.j4[0], a.odd[0][1], a.odd[0][2]);
    detail::put_axis(put, Index<3>(), Index<4>(), ey, a.j4[1], a.odd[1][0], a.odd[1][2]);
    detail::put_axis(put, Index<5>(), Index<6>(), ez, a.j4[2], a.odd[2][0], a.odd[2][1]);
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
  static constexpr bool positive_near_rest = true;
  template <class Real>
  [[gnu::always_inline]] static inline void blend(const CollisionConstants& c, const Real& les, const Real (&strain)[6],
                                                  CellState<Real>& s) {
    const Real own = constant<Real>(c.hrr_sigma);
    const Real field =
        constant<Real>((c.hrr_sigma - 1.0) / 3.0) * ((constant<Real>(1) + s.drho) * twice_tau(s.p, c, les));
    each<6>([&](auto n) __attribute__((always_inline)) { s.p[n] = own * s.p[n] + field * strain[n]; });
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
    const Real quarter = constant<Real>(0.25), third = constant<Real>(1.0 / 3.0);
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
    detail::put_plane(put, Index<7>(), xy, quarter * a.s[3], a.odd[0][1], a.odd[1][0]);
    detail::put_plane(put, Index<11>(), xz, quarter * a.s[4], a.odd[0][2], a.odd[2][0]);
    detail::put_plane(put, Index<15>(), yz, quarter * a.s[5], a.odd[1][2], a.odd[2][1]);
    detail::put_axis(put, Index<1>(), Index<2>(), quarter * m[0] - (xy + xz), a.j4[0], a.odd[0][1], a.odd[0][2]);
    detail::put_axis(put, Index<3>(), Index<4>(), quarter * m[1] - (xy + yz), a.j4[1], a.odd[1][0], a.odd[1][2]);
    detail::put_axis(put, Index<5>(), Index<6>(), quarter * m[2] - (xz + yz), a.j4[2], a.odd[2][0], a.odd[2][1]);
  }
};

}  // namespace puffin::lbm
