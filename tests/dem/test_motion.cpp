// Flight, bouncing, rolling: exact solutions of mechanics.

#include <gtest/gtest.h>

#include <cmath>

#include "dem/failure.hpp"
#include "dem/free_flight.hpp"
#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

// Catalogue P01: v = u (1 - exp(-t/tau)), x = u (t - tau (1 - exp(-t/tau))). Closed form: rounding of 1000 steps,
// 1e-12.
TEST(Motion, StokesRelaxationIsExact) {
  Scene s;
  s.add(lactose(1, {0, 0, 0}));
  const double tau = 2.3e-2, u = 10.0;
  s.loads[0].air_velocity = {u, 0, 0};
  s.loads[0].drag = s.state.carriers.mass[0] / tau;
  Vector3d impulse = Vector3d::Zero();
  for (int i = 0; i < 1000; ++i) {
    s.step(2e-5);
    impulse += s.state.drag_impulse[0];
  }
  const double t = 1000 * 2e-5, grown = 1.0 - std::exp(-t / tau);
  EXPECT_NEAR(s.v(0).x(), u * grown, 1e-12 * u);
  EXPECT_NEAR(s.x(0).x(), u * (t - tau * grown), 1e-12 * u * t);
  // the impulse of drag is just the momentum gained
  EXPECT_NEAR(impulse.x(), s.state.carriers.mass[0] * s.v(0).x(), 1e-12 * s.state.carriers.mass[0] * u);
}

// The series for t << tau and the exponential meet: both sides of s = 1e-2 agree with long double to 1e-14.
TEST(Motion, FlightIsSmoothAcrossItsSeries) {
  for (const double s : {1e-12, 1e-4, 0.0099, 0.0101, 1.0, 40.0}) {
    Load load;
    load.drag = s;  // m = 1, t = 1
    load.air_velocity = {1, 0, 0};
    const Flight f =
        free_flight(Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), 1.0, 1.0, load, Vector3d::Zero(), 1.0);
    const long double e = -std::expm1(-static_cast<long double>(s));
    EXPECT_NEAR(f.velocity.x(), static_cast<double>(e), 1e-14 * static_cast<double>(e));
    const double x = s > 1e-3 ? static_cast<double>(1.0L - e / s) : 0.5 * s - s * s / 6.0 + s * s * s / 24.0;
    EXPECT_NEAR(f.position.x(), x, 1e-13 * std::max(x, s));
  }
}

// In a cluster the impulse of drag is what the carrier's momentum balance says: m dv = drag + contact + weight.
TEST(Motion, DragImpulseClosesTheMomentumBalanceInContact) {
  Scene s;
  s.add(lactose(1, {0, 0, 0}, {1, 0, 0}));
  s.add(lactose(2, {75e-6, 10e-6, 0}, {-1, 0, 0}));
  for (Load& load : s.loads) load.drag = 1e-7, load.air_velocity = {0, 5, 1};
  const double m = s.state.carriers.mass[0];
  const Vector3d before = m * (s.v(0) + s.v(1));
  Vector3d impulse = Vector3d::Zero();
  for (int i = 0; i < 20; ++i) {
    s.step(1e-6);
    impulse += s.state.drag_impulse[0] + s.state.drag_impulse[1];
  }
  ASSERT_EQ(s.events.ended.size(), 1u);
  EXPECT_LT((m * (s.v(0) + s.v(1)) - before - impulse).norm(), 1e-12 * m);
}

// Catalogue D07, hard-sphere limit: h_n = e^(2n) h0. e is right within 0.1 %, the contact lasts 1e-4 of a flight.
TEST(Motion, BouncingBallLosesHeightByTheSquareOfRestitution) {
  Scene s;
  s.models.gravity = {0, 0, -9.81};
  s.law().restitution = 0.9;
  s.same_walls();
  s.walls = PlaneWalls::floor();
  const double r = 0.01, h0 = 0.5;
  Carrier c = lactose(1, {0, 0, r + h0}, {0, 0, 0}, r);
  s.add(c);
  double top = 0.0, expected = h0;
  int bounce = 0;
  for (double before = 0.0; bounce < 8;) {
    s.step(1e-3);
    const double height = s.x(0).z() - r, rising = s.v(0).z();
    if (before > 0.0 && rising <= 0.0) {
      top = height + rising * rising / (2 * 9.81);
      expected *= 0.81;
      ++bounce;
      EXPECT_NEAR(top, expected, 0.003 * bounce * expected) << bounce;
    }
    before = rising;
  }
}

