// One impact: restitution, friction, conservation, events.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

/// Speed ratio of a head-on wall impact at `speed` with restitution e, in air steps of `step`.
double wall_restitution(double e, double speed, double step, double length = 1.0) {
  Scene s;
  s.law().restitution = e;
  s.same_walls();
  s.walls = PlaneWalls::floor();
  const double r = 35e-6 * length;
  Carrier c = lactose(1, {0, 0, 1.3 * r}, {0, 0, -speed * length}, r);
  c.mass = lactose(1, {0, 0, 0}).mass;
  s.add(c);
  s.run(400 * step, step);
  return s.v(0).z() / (speed * length);
}

/// A single point, as the tip of a needle: what an edge or a corner is to a sphere.
class Needle : public Walls {
 public:
  RestOfWall near(const Vector3d& centre, double reach, std::vector<WallTouch>& touches) const override {
    touches.clear();
    if (centre.norm() <= reach) touches.push_back({Vector3d::Zero(), centre.norm(), 0});
    return {};
  }
  double clearance(const Vector3d& centre, double limit) const override { return std::min(limit, centre.norm()); }
  bool inside(const Vector3d&) const override { return false; }
};

}  // namespace

// A carrier hits a corner 0.6 R beside its middle, from ten heights: the direction of the contact is that from the
// corner to the centre at the touch, n = (0.6, 0, 0.8). The place of a corner is held for 0.001 R of travel, in which n
// turns by 0.6 x 0.001 and the speed along it changes by 0.6 of that; 0.01 R, as for faces, gave 0.8020 from some
// heights.
TEST(Impact, OnACornerGoesByTheLineToTheCentre) {
  const double r = 35e-6;
  for (int n = 0; n < 10; ++n) {
    Scene s;
    s.law().restitution = 1.0;
    s.law().friction = ConstantFriction{0.0};
    s.law().stiffness = 2e4;
    s.same_walls();
    s.add(lactose(1, {0.6 * r, 0, (3.0 + 0.0037 * n) * r}, {0, 0, -1.0}));
    Needle needle;
    double normal_speed = 0.0;
    for (int step = 0; step < 100; ++step) {
      advance(1e-6, s.models, needle, s.loads, s.state, s.events);
      if (!s.events.begun.empty()) normal_speed = s.events.begun[0].normal_speed;
    }
    EXPECT_NEAR(normal_speed, 0.8, 5e-4) << n;
    // The contact lasts 0.37 us, in which the carrier passes the corner by 0.6 m/s and n turns by 0.0063, in the mean
    // by half of that: e = 1 makes (0.96, 0, 0.28) of (0, 0, -1) within 2 x 0.8 m/s x 0.0032.
    EXPECT_NEAR(s.v(0).x(), 0.96, 0.006) << n;
    EXPECT_NEAR(s.v(0).z(), 0.28, 0.006) << n;
  }
}

// Catalogue D03: restitution returned = restitution asked. The sub-step is t_c/20, so the phase advances by pi/20 a
// step; the scheme is second order: error ~ (pi/20)^2/12 = 0.2 % of e; the catalogue allows 0.5 %.
TEST(Impact, WallReturnsTheRestitutionAskedFor) {
  for (const double e : {0.2, 0.4, 0.6, 0.8, 0.9, 1.0})
    for (const double speed : {0.05, 1.0, 20.0})
      EXPECT_NEAR(wall_restitution(e, speed, 1e-6), e, 0.005 * e) << "e " << e << " speed " << speed;
}

// The same bounce in micrometres: lengths and speeds times 1e6, masses equal. No hidden length or speed in the law.
TEST(Impact, DoesNotDependOnTheUnitOfLength) {
  EXPECT_NEAR(wall_restitution(0.6, 1.0, 1e-6, 1e6), wall_restitution(0.6, 1.0, 1e-6), 1e-9);
}

