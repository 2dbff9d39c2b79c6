// Sub-steps of its own for each contact: saves looks, and changes the answer within a stated bound.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

constexpr double radius = 35e-6;

/// A sheet of side x side carriers that close in on each other slowly, each pair at 0.1 m/s: contacts of some 50 us,
/// all in one cluster.
Scene sheet(int side) {
  Scene s;
  s.law().restitution = 1.0;
  s.law().friction = ConstantFriction{0.0};
  s.same_walls();
  for (int n = 0; n < side * side; ++n) {
    const int i = n % side, j = n / side;
    s.add(lactose(n, {2.0001 * radius * i, 2.0001 * radius * j, 0}, {i % 2 ? -0.05 : 0.05, j % 2 ? -0.05 : 0.05, 0}));
  }
  return s;
}

}  // namespace

// Elastic and frictionless: the energy after everything has parted is that at the start. A carrier is shot into the
// sheet at 10 m/s, with contacts a hundred times as stiff in time as those of the sheet. Bound: 1 % of the energy (0.1
// % an impact, some ten impacts in a row). Of the looks that the fastest contact's step would ask for more than half
// are saved.
TEST(Ticks, AStiffImpactInASoftSheetKeepsItsEnergyAndSavesLooks) {
  Scene s = sheet(8);
  s.step(10e-6);
  EXPECT_GT(s.state.contacts.size() - s.state.free_contacts.size(), 60u);
  s.add(lactose(100, {2.0001 * radius * 3.4, 2.0001 * radius * 3.6, 2.2 * radius}, {0.3, 0.2, -10.0}));
  // 64 carriers at 0.05 m/s in two directions each, one at 10 m/s.
  const double start = 0.5 * lactose(0, {0, 0, 0}).mass * (64 * 0.005 + 100.13);
  s.run(300e-6, 2e-6);
  EXPECT_LE(s.state.contacts.size() - s.state.free_contacts.size(), 3u);  // slow ones: they hold 1e-5 of the energy
  EXPECT_NEAR(s.kinetic(), start, 0.01 * start);
  EXPECT_GT(s.state.statistics.looks_saved, s.state.statistics.looks);
}

// Momentum is exchanged between two bodies by every kick, whatever its length: kept to rounding.
TEST(Ticks, MomentumIsKeptThoughContactsKickAtDifferentTimes) {
  Scene s = sheet(6);
  s.law().restitution = 0.6;
  s.law().friction = ConstantFriction{0.4};
  s.same_walls();
  s.step(10e-6);
  s.add(lactose(100, {2.0001 * radius * 2.4, 2.0001 * radius * 2.6, 2.2 * radius}, {0.3, 0.2, -10.0}));
  const auto momentum = [&] {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < s.state.carriers.size(); ++i) sum += s.state.carriers.mass[i] * s.v(i);
    return sum;
  };
  const Vector3d before = momentum();
  s.run(100e-6, 2e-6);
  EXPECT_LT((momentum() - before).norm(), 1e-11 * before.norm());
}
