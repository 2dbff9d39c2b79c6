// Many carriers: energy, threads, removal.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

/// `count` carriers with random places and speeds in a box of the given edge, none overlapping.
Scene gas(int count, double edge, double speed, double e, bool adhesion, unsigned seed) {
  Scene s;
  s.law().restitution = e;
  if (adhesion) s.models.carrier.adhesion = Hamaker{3.6e-3, 0.0, 4e-10, ParcelScaling::ddpm};
  s.same_walls();
  s.walls = PlaneWalls::box(edge);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  std::vector<Vector3d> places;
  while (static_cast<int>(places.size()) < count) {
    const Vector3d x = Vector3d::Constant(40e-6) + (edge - 80e-6) * Vector3d(uniform(), uniform(), uniform());
    bool room = true;
    for (const Vector3d& y : places) room = room && (x - y).norm() > 71e-6;
    if (!room) continue;
    places.push_back(x);
    const Vector3d v = speed * (2.0 * Vector3d(uniform(), uniform(), uniform()) - Vector3d::Ones());
    s.add(lactose(static_cast<int>(places.size()), x, v));
  }
  return s;
}

/// No contact is in its impact: a bond holds no energy above that of separate carriers.
bool quiet(const Scene& s) {
  return std::all_of(s.state.contacts.begin(), s.state.contacts.end(),
                     [](const Contact& c) { return c.phase == ContactPhase::free || c.phase == ContactPhase::bonded; });
}

}  // namespace

// Undamped and frictionless: energy is kept, looked at when no spring holds any. Each impact's error is second order,
// (pi/20)^2/24 = 0.1 %, of either sign; some 20 impacts a carrier average to far less: 0.5 %.
TEST(Ensemble, ElasticGasKeepsItsEnergy) {
  Scene s = gas(100, 1e-3, 2.0, 1.0, false, 1);
  s.law().friction = ConstantFriction{0.0};
  s.same_walls();
  const double before = s.kinetic();
  s.run(2e-3, 2e-6);
  EXPECT_GT(s.events.ended.size(), 500u);
  for (int i = 0; i < 1000 && !quiet(s); ++i) s.step(2e-6);
  ASSERT_TRUE(quiet(s));
  EXPECT_NEAR(s.kinetic(), before, 0.005 * before);
}

// With damping, friction and adhesion the energy outside contacts never grows. Rounding and the second-order error of
// one impact: 1e-3.
TEST(Ensemble, EnergyNeverGrowsWithDampingFrictionAndAdhesion) {
  Scene s = gas(100, 1e-3, 1.0, 0.9, true, 2);
  double last = s.kinetic();
  const double start = last;
  int looks = 0;
  for (int i = 0; i < 3000; ++i) {
    s.step(2e-6);
    if (!quiet(s)) continue;
    ++looks;
    EXPECT_LE(s.kinetic(), last + 1e-4 * start);
    last = std::min(last, s.kinetic());
  }
  EXPECT_GT(looks, 100);
  EXPECT_LT(last, 0.5 * start);
}

TEST(Ensemble, OneAndTwoThreadsGiveTheSameBits) {
  std::vector<Vector3d> places[2];
  std::vector<double> times[2];
  for (const int threads : {1, 2}) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Scene s = gas(300, 0.8e-3, 3.0, 0.7, true, 3);
    s.models.gravity = {0, 0, -9.81};
    s.run(1e-3, 2e-6);
    places[threads - 1] = s.state.carriers.position;
    for (const ContactEnded& e : s.events.ended) times[threads - 1].push_back(e.time_end);
  }
  EXPECT_EQ(places[0], places[1]);
  EXPECT_EQ(times[0], times[1]);
  EXPECT_GT(times[0].size(), 500u);
}

// The clusters of an air step are only a way to save time: with a tenth of the step the carriers go the same way until
// chaos sets in. Ten impacts multiply differences by ~10 each (free path over radius); within the first impacts the
// error of e and of the contact's end, 1e-3, dominates: compared after a few impacts, 2 % of the travel.
TEST(Ensemble, TheAirStepDoesNotMatter) {
  Scene a = gas(60, 0.6e-3, 2.0, 0.8, false, 4), b = gas(60, 0.6e-3, 2.0, 0.8, false, 4);
  a.run(50e-6, 10e-6);
  b.run(50e-6, 0.5e-6);
  EXPECT_GT(a.events.ended.size(), 30u);
  EXPECT_EQ(a.events.ended.size(), b.events.ended.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < 60; ++i) mean += (a.x(i) - b.x(i)).norm() / 60.0;
  EXPECT_LT(mean, 0.02 * 100e-6);
}

// Removing carriers in the middle changes nothing for the others: same places as in a scene that never had them.
TEST(Ensemble, RemovalKeepsOrderAndContactsOfTheOthers) {
  Scene s;
  s.models.carrier.adhesion = Hamaker{3.6e-3, 0.0, 4e-10, ParcelScaling::ddpm};
  for (int i = 0; i < 6; ++i) {
    s.add(lactose(i, {i * 300e-6, 0, 0}, {1e-4, 0, 0}));
    s.add(lactose(10 + i, {i * 300e-6 + 70.001e-6, 0, 0}, {-1e-4, 0, 0}));
  }
  s.run(100e-6, 1e-6);  // six bonded pairs
  ASSERT_EQ(s.events.begun.size(), 6u);
  std::vector<std::uint8_t> gone(12, 0);
  gone[0] = gone[5] = gone[10] = gone[11] = 1;
  remove(gone, s.state);
  s.loads.resize(s.state.carriers.size());
  ASSERT_EQ(s.state.carriers.size(), 8u);
  EXPECT_EQ(s.state.carriers.id[0], 10);
  EXPECT_EQ(s.state.carriers.id[7], 14);
  s.run(100e-6, 1e-6);
  EXPECT_EQ(s.events.begun.size(), 6u);  // no bond was lost or made anew
  EXPECT_EQ(s.events.ended.size(), 0u);
}
