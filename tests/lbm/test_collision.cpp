// Every collision law, cell by cell in double: what it conserves, what it leaves alone, what it relaxes, its forcing.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "lbm/collision_regularised.hpp"
#include "lbm/collision_relaxing.hpp"

using namespace puffin::lbm;

namespace {

using Cell = std::array<double, 19>;
using Vector = std::array<double, 3>;

/// One cell through a law, as the kernel does it without limiter.
template <class L>
Cell collide(const Cell& f, const Vector& force, double tau, double les = 0.0) {
  CollisionConstants c;
  c.tau0 = tau;
  const double F[3] = {force[0], force[1], force[2]};
  Cell out{};
  const auto get = [&](auto i) { return f[i]; };
  const auto put = [&](auto i, double v) { out[i] = v; };
  if constexpr (requires { &L::template relax<double>; }) {
    CellState<double> s;
    find_state<true>(get, F, les, s);
    if constexpr (requires { &L::template blend<double>; }) {
      // A velocity field whose strain rate agrees with the stress, Pi = -2/3 rho tau S: the blend must change nothing.
      double strain[6];
      for (int n = 0; n < 6; ++n) strain[n] = -3.0 * s.p[n] / ((1.0 + s.drho) * twice_tau(s.p, c, les));
      L::blend(c, les, strain, s);
    }
    double stress2 = 0.0;
    const double keep = L::relax(c, les, s, stress2);
    for (double& p : s.p) p *= keep;
    L::template assemble<true>(s, F, put);
  } else {
    L::template collide<true>(get, put, F, c, les);
  }
  return out;
}

double mass(const Cell& f) {
  double sum = 0.0;
  for (const double v : f) sum += v;
  return sum;
}
Vector momentum(const Cell& f) {
  Vector j{0, 0, 0};
  for (int i = 0; i < 19; ++i)
    for (int d = 0; d < 3; ++d) j[d] += f[i] * d3q19::velocity[i][d];
  return j;
}
/// sum_i f_i c_a c_b
double second(const Cell& f, int a, int b) {
  double sum = 0.0;
  for (int i = 0; i < 19; ++i) sum += f[i] * d3q19::velocity[i][a] * d3q19::velocity[i][b];
  return sum;
}

Cell disturbed(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Cell f;
  for (int i = 0; i < 19; ++i) f[i] = 0.1 * d3q19::weight[i] * uniform(random);
  return f;
}

/// The state that a law makes of a density and a velocity without stress.
template <class L>
Cell equilibrium(double drho, const Vector& u) {
  CellState<double> s;
  s.drho = drho;
  for (int d = 0; d < 3; ++d) s.u[d] = u[d], s.j[d] = (1.0 + drho) * u[d];
  for (double& p : s.p) p = 0.0;
  const double none[3] = {0, 0, 0};
  Cell out{};
  L::template assemble<false>(s, none, [&](auto i, double v) { out[i] = v; });
  return out;
}

template <class L>
class CollisionLaw : public testing::Test {};
using Laws = testing::Types<Rr3, Hrr, CentralMoments, Trt, Bgk>;
TYPED_TEST_SUITE(CollisionLaw, Laws);

// Sums of 19 numbers below 1, some ten roundings each: 1e-15 times a few.
constexpr double rounding = 2e-15;

TYPED_TEST(CollisionLaw, ConservesMass) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Cell f = disturbed(seed);
    EXPECT_NEAR(mass(collide<TypeParam>(f, {1e-3, -2e-3, 5e-4}, 0.6, 0.3)), mass(f), rounding);
  }
}

TYPED_TEST(CollisionLaw, AddsTheForceToTheMomentum) {
  const Vector force{1e-3, -2e-3, 5e-4};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Cell f = disturbed(seed), after = collide<TypeParam>(f, force, 0.6, 0.3);
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(momentum(after)[d], momentum(f)[d] + force[d], rounding);
  }
}

TYPED_TEST(CollisionLaw, RelaxesTheDeviatoricStressWithTau) {
  // S_ab - rho/3 d_ab - rho u_a u_b shrinks by 1 - 1/tau off the diagonal; tau without eddy viscosity.
  const double tau = 0.73;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Cell f = disturbed(seed), after = collide<TypeParam>(f, {0, 0, 0}, tau);
    const Vector j = momentum(f);
    const double rho = 1.0 + mass(f);
    for (const auto [a, b] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) {
      const double uu = j[a] * j[b] / rho;
      EXPECT_NEAR(second(after, a, b) - uu, (1.0 - 1.0 / tau) * (second(f, a, b) - uu), rounding);
    }
  }
}

