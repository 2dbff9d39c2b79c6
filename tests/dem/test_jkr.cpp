// JKR and DMT adhesion on Hertz contacts: pull-off, hysteresis, sticking.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "dem/adhesion_spread.hpp"
#include "dem/dmt.hpp"
#include "dem/hertz.hpp"
#include "dem/jkr.hpp"
#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

constexpr double radius = 35e-6;

Scene sticky_floor(const Adhesion& adhesion, double young, double e) {
  Scene s;
  HertzContact law;
  law.restitution = e;
  law.body = law.partner = {young, 0.3};
  s.models.carrier.contact = law;
  law.partner.youngs_modulus *= 1e6;
  s.models.wall.contact = law;
  s.models.carrier.adhesion = s.models.wall.adhesion = adhesion;
  s.walls = PlaneWalls::floor();
  s.models.integration.sleep = false;
  return s;
}

/// True if a carrier that rests on the floor is still there 4 ms after it began to be pulled with `force`.
bool holds(const Adhesion& adhesion, double young, double force) {
  Scene s = sticky_floor(adhesion, young, 0.1);
  s.add(lactose(0, {0, 0, radius}));
  s.loads[0].force = {0, 0, -1e-8};
  s.run(300e-6, 1e-6);
  for (int n = 1; n <= 400; ++n) {  // slow against the 20 us of its oscillation
    s.loads[0].force = {0, 0, force * n / 400};
    s.step(5e-6);
  }
  s.run(2e-3, 5e-6);
  return s.events.ended.empty();
}

void expect_pull_off(const Adhesion& adhesion, double young, double force) {
  EXPECT_TRUE(holds(adhesion, young, 0.999 * force)) << young;
  EXPECT_FALSE(holds(adhesion, young, 1.001 * force)) << young;
}

/// Speed of leaving after an impact at `speed`; 0: stuck.
double leaving(const Adhesion& adhesion, double young, double e, double speed) {
  Scene s = sticky_floor(adhesion, young, e);
  s.add(lactose(0, {0, 0, radius * 1.0001}, {0, 0, -speed}));
  for (int i = 0; i < 4000 && s.events.ended.empty(); ++i) s.step(0.2e-6);
  return s.events.ended.empty() ? 0.0 : s.v(0).z();
}

double sticking_speed(double gamma, double young, double mass) {  // Thornton & Ning (1998)
  const double modulus = young / 0.91;
  return std::sqrt(2.0 * jkr_loss(2.0 * gamma, radius, modulus) / mass);
}

}  // namespace

// The curve against its own definition in a: delta = a^2/R - sqrt(2 pi W a/E), F = 4 E a^3/(3 R) - sqrt(8 pi W E a^3).
TEST(Jkr, CurveIsThatOfJohnsonKendallAndRoberts) {
  const double w = 7.2e-3, e = 26e9;
  const JkrCurve curve(w, radius, e);
  for (const double ratio : {0.35, 0.5, 0.763, 1.0, 2.0, 10.0}) {
    const double a = ratio * curve.radius;
    const double delta = a * a / radius - std::sqrt(2.0 * std::numbers::pi * w * a / e);
    const double force = 4.0 * e * a * a * a / (3.0 * radius) - std::sqrt(8.0 * std::numbers::pi * w * e * a * a * a);
    EXPECT_NEAR(curve.contact_radius(delta), a, 1e-9 * a) << ratio;
    EXPECT_NEAR(curve.force(a), force, 1e-9 * (std::abs(force) + curve.pull_off));
  }
  EXPECT_NEAR(curve.force(curve.contact_radius(0.0)), -8.0 / 9.0 * curve.pull_off, 1e-9 * curve.pull_off);
  EXPECT_NEAR(curve.force(curve.contact_radius(-curve.stretch)), -5.0 / 9.0 * curve.pull_off, 1e-6 * curve.pull_off);
}

// No surface energy: Hertz. At 1e6 times the pull-off overlap adhesion is below 1e-6 of... F ~ 4 F_c s^6, its
// correction s^-3 = (delta/delta_c)^(-3/4).
TEST(Jkr, TendsToHertzFarFromPullOff) {
  const JkrCurve curve(7.2e-3, radius, 1e9);
  const double overlap = 1e4 * curve.stretch;
  const double hertz = 4.0 / 3.0 * 1e9 * std::sqrt(radius) * std::pow(overlap, 1.5);
  EXPECT_NEAR(curve.force(curve.contact_radius(overlap)) / hertz, 1.0, 5e-3);
}

