// Hertz-Mindlin contacts against the benchmarks of Chung & Ooi, Granular Matter 13, 643 (2011), and closed forms.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "dem/hertz.hpp"
#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

struct Material {
  double young, poisson, density, radius;
};
constexpr Material glass{48e9, 0.2, 2800, 0.01}, limestone{20e9, 0.25, 2500, 0.01};
constexpr Material magnesium{40e9, 0.35, 1800, 0.1}, alloy{70e9, 0.33, 2700, 0.1};
constexpr Material oxide{380e9, 0.23, 4000, 0.0025}, iron{100e9, 0.25, 7000, 0.0025};

Scene scene(const Material& m, double e, double mu, double wall_factor = 1000.0) {
  Scene s;
  HertzContact law;
  law.restitution = e;
  law.friction = ConstantFriction{mu};
  law.body = law.partner = {m.young, m.poisson};
  s.models.carrier.contact = law;
  law.partner.youngs_modulus *= wall_factor;  // Chung & Ooi: walls 1,000 times stiffer
  s.models.wall.contact = law;
  s.models.integration.sleep = false;
  return s;
}

/// Steps in the time of a hundredth of the contact until it is over.
void impact(Scene& s, double step, int most = 4000) {
  for (int i = 0; i < most && s.events.ended.empty(); ++i) s.step(step);
  ASSERT_EQ(s.events.ended.size(), 1u);
}

/// A ball on the floor: velocity after over speed before.
double restitution(const Material& m, double e, double speed, double length = 1.0) {
  Scene s = scene({m.young / length, m.poisson, m.density, m.radius}, e, 0.0);
  s.walls = PlaneWalls::floor();
  Carrier c = lactose(0, {0, 0, m.radius * 1.001 * length}, {0, 0, -speed * length}, m.radius * length);
  c.mass = lactose(0, {0, 0, 0}, {0, 0, 0}, m.radius, m.density).mass;
  s.add(c);
  impact(s, 1e-3 * m.radius / speed);
  return s.v(0).z() / (speed * length);
}

}  // namespace

// Catalogue D01, D02 (exact Hertz impacts). The peak is read to second order from the nearest sub-step and the scheme's
// energy error is second order in 1/34 of the contact: below 0.1 %.
TEST(Hertz, ImpactsReachTheExactForceAndOverlap) {
  for (const auto& [m, force, overlap] :
       {std::tuple{glass, 10696.889, 2.74113e-4}, {limestone, 7108.241, 3.68304e-4}}) {
    Scene s = scene(m, 1.0, 0.35);
    s.add(lactose(0, {0, 0, 0}, {10, 0, 0}, m.radius, m.density));
    s.add(lactose(1, {2.01 * m.radius, 0, 0}, {-10, 0, 0}, m.radius, m.density));
    impact(s, 1e-6);
    EXPECT_NEAR(s.events.ended[0].max_force, force, 1e-3 * force);
    EXPECT_NEAR(s.events.ended[0].max_overlap, overlap, 1e-3 * overlap);
    EXPECT_NEAR(s.v(0).x(), -10.0, 1e-3 * 10.0);
  }
  Scene s = scene(magnesium, 1.0, 0.0, 1e6);
  s.walls = PlaneWalls::floor();
  s.add(lactose(0, {0, 0, 0.1001}, {0, 0, -0.2}, magnesium.radius, magnesium.density));
  impact(s, 1e-5);
  EXPECT_NEAR(s.events.ended[0].max_force, 7232.681, 7.2);
  EXPECT_NEAR(s.events.ended[0].max_overlap, 5.21233e-5, 5.2e-8);
  const double time = 2.943 * 5.21233e-5 / 0.2;
  EXPECT_NEAR(s.events.ended[0].time_end - s.events.ended[0].time_start, time, 5e-3 * time);
}

// Catalogue D03: 1 %, also between the values of the polynomial and near 1 where it has no root.
TEST(Hertz, ReturnsTheRestitutionAskedFor) {
  for (const double e : {0.05, 0.2, 0.3, 0.5, 0.7, 0.85, 0.9, 0.93, 0.98, 0.995, 1.0}) {
    EXPECT_NEAR(restitution(oxide, e, 3.9), e, 0.01 * e);
    EXPECT_NEAR(restitution(iron, e, 3.9), e, 0.01 * e);
    EXPECT_NEAR(restitution(iron, e, 0.01), e, 0.01 * e);
  }
}