TEST(Impact, PairReturnsTheRestitutionAskedFor) {
  for (const double e : {0.2, 0.6, 1.0}) {
    Scene s;
    s.law().restitution = e;
    s.add(lactose(1, {0, 0, 0}, {1, 0, 0}));
    s.add(lactose(2, {80e-6, 0, 0}, {-2, 0, 0}, 45e-6 / 2));
    s.run(60e-6, 1e-6);
    EXPECT_NEAR((s.v(1) - s.v(0)).x(), 3.0 * e, 0.005 * 3.0 * e);
  }
}

// Without friction and damping the impulse is m v_n along the line of centres at touch, at any angle. A spring turns
// that line while it acts: glancing_overlap() gives 0.96 and more of the impulse up to b = 0.96 d; with 2 % of overlap
// it was 0.87, 0.74 at these two.
TEST(Impact, GlancingPairsPartAsHardSpheres) {
  for (const double b : {0.5, 0.9, 0.95}) {
    Scene s;
    s.law().restitution = 1.0;
    s.law().friction = ConstantFriction{0.0};
    s.add(lactose(1, {0, 0, 0}, {1, 0, 0}));
    s.add(lactose(2, {100e-6, b * 70e-6, 0}, {0, 0, 0}));
    s.run(120e-6, 1e-6);
    const double along = std::sqrt(1.0 - b * b);  // v_n; the struck one gets it along (sqrt(1 - b^2), b)
    EXPECT_NEAR(s.v(1).norm() / along, 1.0, 0.04) << b;
    EXPECT_NEAR(s.v(0).squaredNorm() + s.v(1).squaredNorm(), 1.0, 0.003) << b;  // (pi/20)^2/12
    EXPECT_EQ(s.events.ended.size(), 1u) << b;
  }
}

// What is pressed beyond the allowed overlap meets a second spring, whose dashpot goes by tangent and secant: a given
// stiffness of 100 N/m, struck at 10 m/s, is pressed to 0.15 d, half as much again as its knee. No formula gives what
// returns, as its shape is no power of the overlap: 8 % lies between 0.56 and the 0.52 of the tangent alone.
TEST(Impact, ASpringBeyondItsKneeReturnsTheRestitutionToo) {
  Scene s;
  s.law().restitution = 0.6;
  s.law().friction = ConstantFriction{0.0};
  s.law().stiffness = 100.0;
  s.same_walls();
  s.walls = PlaneWalls::box(1e-3);
  s.add(lactose(1, {5e-4, 5e-4, 60e-6}, {0, 0, -10}));
  s.run(60e-6, 1e-7);
  ASSERT_EQ(s.events.ended.size(), 1u);
  EXPECT_GT(s.events.ended[0].max_overlap, 0.12 * 70e-6);
  EXPECT_NEAR(s.v(0).z() / 10.0, 0.6, 0.048);
}

// The automatic stiffness keeps the overlap within 2 % of the diameter at any speed. 2.5 % safety is built in.
TEST(Impact, OverlapStaysWithinWhatIsAllowed) {
  for (const double speed : {0.01, 1.0, 40.0}) {
    Scene s;
    s.walls = PlaneWalls::floor();
    s.law().restitution = 0.6;
    s.same_walls();
    s.add(lactose(1, {0, 0, 40e-6}, {0, 0, -speed}));
    s.run(100e-6 * std::max(1.0, 20.0 / speed), 2e-6);
    EXPECT_LE(s.state.statistics.largest_overlap, 0.02);
    EXPECT_GE(s.state.statistics.largest_overlap, 0.018);
  }
}