TYPED_TEST(CollisionLaw, ForcesAtSecondOrder) {
  // Guo: the second moment of the force term is (1 - omega/2)(u_a F_b + u_b F_a) after collision, beside the relaxed
  // stress of a cell whose non-equilibrium part is zero when u = (j + F/2)/rho. Start from such a cell: raw second
  // moment rho u u - (uF + Fu)/2, so Pi = 0 and the moment after collision is rho u_a u_b + (u_a F_b + u_b F_a)/2.
  const Vector u{0.05, -0.03, 0.02}, force{1e-3, -2e-3, 5e-4};
  const double rho = 1.02;
  Cell f{};
  for (int i = 0; i < 19; ++i) {
    const auto& c = d3q19::velocity[i];
    double jc = 0.0, qc = 0.0;
    for (int a = 0; a < 3; ++a) {
      jc += (rho * u[a] - 0.5 * force[a]) * c[a];
      for (int b = 0; b < 3; ++b) {
        const double q = rho * u[a] * u[b] - 0.5 * (u[a] * force[b] + u[b] * force[a]);
        qc += q * (c[a] * c[b] - (a == b ? 1.0 / 3.0 : 0.0));
      }
    }
    f[i] = d3q19::weight[i] * (rho - 1.0 + 3.0 * jc + 4.5 * qc);
  }
  const Cell after = collide<TypeParam>(f, force, 0.8);
  for (const auto [a, b] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}})
    EXPECT_NEAR(second(after, a, b), rho * u[a] * u[b] + 0.5 * (u[a] * force[b] + u[b] * force[a]), rounding);
}

TYPED_TEST(CollisionLaw, TurnsWithTheAxes) {
  // A quarter turn about z takes (x,y,z) to (-y,x,z).
  std::array<int, 19> turned{};
  for (int i = 0; i < 19; ++i)
    for (int k = 0; k < 19; ++k)
      if (d3q19::velocity[k][0] == -d3q19::velocity[i][1] && d3q19::velocity[k][1] == d3q19::velocity[i][0] &&
          d3q19::velocity[k][2] == d3q19::velocity[i][2])
        turned[i] = k;
  const Cell f = disturbed(7);
  Cell g;
  for (int i = 0; i < 19; ++i) g[turned[i]] = f[i];
  const Cell a = collide<TypeParam>(f, {1e-3, 2e-3, 3e-3}, 0.6, 0.3);
  const Cell b = collide<TypeParam>(g, {-2e-3, 1e-3, 3e-3}, 0.6, 0.3);
  for (int i = 0; i < 19; ++i) EXPECT_NEAR(b[turned[i]], a[i], rounding);
}

TYPED_TEST(CollisionLaw, AddsEddyViscosityWithTheStress) {
  // A larger mixing length relaxes less: with omega between 1 and 2 the stress after collision is farther from
  // reversed.
  const Cell f = disturbed(3);
  const Vector j = momentum(f);
  const double uu = j[0] * j[1] / (1.0 + mass(f)), before = second(f, 0, 1) - uu;
  const double bare = (second(collide<TypeParam>(f, {0, 0, 0}, 0.55, 0.0), 0, 1) - uu) / before;
  const double eddy = (second(collide<TypeParam>(f, {0, 0, 0}, 0.55, 0.5), 0, 1) - uu) / before;
  EXPECT_NEAR(bare, 1.0 - 1.0 / 0.55, 1e-12);
  EXPECT_GT(eddy, bare + 1e-3);
}

TEST(RegularisedLaws, KeepTheirEquilibrium) {
  const Vector u{0.08, -0.05, 0.11};
  for (int i = 0; i < 19; ++i) {
    EXPECT_NEAR((collide<Rr3>(equilibrium<Rr3>(0.03, u), {0, 0, 0}, 0.5003)[i]), (equilibrium<Rr3>(0.03, u)[i]),
                rounding);
    EXPECT_NEAR((collide<CentralMoments>(equilibrium<CentralMoments>(0.03, u), {0, 0, 0}, 0.5003)[i]),
                (equilibrium<CentralMoments>(0.03, u)[i]), rounding);
  }
}