// Lengths in micrometres: speeds times 1e6, moduli (kg/(m s^2)) divided by it. Nothing in the law has a size.
TEST(Hertz, DoesNotDependOnTheUnitOfLength) {
  EXPECT_NEAR(restitution(iron, 0.6, 1.0, 1e6), restitution(iron, 0.6, 1.0), 1e-9);
}

// Catalogue D04: in full sliding e_t = 1 - mu (1+e) cot(theta), w = 5/2 mu (1+e) v_n/R. The normal impulse is right
// within the 0.2 % of e.
TEST(Hertz, SlidingImpactsLoseMuTimesTheNormalImpulse) {
  const double mu = 0.092, e = 0.98;
  for (const double degrees : {45.0, 60.0, 80.0}) {
    const double theta = degrees * std::numbers::pi / 180.0, vn = 3.9 * std::cos(theta), vt = 3.9 * std::sin(theta);
    Scene s = scene(oxide, e, mu);
    s.walls = PlaneWalls::floor();
    s.add(lactose(0, {0, 0, 0.0025 * 1.001}, {vt, 0, -vn}, oxide.radius, oxide.density));
    impact(s, 1e-6);
    EXPECT_NEAR(1.0 - s.v(0).x() / vt, mu * (1.0 + e) * vn / vt, 0.003 * mu * (1.0 + e) * vn / vt);
    EXPECT_NEAR(s.w(0).y(), 2.5 * mu * (1.0 + e) * vn / oxide.radius, 0.003 * s.w(0).y());
  }
}

// The same at small angles, where the contact sticks and lets go: digitised values of the paper (its accuracy: 1-2 %,
// and 0.01 of reading the figure).
TEST(Hertz, StickingImpactsFollowChungAndOoi) {
  const double points[][2] = {{10.158, 0.687}, {14.99, 0.6244}, {20.059, 0.6161}, {25.05, 0.6343}, {30.119, 0.6837}};
  for (const auto& [degrees, expected] : points) {
    const double theta = degrees * std::numbers::pi / 180.0;
    Scene s = scene(oxide, 0.98, 0.092);
    s.walls = PlaneWalls::floor();
    s.add(lactose(0, {0, 0, 0.0025 * 1.001}, {3.9 * std::sin(theta), 0, -3.9 * std::cos(theta)}, oxide.radius,
                  oxide.density));
    impact(s, 1e-6);
    EXPECT_NEAR(s.v(0).x() / (3.9 * std::sin(theta)), expected, 0.02 * expected + 0.01) << degrees;
  }
}

// Elastic energy of the tangential spring is never made: an oblique impact with stick and slip loses energy at e = 1,
// at every angle, ever more friction up to no slip at all. 1e-3: the scheme's own error.
TEST(Hertz, AnObliqueImpactMakesNoEnergy) {
  for (const double mu : {0.1, 0.5, 50.0})
    for (const double degrees : {5.0, 30.0, 60.0, 85.0}) {
      const double theta = degrees * std::numbers::pi / 180.0;
      Scene s = scene(alloy, 1.0, mu);
      s.walls = PlaneWalls::floor();
      s.add(
          lactose(0, {0, 0, 0.1001}, {0.2 * std::sin(theta), 0, -0.2 * std::cos(theta)}, alloy.radius, alloy.density));
      const double before = s.kinetic();
      impact(s, 1e-4);
      EXPECT_LE(s.kinetic(), before * 1.001) << mu << " " << degrees;
    }
}

// Catalogue D06, test 7: equal and opposite spins, the centres stay in place sideways.
TEST(Hertz, EqualAndOppositeSpinsCancel) {
  Scene s = scene(alloy, 0.5, 0.4);
  Carrier a = lactose(0, {0, 0, 0}, {0.2, 0, 0}, 0.1, 2700), b = lactose(1, {0.2001, 0, 0}, {-0.2, 0, 0}, 0.1, 2700);
  a.spin = {0, 0, 20};
  b.spin = {0, 0, -20};
  s.add(a), s.add(b);
  impact(s, 1e-4);
  EXPECT_NEAR(s.v(0).y() - s.v(1).y(), 0.0, 1e-12);
  EXPECT_NEAR((s.v(1) - s.v(0)).x(), 0.5 * 0.4, 0.01 * 0.2);
}