// ... and comes to rest after sqrt(2 h0/g) (1+e)/(1-e) = 6.066 s. The sum over the bounces has the error of e in
// 1/(1-e): 0.1 %/(1-e) = 1 %.
TEST(Motion, BouncingBallComesToRestInTime) {
  Scene s;
  s.models.gravity = {0, 0, -9.81};
  s.law().restitution = 0.9;
  s.law().max_overlap = 0.002;
  s.models.integration.sleep = false;
  s.same_walls();
  s.walls = PlaneWalls::floor();
  const double r = 0.01;
  s.add(lactose(1, {0, 0, r + 0.5}, {0, 0, 0}, r));
  double rest = 0.0;
  while (s.state.time < 7.0) {
    s.step(1e-3);
    if (s.x(0).z() - r > 1e-4) rest = s.state.time;
  }
  // the last bounces, below 0.1 mm, would take sqrt(8 h/g)/(1-e) = 90 ms more
  EXPECT_NEAR(rest + 0.09, 6.066, 0.06);
}

// Catalogue D08: sliding sphere on a plane: rolls after t = 2 v0/(7 mu g) at 5/7 v0, x = 12 v0^2/(49 mu g).
TEST(Motion, SlidingSphereRollsAtFiveSevenths) {
  Scene s;
  s.models.gravity = {0, 0, -9.81};
  s.law().friction = ConstantFriction{0.2};
  s.same_walls();
  s.walls = PlaneWalls::floor();
  const double r = 0.01, m = lactose(1, {0, 0, 0}, {0, 0, 0}, r).mass;
  const double k = 10.0 * m * 9.81 / (0.02 * 2 * r);  // the automatic stiffness at rest
  s.add(lactose(1, {0, 0, r - m * 9.81 / k}, {1.0, 0, 0}, r));
  s.models.integration.sleep = false;
  // let the contact take up its weight without sliding: start pressed to equilibrium is an offset, so drop it instead
  s.state.carriers.position[0].z() = r;
  double rolling = 0.0;
  for (int i = 0; i < 3000; ++i) {
    s.step(1e-4);
    if (rolling == 0.0 && std::abs(s.v(0).x() - s.w(0).y() * r) < 1e-3) rolling = s.state.time;
  }
  EXPECT_NEAR(s.v(0).x(), 5.0 / 7.0, 0.005);
  EXPECT_NEAR(s.w(0).y() * r, 5.0 / 7.0, 0.005);
  EXPECT_NEAR(rolling, 0.145624, 0.01 * 0.145624 + 2e-3);
}

// Catalogue D09: rolls without slip while tan(theta) < 3.5 mu, a = 5/7 g sin(theta).
TEST(Motion, SphereRollsDownAnInclineAtFiveSevenths) {
  Scene s;
  const double theta = 0.3, r = 0.01;
  s.models.gravity = 9.81 * Vector3d(std::sin(theta), 0, -std::cos(theta));
  s.law().friction = ConstantFriction{0.3};
  s.same_walls();
  s.walls = PlaneWalls::floor();
  s.add(lactose(1, {0, 0, r}, {0, 0, 0}, r));
  s.run(0.5, 1e-4);
  EXPECT_NEAR(s.v(0).x(), 5.0 / 7.0 * 9.81 * std::sin(theta) * 0.5, 0.01 * 1.035);
}

// Rolling resistance: on a plane a rolling sphere stops after v^2/(2 a), a = 5/7 mu_r g (moment mu_r R m g, rolling).
TEST(Motion, RollingResistanceStopsARollingSphere) {
  Scene s;
  s.models.gravity = {0, 0, -9.81};
  s.law().rolling_friction = 0.05;
  s.law().friction = ConstantFriction{0.5};
  s.same_walls();
  s.walls = PlaneWalls::floor();
  const double r = 0.01, v = 0.2;
  Carrier c = lactose(1, {0, 0, r}, {v, 0, 0}, r);
  c.spin = {0, v / r, 0};
  s.add(c);
  s.run(1.5, 2e-4);
  EXPECT_NEAR(s.x(0).x(), v * v / (2.0 * 5.0 / 7.0 * 0.05 * 9.81), 0.03 * 0.0571);
  EXPECT_LT(s.v(0).norm(), 1e-4);
}

// A carrier that stays on the floor, glued and 1 kN/m stiff: m = 2.7e-10 kg makes t_c = 1.6 us, so a step of 0.5 s is
// 6 million sub-steps. It is asked after each million, and given up at once; the carriers are where they were. A step
// of 1 ms asks nothing.
TEST(Motion, AStepThatTakesLongIsGivenUpWhenAskedTo) {
  Scene s;
  s.walls = PlaneWalls::floor();
  LinearContact stiff;
  stiff.stiffness = 1e3;
  s.models.wall = {stiff, Hamaker{3.6e-3}};
  s.models.integration.sleep = false;
  s.add(lactose(1, {0, 0, 35e-6 + 1e-9}, {0, 0, -1e-3}));
  s.step(1e-3);
  const Vector3d before = s.x(0);
  int asked = 0;
  s.models.asked_to_stop = [&] { return ++asked == 3; };
  s.step(1e-3);
  EXPECT_EQ(asked, 0);
  const Vector3d here = s.x(0);
  EXPECT_THROW(s.step(0.5), Interrupted);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(s.x(0), here);
  EXPECT_NEAR(here.z(), before.z(), 1e-9);
}
