#pragma once
// What every collision law shares: notation, moments of a cell, eddy viscosity. A law is 19 numbers in, 19 numbers out;
// it knows no index and no memory, and is written once over a number type `Real` (a double in tests, a SIMD pack in
// production). Populations are shifted: g_i = f_i - w_i.
//
// Notation (lattice units): rho density, u velocity, F body force, j = rho u, Pi non-equilibrium stress
//   Pi_ab = sum_i f_i c_a c_b - rho/3 d_ab - rho u_a u_b + (u_a F_b + u_b F_a)/2,
// tau relaxation time, omega = 1/tau. Order of symmetric tensors: xx, yy, zz, xy, xz, yz.
//
// A law reads population i with get(Index<i>()) and writes it with put(Index<i>(), value). `put` may overwrite what
// `get` reads for this direction or its opposite, so a law has read both before it writes either.

#include <cmath>
#include <type_traits>
#include <utility>

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

/// Inverse and square root of a number type. A kernel may give its packs faster ones, right to rounding.
template <class Real>
struct Arithmetic {
  [[gnu::always_inline]] static inline Real inverse(const Real& x) { return constant<Real>(1) / x; }
  [[gnu::always_inline]] static inline Real root(const Real& x) {
    using std::sqrt;
    return sqrt(x);
  }
  /// Of a number that is not zero.
  [[gnu::always_inline]] static inline Real positive_root(const Real& x) { return root(x); }
};

/// A direction known at compile time.
template <int I>
using Index = std::integral_constant<int, I>;

/// body(Index<0>()), ..., body(Index<N - 1>()): unlike a loop it leaves the compiler no doubt which member of an array
/// is meant, so the arrays of a law stay in registers.
template <int N, class Body>
[[gnu::always_inline]] inline void each(const Body& body) {
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) { (body(Index<I>()), ...); }
  (std::make_integer_sequence<int, N>());
}

/// What a law needs beside the populations; the same for every cell of a step.
struct CollisionConstants {
  double tau0 = 1.0;           // molecular relaxation time: nu = (tau0 - 1/2)/3
  double rescale = 1.0;        // ratio r = dt_new/dt_old, used in the one step in which the time step changes
  double tau0_rescaled = 1.0;  // relaxation time after the change
  double from_stress = 1.0;    // 1: the eddy viscosity follows the cell's stress (Smagorinsky); 0: `les` prescribes it
  double hrr_sigma = 0.98;     // share of the cell's own stress in Hrr
};

/// Density and velocity that a collision found; what interpolation, output and the health check want to know.
template <class Real>
struct CellMoments {
  Real density_excess;  // rho - 1
  Real ux, uy, uz;      // (j + F/2)/rho
};

/// Moments of a cell up to second order.
template <class Real>
struct Hydrodynamics {
  Real drho, rho, inverse_rho;  // rho - 1, rho, 1/rho
  Real j[3], u[3];              // (sum_i f_i c_i + F/2), and over rho
  Real pi[6];                   // Pi
};

/// Sums over the 19 populations, nothing else: no division yet.
template <class Real>
struct RawMoments {
  Real drho;  // sum_i g_i
  Real j[3];  // sum_i g_i c_i
  Real m[6];  // sum_i g_i c_a c_b, order as Pi
};

/// Reads the 19 populations once and returns their sums: drho = sum_i g_i, j = sum_i g_i c_i, m = sum_i g_i c_a c_b.
/// (By references to where they are wanted: a copy of them in memory costs a third of the reading.)
template <class Real, class Get>
[[gnu::always_inline]] inline void sum_moments(const Get& get, Real& drho, Real (&j)[3], Real (&m)[6]) {
  // The four diagonals of a plane (a,b), in the order ++, --, +-, -+.
  struct Plane {
    Real sum, cross, a, b;
  };
  const auto plane = [](Real pp, Real mm, Real pm, Real mp) __attribute__((always_inline)) {
    const Real same = pp + mm, other = pm + mp, d = pp - mm, e = pm - mp;
    return Plane{same + other, same - other, d + e, d - e};
  };
  const Plane xy = plane(get(Index<7>()), get(Index<8>()), get(Index<9>()), get(Index<10>()));
  m[3] = xy.cross;
  const Plane xz = plane(get(Index<11>()), get(Index<12>()), get(Index<13>()), get(Index<14>()));
  m[4] = xz.cross;
  const Plane yz = plane(get(Index<15>()), get(Index<16>()), get(Index<17>()), get(Index<18>()));
  m[5] = yz.cross;
  const Real x = xy.sum + xz.sum, all = (x + yz.sum) + get(Index<0>());
  const auto axis = [&](Real p, Real n, Real diagonals, Real side, auto d) __attribute__((always_inline)) {
    const Real both = p + n;
    m[d] = diagonals + both;
    j[d] = (p - n) + side;
    return both;
  };
  const Real x2 = axis(get(Index<1>()), get(Index<2>()), x, xy.a + xz.a, Index<0>());
  const Real y2 = axis(get(Index<3>()), get(Index<4>()), xy.sum + yz.sum, xy.b + yz.a, Index<1>());
  const Real z2 = axis(get(Index<5>()), get(Index<6>()), xz.sum + yz.sum, xz.b + yz.b, Index<2>());
  drho = ((all + x2) + y2) + z2;
}
template <class Real, class Get>
[[gnu::always_inline]] inline RawMoments<Real> raw_moments(const Get& get) {
  RawMoments<Real> r;
  sum_moments(get, r.drho, r.j, r.m);
  return r;
}