// A light sphere on one a million times heavier and stiffer meets a wall (D06, test 8 against test 6). Radius 5 R:
// R* is 5/6 of the wall's, so only what does not depend on R* is the same: the full-sliding result.
TEST(Hertz, AHeavySphereIsAWall) {
  Scene wall = scene(alloy, 0.5, 0.4), ball = scene(alloy, 0.5, 0.4);
  wall.walls = PlaneWalls::floor();
  Carrier c = lactose(0, {0, 0, 0.1001}, {0, 0, -0.2}, 0.1, 2700);
  c.spin = {0, 40, 0};  // R w / v_n = 20: slides throughout
  wall.add(c);
  ball.add(c);
  ball.add(lactose(1, {0, 0, -0.5}, {0, 0, 0}, 0.5, 2.7e9));
  impact(wall, 1e-4);
  impact(ball, 1e-4);
  EXPECT_NEAR(wall.w(0).y(), 40.0 - 2.5 * 0.4 * 1.5 * 0.2 / 0.1, 0.01 * 3.0);
  EXPECT_NEAR(ball.w(0).y(), wall.w(0).y(), 1e-2);
  EXPECT_NEAR(ball.v(0).x(), wall.v(0).x(), 1e-3 * std::abs(wall.v(0).x()));
}

// Two moduli: 1/E* is the sum of both compliances; equal bodies have E* = E/(2(1-nu^2)).
TEST(Hertz, PairModuliAddCompliances) {
  const PairModuli same = pair_moduli(10e9, 0.3, 10e9, 0.3), rigid = pair_moduli(10e9, 0.3, 1e19, 0.3);
  EXPECT_NEAR(same.normal, 10e9 / (2.0 * 0.91), 1.0);
  EXPECT_NEAR(rigid.normal, 10e9 / 0.91, 20.0);
  EXPECT_NEAR(same.shear, 10e9 / 2.6 / (2.0 * 1.7), 1.0);
}

TEST(Hertz, RayleighTimeOfALactoseCarrier) {  // facts 3.13: 4.8e-8 s at 24 GPa, R = 35 um
  EXPECT_NEAR(rayleigh_time(35e-6, lactose(0, {0, 0, 0}).mass, 24e9, 0.3), 4.8e-8, 0.05e-8);
}

TEST(Hertz, RotatingTheSceneRotatesTheAnswer) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Scene s = scene(oxide, 0.8, 0.1), t = s;
  s.walls = PlaneWalls::floor();
  t.walls = PlaneWalls({{Vector3d::Zero(), turn * Vector3d::UnitZ()}});
  Carrier c = lactose(0, {0, 0, 0.002503}, {1, 0.5, -2}, oxide.radius, oxide.density);
  c.spin = {100, -50, 30};
  s.add(c);
  c.position = turn * c.position, c.velocity = turn * c.velocity, c.spin = turn * c.spin;
  t.add(c);
  impact(s, 1e-6);
  impact(t, 1e-6);
  EXPECT_LT((turn * s.v(0) - t.v(0)).norm(), 1e-8);
  EXPECT_LT((turn * s.w(0) - t.w(0)).norm(), 1e-5);
}

TEST(Hertz, NonsenseIsRefused) {
  const auto refused = [](auto change) {
    Scene s = scene(glass, 0.5, 0.1);
    change(std::get<HertzContact>(s.models.carrier.contact));
    EXPECT_THROW(check(s.models), std::invalid_argument);
  };
  refused([](HertzContact& h) { h.body.youngs_modulus = 0.0; });
  refused([](HertzContact& h) { h.partner.poisson = 0.6; });
  refused([](HertzContact& h) { h.restitution = 0.0; });
  EXPECT_NO_THROW(check(scene(glass, 0.5, 0.1).models));
}