// Momentum and angular momentum of an oblique collision of unequal spinning spheres. The forces are equal and opposite
// at one common point, so both hold to rounding: 1e-12 of the sums of absolute values.
TEST(Impact, PairCollisionKeepsMomentumAndAngularMomentum) {
  Scene s;
  s.law().friction = ConstantFriction{0.4};
  Carrier a = lactose(1, {0, 0, 0}, {2, 0.3, 0});
  a.spin = {1e4, -2e4, 3e4};
  s.add(a);
  s.add(lactose(2, {90e-6, 30e-6, 10e-6}, {-1, 0, 0.2}, 50e-6));
  const auto momentum = [&] {
    Vector3d p = Vector3d::Zero();
    for (std::size_t i = 0; i < 2; ++i) p += s.state.carriers.mass[i] * s.v(i);
    return p;
  };
  const auto angular = [&] {
    Vector3d l = Vector3d::Zero();
    for (std::size_t i = 0; i < 2; ++i) {
      const double m = s.state.carriers.mass[i], r = s.state.carriers.radius[i];
      l += m * s.x(i).cross(s.v(i)) + 0.4 * m * r * r * s.w(i);
    }
    return l;
  };
  const Vector3d p0 = momentum(), l0 = angular();
  const double scale_p = s.state.carriers.mass[1] * 2.0, scale_l = scale_p * 100e-6;
  s.run(60e-6, 1e-6);
  ASSERT_EQ(s.events.ended.size(), 1u);
  EXPECT_GT((s.w(1)).norm(), 1e3);  // friction did act
  EXPECT_LT((momentum() - p0).norm(), 1e-12 * scale_p);
  EXPECT_LT((angular() - l0).norm(), 1e-11 * scale_l);
}

// Catalogue D04: a sliding impact at the angle theta from the normal returns e_t = 1 - mu (1+e) cot(theta') with theta'
// from the normal, i.e. v_t' = v_t - mu (1+e) v_n. The normal impulse has the error of e (0.5 %), friction follows it.
TEST(Impact, SlidingImpactLosesMuTimesTheNormalImpulse) {
  const double mu = 0.092, e = 0.98;
  for (const double degrees : {45.0, 60.0}) {
    const double theta = degrees * std::numbers::pi / 180.0;
    Scene s;
    s.law().restitution = e;
    s.law().friction = ConstantFriction{mu};
    s.same_walls();
    s.walls = PlaneWalls::floor();
    s.add(lactose(1, {0, 0, 40e-6}, {3.9 * std::sin(theta), 0, -3.9 * std::cos(theta)}));
    s.run(30e-6, 1e-6);
    const double expected = 1.0 - mu * (1.0 + e) / std::tan(theta);
    EXPECT_NEAR(s.v(0).x() / (3.9 * std::sin(theta)), expected, 0.005 * mu * (1.0 + e));
    EXPECT_NEAR(expected, degrees == 45.0 ? 0.81784 : 0.89483, 1e-5);
    // It turns by the torque of the whole radius: w = 5 mu (1+e) v_n/(2 r), though the spring lets it sink in by 2 %.
    const double turn = 2.5 * mu * (1.0 + e) * 3.9 * std::cos(theta) / 35e-6;
    EXPECT_NEAR(s.w(0).y(), turn, 0.005 * turn);
  }
}

// The impulse of the spring alone is the whole normal impulse, so the same holds with strong damping.
TEST(Impact, SlidingImpactHoldsWithStrongDampingToo) {
  Scene s;
  s.law().restitution = 0.4;
  s.law().friction = ConstantFriction{0.1};
  s.models.rotation = false;
  s.same_walls();
  s.walls = PlaneWalls::floor();
  s.add(lactose(1, {0, 0, 40e-6}, {2.0, 0, -1.0}));
  s.run(40e-6, 1e-6);
  EXPECT_NEAR(s.v(0).x(), 2.0 - 0.1 * 1.4, 0.01 * 0.1 * 1.4);
  EXPECT_EQ(s.w(0).norm(), 0.0);
}

// Equal and opposite spins (catalogue D06, test 7): by symmetry the centres stay in place tangentially.
TEST(Impact, EqualAndOppositeSpinsCancel) {
  Scene s;
  Carrier a = lactose(1, {0, 0, 0}, {1, 0, 0}), b = lactose(2, {80e-6, 0, 0}, {-1, 0, 0});
  a.spin = {0, 0, 3e4};
  b.spin = {0, 0, -3e4};
  s.add(a);
  s.add(b);
  s.run(30e-6, 1e-6);
  ASSERT_EQ(s.events.ended.size(), 1u);
  EXPECT_NEAR(s.v(0).y() - s.v(1).y(), 0.0, 1e-12);
}

