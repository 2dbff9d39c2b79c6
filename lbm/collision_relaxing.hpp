#pragma once
// Laws that relax the populations themselves, with one or two rates. Comparators: near tau = 1/2 they are stable only
// for slow, well-resolved flow.

#include <algorithm>

#include "lbm/collision.hpp"

namespace puffin::lbm {

/// Below this tau- = 1/2 + magic/(tau+ - 1/2) > 2 is cut to 2: near tau+ = 1/2 the odd parts would hardly relax at all
/// and grow without bound where the flow is not smooth (a duct at Re 100, tau+ = 0.515: diverged with every kind of
/// wall). With magic 3/16 that is tau+ < 0.625; there walls lie as with the other laws, not exactly half-way.
inline constexpr double least_odd_rate = 0.5;

/// Two relaxation times (TRT): the parts even and odd under c -> -c relax with tau+ (viscosity) and tau-, chosen so
/// that (tau+ - 1/2)(tau- - 1/2) = magic. Second-order equilibrium, Guo forcing. Source: Ginzburg, Verhaeghe &
/// d'Humieres, Commun. Comput. Phys. 3, 427 (2008); Guo, Zheng & Shi, PRE 65, 046308 (2002). `Magic` in units of 1/16;
/// 3: plane walls half-way between cells are exact in Poiseuille flow. 0: tau- = tau+ (BGK; Qian, d'Humieres &
/// Lallemand, EPL 17, 479 (1992)).
template <int Magic>
struct TwoRelaxationTimes {
  template <bool Forced, class Real, class Get, class Put>
  [[gnu::always_inline]] static inline CellMoments<Real> collide(const Get& get, const Put& put, const Real (&force)[3],
                                                                 const CollisionConstants& c, const Real& les) {
    const Hydrodynamics<Real> h = hydrodynamics<Forced>(get, force);
    const Real one = constant<Real>(1), half = constant<Real>(0.5);
    const Real tau = half * twice_tau(h.pi, c, les * h.inverse_rho);
    const Real even = one / tau;
    Real odd = even;
    if constexpr (Magic > 0) {
      using std::max;
      odd = max(one / (half + constant<Real>(Magic / 16.0) / (tau - half)), constant<Real>(least_odd_rate));
    }
    const Real u2 = (h.u[0] * h.u[0] + h.u[1] * h.u[1]) + h.u[2] * h.u[2];
    Real uf = constant<Real>(0);
    if constexpr (Forced) uf = (h.u[0] * force[0] + h.u[1] * force[1]) + h.u[2] * force[2];
    const auto pair = [&]<int P, int M>(Index<P> plus, Index<M> minus) __attribute__((always_inline)) {
      const auto along = [](const Real(&v)[3]) __attribute__((always_inline)) {
        Real sum = constant<Real>(0);
        for (int d = 0; d < 3; ++d) {
          if (d3q19::velocity[P][d] > 0) sum = sum + v[d];
          if (d3q19::velocity[P][d] < 0) sum = sum - v[d];
        }
        return sum;
      };
      const Real w = constant<Real>(d3q19::weight[P]), cu = along(h.u);
      const Real eq_even = w * (h.drho + h.rho * (constant<Real>(4.5) * cu * cu - constant<Real>(1.5) * u2));
      const Real eq_odd = w * constant<Real>(3) * (h.rho * cu);
      const Real p = get(plus), m = get(minus);
      const Real sum = half * (p + m), difference = half * (p - m);
      Real s = sum + even * (eq_even - sum), a = difference + odd * (eq_odd - difference);
      if constexpr (Forced) {
        const Real cf = along(force);
        s = s + (one - half * even) * w * (constant<Real>(9) * cu * cf - constant<Real>(3) * uf);
        a = a + (one - half * odd) * w * (constant<Real>(3) * cf);
      }
      put(plus, s + a);
      put(minus, s - a);
    };
    const Real w0 = constant<Real>(d3q19::weight[0]), rest = get(Index<0>());
    Real f0 = rest + even * (w0 * (h.drho - constant<Real>(1.5) * h.rho * u2) - rest);
    if constexpr (Forced) f0 = f0 - (one - half * even) * w0 * constant<Real>(3) * uf;
    put(Index<0>(), f0);
    pair(Index<1>(), Index<2>());
    pair(Index<3>(), Index<4>());
    pair(Index<5>(), Index<6>());
    pair(Index<7>(), Index<8>());
    pair(Index<9>(), Index<10>());
    pair(Index<11>(), Index<12>());
    pair(Index<13>(), Index<14>());
    pair(Index<15>(), Index<16>());
    pair(Index<17>(), Index<18>());
    return moments_of(h);
  }
};
using Bgk = TwoRelaxationTimes<0>;
using Trt = TwoRelaxationTimes<3>;

}  // namespace puffin::lbm