TEST(Jkr, LossIsTheAreaOfTheHysteresis) {  // the 7.09 of Thornton & Ning, from the curve itself, rounded at 5e-3
  const double w = 7.2e-3, e = 1e9;
  const JkrCurve curve(w, radius, e);
  double area = 0.0;
  const int n = 200000;
  for (int i = 0; i < n; ++i)
    area -= curve.force(curve.contact_radius(-curve.stretch * (i + 0.5) / n)) * curve.stretch / n;
  EXPECT_NEAR(area, jkr_loss(w, radius, e), 1e-3 * area);
}

// Catalogue D10: 3 pi gamma R = 1.1875e-6 N, 4 pi gamma R = 1.5834e-6 N, whatever the modulus, within 0.1 %.
TEST(Jkr, SlowPullsEndAtThreeAndFourPiGammaR) {
  for (const double young : {1e7, 1e8, 24e9}) {
    expect_pull_off(Jkr{3.6e-3, {}, {}}, young, 1.1875e-6);
    expect_pull_off(Dmt{3.6e-3, 4e-10, {}, {}}, young, 1.5834e-6);
    expect_pull_off(Hamaker{3.6e-3, 0.0, 4e-10, {}, {}}, young, 1.5834e-6);
  }
}

// A case may place a carrier so that it hangs: loaded at rest it stays where it is, to the nanometre, up to its
// pull-off force; beyond, it is F t^2/(2 m) = 6e-4 m away after 0.5 ms.
TEST(Jkr, ACarrierPlacedOnAWallHoldsUpToItsPullOffForceWhateverTheModulus) {
  const Adhesion laws[] = {Jkr{3.6e-3, {}, {}}, Dmt{3.6e-3, 4e-10, {}, {}}};
  const double forces[] = {1.1875e-6, 1.5834e-6};
  for (int law = 0; law < 2; ++law)
    for (const double young : {1e7, 24e9})
      for (const double part : {0.1, 0.98, 1.02}) {
        Scene s = sticky_floor(laws[law], young, 0.6);
        s.add(lactose(0, {0, 0, radius}));
        s.loads[0].force = {0, 0, part * forces[law]};
        s.run(0.5e-3, 5e-6);
        if (part < 1.0)
          EXPECT_NEAR(s.x(0).z(), radius, 1e-9) << law << " " << young << " " << part;
        else
          EXPECT_GT(s.x(0).z(), 2.0 * radius) << law << " " << young;
      }
}

// Catalogue D11: e = sqrt(1 - (v_s/v)^2). The loss is right within 1 % (sub-steps of a twentieth of delta_c on a force
// that changes by F_c over it): at v/v_s = 1.1 that is 0.5 % of v_s^2/v^2 / e^2 = 2.5 % of e.
TEST(Jkr, ReboundsAsThorntonAndNing) {
  const double mass = lactose(0, {0, 0, 0}).mass;
  for (const double gamma : {3.6e-3, 1.8e-2})
    for (const double young : {1e8, 24e9}) {
      const double vs = sticking_speed(gamma, young, mass);
      const Jkr jkr{gamma, {}, {}};
      EXPECT_EQ(leaving(jkr, young, 1.0, 0.98 * vs), 0.0) << gamma << " " << young;
      for (const double ratio : {1.1, 1.5, 2.0, 5.0}) {
        const double e = std::sqrt(1.0 - 1.0 / (ratio * ratio));
        EXPECT_NEAR(leaving(jkr, young, 1.0, ratio * vs) / (ratio * vs), e, 0.01 * (1.0 - e * e) / (2.0 * e))
            << gamma << " " << young << " " << ratio;
      }
    }
}