TEST(Impact, EachContactIsReportedOnceWithItsSpeedsAndEnergy) {
  Scene s;
  s.walls = PlaneWalls::floor();
  Carrier c = lactose(7, {0, 0, 100e-6}, {0.5, 0, -1.0}, 75.4e-6);
  c.carriers = 10.0;
  c.single_radius = 35e-6;
  s.add(c);
  s.run(200e-6, 1e-6);
  ASSERT_EQ(s.events.begun.size(), 1u);
  ASSERT_EQ(s.events.ended.size(), 1u);
  const ContactBegun& begun = s.events.begun[0];
  const ContactEnded& ended = s.events.ended[0];
  EXPECT_EQ(begun.a, 7);
  EXPECT_EQ(begun.b, -1);
  EXPECT_EQ(begun.triangle, 0);
  EXPECT_NEAR(begun.time, (100e-6 - 75.4e-6) / 1.0, 1e-12);
  EXPECT_NEAR(begun.normal_speed, 1.0, 1e-9);
  EXPECT_NEAR(begun.tangential_speed, 0.5, 1e-9);
  EXPECT_NEAR(begun.angle, std::atan(0.5), 1e-9);
  EXPECT_NEAR((begun.normal - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(ended.energy, 0.5 * c.mass / 10.0, 1e-9 * c.mass);  // of one carrier, wall-normal speed
  EXPECT_DOUBLE_EQ(ended.time_start, begun.time);
  // contact time and largest force of the spring: overlap ~ 0.0195 d, F = k overlap up to the dashpot's few per cent
  EXPECT_GT(ended.max_overlap, 0.018 * 2 * 75.4e-6);
  EXPECT_GT(ended.max_force * ended.max_overlap, 0.6 * c.mass);
}

// Rotating the scene rotates the answer: directions enter only through vectors, so it holds to rounding, which an
// impact's 40 sub-steps amplify little: 1e-9.
TEST(Impact, RotatingTheSceneRotatesTheAnswer) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Scene s, t;
  s.walls = PlaneWalls::floor();
  t.walls = PlaneWalls({{Vector3d::Zero(), turn * Vector3d::UnitZ()}});
  s.models.gravity = {1.0, 0, -9.81};
  t.models.gravity = turn * s.models.gravity;
  const std::vector<Carrier> carriers = {lactose(1, {0, 0, 40e-6}, {0.4, 0.2, -1}),
                                         lactose(2, {60e-6, 45e-6, 60e-6}, {-0.4, -0.5, -1})};
  for (Carrier c : carriers) {
    s.add(c);
    c.position = turn * c.position;
    c.velocity = turn * c.velocity;
    t.add(c);
  }
  s.run(100e-6, 1e-6);
  t.run(100e-6, 1e-6);
  EXPECT_GE(s.events.ended.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((turn * s.v(i) - t.v(i)).norm(), 1e-9);
}

TEST(Impact, StickingWallsHoldWhatTouchesThem) {
  Scene s;
  s.walls = PlaneWalls::floor();
  s.models.on_wall = OnWall::stick;
  s.add(lactose(1, {0, 0, 40e-6}, {1.0, 0, -1.0}));
  s.run(20e-6, 1e-6);
  EXPECT_EQ(s.state.carriers.rest[0], Rest::stuck);
  EXPECT_NEAR(s.x(0).z(), 35e-6, 1e-12);
  EXPECT_EQ(s.events.begun.size(), 1u);
}

TEST(Impact, StickingWallsHoldAgainstWeight) {
  for (const double g : {-9.81, 9.81}) {
    Scene s;
    s.walls = PlaneWalls::floor();
    s.models.on_wall = OnWall::stick;
    s.models.gravity = {1.0, 0, g};
    s.add(lactose(1, {0, 0, 40e-6}, {1.0, 0, -1.0}));
    s.run(20e-6, 7e-6);  // one step reaches beyond the touch, after 5 us
    EXPECT_EQ(s.state.carriers.rest[0], Rest::stuck);
    EXPECT_NEAR(s.x(0).z(), 35e-6, 1e-12);
    EXPECT_EQ(s.events.begun.size(), 1u);
    EXPECT_EQ(s.v(0).norm(), 0.0);
  }
}