TEST(RegularisedLaws, HaveTheThirdMomentsOfTheMaxwellian) {
  // M_aab = rho u_b (u_a^2 + 1/3) for both laws: exact, but for rounding.
  const Vector u{0.08, -0.05, 0.11};
  for (const Cell& f : {equilibrium<Rr3>(0.03, u), equilibrium<CentralMoments>(0.03, u)})
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        if (a == b) continue;
        double m = 0.0;
        for (int i = 0; i < 19; ++i) {
          const auto& c = d3q19::velocity[i];
          m += f[i] * c[a] * c[a] * c[b];
        }
        EXPECT_NEAR(m, 1.03 * u[b] * (u[a] * u[a] + 1.0 / 3.0), rounding);
      }
}

TEST(CentralMoments, HasTheFourthMomentsOfTheMaxwellian) {
  // M_aabb = rho (u_a^2 + 1/3)(u_b^2 + 1/3); the populations are shifted by w, whose moment is 1/9.
  const Vector u{0.08, -0.05, 0.11};
  const Cell f = equilibrium<CentralMoments>(0.03, u);
  for (const auto [a, b] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) {
    double m = 1.0 / 9.0;
    for (int i = 0; i < 19; ++i) {
      const auto& c = d3q19::velocity[i];
      m += f[i] * c[a] * c[a] * c[b] * c[b];
    }
    EXPECT_NEAR(m, 1.03 * (u[a] * u[a] + 1.0 / 3.0) * (u[b] * u[b] + 1.0 / 3.0), rounding);
  }
}

TEST(Trt, RelaxesTheOddPartWithTheMagicRateButNotSlowerThanInTwoSteps) {
  // (tau+ - 1/2)(tau- - 1/2) = 3/16: at tau+ = 0.75, tau- = 1.25. The part of (f_7 - f_8) - (f_9 - f_10) with no
  // momentum, less than what axes balance, shrinks by 1 - 1/tau-. Take an odd disturbance without momentum and density.
  // At tau+ = 0.51 the product asks for tau- = 19.25: cut to 2.
  Cell f{};
  f[7] = 1e-3, f[8] = -1e-3, f[9] = 1e-3, f[10] = -1e-3;  // j_x = 4e-3
  f[1] = -2e-3, f[2] = 2e-3;                              // and back to zero
  for (const auto& [even, odd] : {std::pair(0.75, 1.25), std::pair(0.51, 2.0)}) {
    const Cell after = collide<Trt>(f, {0, 0, 0}, even);
    EXPECT_NEAR(after[7] - after[8], (1.0 - 1.0 / odd) * 2e-3, rounding) << even;
  }
}

TEST(Hrr, TakesTheRestOfTheStressFromTheStrainRate) {
  // A cell without stress of its own in a field with S: Pi = -(1 - sigma) 2/3 rho tau S.
  CollisionConstants c;
  c.tau0 = 0.7;
  c.hrr_sigma = 0.9;
  const double strain[6] = {2e-3, -1e-3, -1e-3, 5e-4, -3e-4, 7e-4};
  CellState<double> s;
  s.drho = 0.05;
  for (double& p : s.p) p = 0.0;
  Hrr::blend(c, 0.0, strain, s);
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(s.p[n], -0.1 * 2.0 / 3.0 * 1.05 * 0.7 * strain[n], 1e-18);
}

TEST(PrescribedEddyViscosity, IsAddedToTheMolecularOne) {
  // tau = tau0 + 3 nu_t, whatever the stress.
  CollisionConstants c;
  c.tau0 = 0.5003;
  c.from_stress = 0.0;
  const double stress[6] = {1e-3, 2e-3, -3e-3, 4e-4, 0, 1e-4}, nu_t = 2.5e-3;
  EXPECT_NEAR(0.5 * twice_tau(stress, c, prescribed_les(nu_t, c.tau0)), 0.5003 + 3.0 * nu_t, 1e-15);
}

TEST(Rr3Rescaled, IsTheLawItselfWhenTheStepStays) {
  const Cell f = disturbed(5);
  const Cell a = collide<Rr3>(f, {1e-3, 2e-3, 3e-3}, 0.6, 0.3);
  CollisionConstants c;
  c.tau0 = c.tau0_rescaled = 0.6;
  const double F[3] = {1e-3, 2e-3, 3e-3};
  double les = 0.3;
  CellState<double> s;
  find_state<true>([&](auto i) { return f[i]; }, F, les, s);
  double stress2 = 0.0;
  const double keep = Rr3Rescaled::relax(c, les, s, stress2);
  for (double& p : s.p) p *= keep;
  Rr3Rescaled::assemble<true>(s, F, [&](auto i, double v) { EXPECT_NEAR(v, a[i], rounding); });
}

}  // namespace