/// What follows from the sums. Forced: F is the body force on the cell.
template <bool Forced, class Real>
[[gnu::always_inline]] inline Hydrodynamics<Real> hydrodynamics(const RawMoments<Real>& r, const Real (&force)[3]) {
  Hydrodynamics<Real> h;
  h.drho = r.drho;
  each<3>([&](auto d) __attribute__((always_inline)) { h.j[d] = r.j[d]; });
  if constexpr (Forced)
    each<3>([&](auto d) __attribute__((always_inline)) { h.j[d] = h.j[d] + constant<Real>(0.5) * force[d]; });
  h.rho = constant<Real>(1) + h.drho;
  h.inverse_rho = Arithmetic<Real>::inverse(h.rho);
  each<3>([&](auto d) __attribute__((always_inline)) { h.u[d] = h.j[d] * h.inverse_rho; });
  const Real third = h.drho * constant<Real>(1.0 / 3.0);
  each<3>([&](auto d) __attribute__((always_inline)) { h.pi[d] = (r.m[d] - third) - h.j[d] * h.u[d]; });
  h.pi[3] = r.m[3] - h.j[0] * h.u[1];
  h.pi[4] = r.m[4] - h.j[0] * h.u[2];
  h.pi[5] = r.m[5] - h.j[1] * h.u[2];
  if constexpr (Forced) {
    const Real half = constant<Real>(0.5);
    each<3>([&](auto d) __attribute__((always_inline)) { h.pi[d] = h.pi[d] + h.u[d] * force[d]; });
    h.pi[3] = h.pi[3] + half * (h.u[0] * force[1] + h.u[1] * force[0]);
    h.pi[4] = h.pi[4] + half * (h.u[0] * force[2] + h.u[2] * force[0]);
    h.pi[5] = h.pi[5] + half * (h.u[1] * force[2] + h.u[2] * force[1]);
  }
  return h;
}

/// Both at once.
template <bool Forced, class Real, class Get>
[[gnu::always_inline]] inline Hydrodynamics<Real> hydrodynamics(const Get& get, const Real (&force)[3]) {
  return hydrodynamics<Forced>(raw_moments<Real>(get), force);
}

template <class Real>
[[gnu::always_inline]] inline CellMoments<Real> moments_of(const Hydrodynamics<Real>& h) {
  return {h.drho, h.u[0], h.u[1], h.u[2]};
}

/// Takes the trace out of the stress: the bulk part is relaxed to equilibrium at once.
template <class Real>
[[gnu::always_inline]] inline void remove_trace(Real (&pi)[6]) {
  const Real mean = ((pi[0] + pi[1]) + pi[2]) * constant<Real>(1.0 / 3.0);
  each<3>([&](auto d) __attribute__((always_inline)) { pi[d] = pi[d] - mean; });
}

/// |Pi|^2, the sum of the squares of all nine components.
template <class Real>
[[gnu::always_inline]] inline Real square_of(const Real (&p)[6]) {
  const Real diagonal = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  const Real across = p[3] * p[3] + p[4] * p[4] + p[5] * p[5];
  return diagonal + constant<Real>(2) * across;
}

/// Twice the relaxation time with an eddy viscosity. From the stress, Smagorinsky's in closed form:
///   2 tau = tau0 + sqrt(tau0^2 + 18 sqrt2 L^2 |Pi|/rho).
/// Source: Hou, Sterling, Chen & Doolen, Fields Inst. Comm. 6, 151 (1996). `les` = 18 sqrt2 L^2/rho, L in cells; |Pi|
/// of the deviatoric part where the caller has removed the trace. Prescribed (from_stress = 0): |Pi| is replaced by 1,
/// and `les` = 36 nu_t (nu_t + tau0/3) makes it tau0 + 3 nu_t (prescribed_les).
template <class Real>
[[gnu::always_inline]] inline Real twice_tau(const Real& stress2, const CollisionConstants& c, const Real& les) {
  const Real norm =
      Arithmetic<Real>::root(constant<Real>(c.from_stress) * stress2 + constant<Real>(1.0 - c.from_stress));
  return constant<Real>(c.tau0) + Arithmetic<Real>::positive_root(constant<Real>(c.tau0 * c.tau0) + les * norm);
}
template <class Real>
[[gnu::always_inline]] inline Real twice_tau(const Real (&p)[6], const CollisionConstants& c, const Real& les) {
  return twice_tau(square_of(p), c, les);
}

/// The `les` that gives the eddy viscosity nu_t [lattice units], over the density as twice_tau takes it:
///   (tau0 + 6 nu_t)^2 = tau0^2 + 12 tau0 nu_t + 36 nu_t^2.
template <class Real>
[[gnu::always_inline]] inline Real prescribed_les(const Real& nu_t, double tau0) {
  return nu_t * (constant<Real>(12.0 * tau0) + constant<Real>(36) * nu_t);
}

}  // namespace puffin::lbm
