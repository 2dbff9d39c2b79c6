// Free flight in closed form is a speed switch: contact steps end where it does.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

/// The scene with and without the closed form after `time`.
struct Both {
  Scene closed, stepped;
  Both(Scene scene, double time, double duration) : closed(scene), stepped(std::move(scene)) {
    stepped.models.integration.free_flight = false;
    closed.run(time, duration);
    stepped.run(time, duration);
  }
};

}  // namespace

// Nothing touches, so the closed form is exact and its difference is the sub-steps' error: second order, (h/tau)^2 of
// the way that drag makes, for sub-steps h. At 10 mm/s they are a thousandth of tau long.
TEST(FreeFlight, ContactStepsEndWhereTheClosedFormDoes) {
  Scene s;
  s.models.gravity = {0, 0, -9.81};
  s.add(lactose(1, {0, 0, 0}, {1e-2, 0, 0}));
  const double tau = 2.3e-2, time = 1e-2;
  s.loads[0].air_velocity = {0, 2e-2, 0};
  s.loads[0].drag = s.state.carriers.mass[0] / tau;
  const Both both(s, time, 1e-3);
  const auto& steps = both.stepped.state.statistics;
  EXPECT_EQ(both.closed.state.statistics.contact_steps, 0);
  EXPECT_EQ(both.closed.state.statistics.free_flights, 10);
  EXPECT_EQ(steps.free_flights, 0);
  // The impact that it would have at v uses 2 % of the diameter: sub-steps of t_c/20 = pi/20 allowed/v, less the
  // dashpot's part of the peak (0.87 at e = 0.6) and the 5 % of stiffness that are kept in hand; it speeds up to 0.1
  // m/s.
  const double fastest = both.closed.v(0).norm(), allowed = 0.02 * 70e-6;
  const double h = M_PI / 20.0 * allowed / 1e-2;
  EXPECT_GT(static_cast<double>(steps.contact_steps), time / h);
  EXPECT_LT(static_cast<double>(steps.contact_steps), 2.0 * time / (h * 1e-2 / fastest));
  const double bound = (h / tau) * (h / tau);
  EXPECT_LE((both.stepped.v(0) - both.closed.v(0)).norm(), bound * fastest);
  EXPECT_LE((both.stepped.x(0) - both.closed.x(0)).norm(), bound * fastest * time);
  EXPECT_GT((both.stepped.x(0) - both.closed.x(0)).norm(), 0.0) << "it was not stepped";
}

// The impulse of drag closes the momentum balance in sub-steps too.
TEST(FreeFlight, ContactStepsKeepTheMomentumBalance) {
  Scene s;
  s.add(lactose(1, {0, 0, 0}, {1, 0, 0}));
  s.loads[0].air_velocity = {0, 5, 1};
  s.loads[0].drag = 1e-7;
  s.models.integration.free_flight = false;
  const double m = s.state.carriers.mass[0];
  s.step(1e-5);
  EXPECT_LT((m * (s.v(0) - Vector3d(1, 0, 0)) - s.state.drag_impulse[0]).norm(), 1e-12 * m);
}

// A carrier thrown at a floor, and two that meet in flight. What sub-steps lead into a contact may begin it up to half
// a sub-step late, which the contact takes back; a contact returns its speed within 0.1 % (linear_contact.hpp), so two
// runs differ by no more than 0.2 % of it, and after the time t by that times t.
TEST(FreeFlight, ImpactsOutOfItAreTheSame) {
  Scene s;
  s.models.gravity = {0, 0, -9.81};
  s.same_walls();
  s.walls = PlaneWalls::floor();
  s.add(lactose(1, {0, 0, 200e-6}, {0.5, 0, -1}));
  s.add(lactose(2, {1e-3, 0, 1e-3}, {1, 0, 0}));
  s.add(lactose(3, {1.5e-3, 20e-6, 1e-3}, {-1, 0, 0}));
  const double time = 1e-3;
  const Both both(s, time, 1e-4);
  ASSERT_EQ(both.closed.events.ended.size(), 2U);
  ASSERT_EQ(both.stepped.events.ended.size(), 2U);
  EXPECT_GT(both.closed.v(0).z(), 0.5) << "it bounced";
  EXPECT_GT(both.closed.v(2).x(), 0.0) << "it was hit";
  EXPECT_EQ(both.stepped.state.statistics.free_flights, 0);
  EXPECT_GT(both.stepped.state.statistics.contact_steps, 4 * both.closed.state.statistics.contact_steps);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((both.stepped.v(i) - both.closed.v(i)).norm(), 2e-3 * 1.2) << i;
    EXPECT_LT((both.stepped.x(i) - both.closed.x(i)).norm(), 2e-3 * 1.2 * time) << i;
  }
}