// DMT has no hysteresis: elastic impacts leave as fast as they came. The energy that comes in and goes out again is of
// the order F0 delta_0 (delta_0: overlap at rest); followed in steps of delta_0/20 it closes within 1e-3 of that.
TEST(Dmt, ElasticImpactsLoseNothing) {
  const double mass = lactose(0, {0, 0, 0}).mass, f0 = dmt_pull_off(3.6e-3, radius);
  const double well = f0 * hertz_overlap(1e8 / 0.91, radius, f0);
  for (const double speed : {2e-3, 1e-2, 1.0}) {
    const double out = leaving(Dmt{3.6e-3, 4e-10, {}, {}}, 1e8, 1.0, speed);
    EXPECT_NEAR(0.5 * mass * out * out, 0.5 * mass * speed * speed, 1e-3 * (well + 0.5 * mass * speed * speed))
        << speed;
  }
}

// At rest the Hertz force carries weight and adhesion: delta = (3 F/(4 E* sqrt(R)))^(2/3), F = F0 + load.
TEST(Dmt, RestsAtTheOverlapOfItsOwnPull) {
  Scene s = sticky_floor(Dmt{3.6e-3, 4e-10, {}, {}}, 1e8, 0.1);
  s.add(lactose(0, {0, 0, radius}));
  s.loads[0].force = {0, 0, -1e-7};
  s.run(400e-6, 1e-6);
  const double expected = hertz_overlap(1e8 / 0.91, radius, dmt_pull_off(3.6e-3, radius) + 1e-7);
  EXPECT_NEAR(radius - s.x(0).z(), expected, 1e-4 * expected);
}

// With a dashpot the restitution far above sticking is that of the dashpot: adhesion no longer matters.
TEST(Jkr, FastImpactsReturnTheRestitutionOfTheDashpot) {
  EXPECT_NEAR(leaving(Jkr{3.6e-3, {}, {}}, 1e8, 0.6, 5.0), 3.0, 0.03);
}

// Metres to micrometres: gamma (kg/s^2) stays, moduli are divided by 1e6.
TEST(Jkr, DoesNotDependOnTheUnitOfLength) {
  const JkrCurve metres(7.2e-3, radius, 1e9), micrometres(7.2e-3, radius * 1e6, 1e3);
  EXPECT_NEAR(micrometres.pull_off, metres.pull_off * 1e6, 1e-12 * micrometres.pull_off);
  EXPECT_NEAR(micrometres.stretch, metres.stretch * 1e6, 1e-12 * micrometres.stretch);
  EXPECT_NEAR(micrometres.contact_radius(3e6 * metres.stretch), 1e6 * metres.contact_radius(3.0 * metres.stretch),
              1e-9 * micrometres.radius);
}

TEST(Jkr, NeedsTheModuliOfAHertzContact) {
  Models m;
  m.wall.adhesion = Jkr{3.6e-3, {}, {}};
  EXPECT_THROW(check(m), std::invalid_argument);
  m.wall.contact = HertzContact{0.5, ConstantFriction{}, 0.0, {1e9, 0.3}, {1e9, 0.3}};
  EXPECT_NO_THROW(check(m));
  m.wall.adhesion = Jkr{0.0, {}, {}};
  EXPECT_THROW(check(m), std::invalid_argument);
}

// 20,000 draws: the mean of ln has the error sigma/sqrt(n) = 0.35 %, the deviation 1/sqrt(2 n) = 0.5 %; four of them.
TEST(Spread, FactorsAreLogNormalAndFollowFromTheId) {
  double sum = 0.0, square = 0.0;
  const int n = 20000;
  for (int id = 0; id < n; ++id) {
    const double z = std::log(adhesion_factor(7, id, 0.5)) / 0.5;
    sum += z, square += z * z;
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_EQ(adhesion_factor(7, 3, 0.5), adhesion_factor(7, 3, 0.5));
  EXPECT_NE(adhesion_factor(7, 3, 0.5), adhesion_factor(8, 3, 0.5));
  EXPECT_EQ(adhesion_factor(7, 3, 0.0), 1.0);
}

TEST(Spread, PullOffFollowsTheCarriersOwnFactor) {
  const Spread spread{0.5, 11};
  const double factor = adhesion_factor(11, 0, 0.5);
  ASSERT_GT(std::abs(factor - 1.0), 0.05);
  const double gamma = 3.6e-3 / factor;  // so that this carrier has the catalogue's force
  expect_pull_off(Jkr{gamma, {}, spread}, 1e8, 1.1875e-6);
}
