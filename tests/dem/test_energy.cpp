// No law makes energy: clusters of spheres that fly into each other, at random, with every law.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dem/jkr.hpp"
#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;
using Eigen::Vector3d;

namespace {

/// 4 x 3 x 2 spheres of unlike sizes, spinning, on their way to the middle.
Scene cluster(const ContactModel& contact, const Adhesion& adhesion, int seed, double speed) {
  Scene s;
  s.models.carrier = {contact, adhesion};
  s.models.integration.sleep = false;
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(in(generator), in(generator), in(generator)); };
  for (int n = 0; n < 24; ++n) {
    const int column = n % 4, row = n / 4 % 3, layer = n / 12;
    const Vector3d site(column - 1.5, row - 1.0, layer - 0.5);
    Carrier c =
        lactose(n, 90e-6 * site + 4e-6 * vector(), speed * (vector() - site), (30.0 + 5.0 * in(generator)) * 1e-6);
    c.spin = 1e5 * speed * vector();
    s.add(c);
  }
  return s;
}

ContactModel linear(double e, double mu) { return LinearContact{e, ConstantFriction{mu}, 0.02, {}, 0.02, 2.0 / 7.0}; }
ContactModel hertz(double e, double mu) { return HertzContact{e, ConstantFriction{mu}, 0.02, {1e8, 0.3}, {1e8, 0.3}}; }

/// Largest kinetic energy from now on over that at the start.
double growth(Scene s, double reach) {
  const double start = s.kinetic();
  double largest = 0.0;
  for (int n = 0; n < 150; ++n) {
    s.step(1e-6 * reach);
    largest = std::max(largest, s.kinetic() / start);
  }
  EXPECT_GT(s.events.begun.size(), 5u);
  return largest;
}

}  // namespace

// Energy in springs is positive, so kinetic energy alone must not exceed that of the start. 1 %: the scheme's error of
// an impact is 0.2 % and a sphere meets a handful of others.
TEST(Energy, ElasticAndDampedClustersDoNotGain) {
  for (const double speed : {0.1, 2.0})
    for (int seed = 1; seed <= 4; ++seed)
      for (const double e : {0.5, 1.0})
        for (const double mu : {0.0, 0.4, 5.0}) {
          EXPECT_LE(growth(cluster(linear(e, mu), NoAdhesion{}, seed, speed), 1.0 / speed), 1.01) << e << mu << seed;
          EXPECT_LE(growth(cluster(hertz(e, mu), NoAdhesion{}, seed, speed), 1.0 / speed), 1.01) << e << mu << seed;
        }
}

// With adhesion each contact may lend the depth of its well: F0 d0 for the booked well, F_c delta_c and F0 delta_0 of
// the elastic laws (times a number near 1), at most a dozen contacts a sphere.
TEST(Energy, AdhesiveClustersGainNoMoreThanTheirWells) {
  for (int seed = 1; seed <= 4; ++seed) {
    const double speed = 0.5;
    const Scene any = cluster(linear(1.0, 0.4), NoAdhesion{}, seed, speed);
    const double start = any.kinetic(), work = 7.2e-3, radius = 20e-6, modulus = 1e8 / 1.82;
    const JkrCurve curve(work, radius, modulus);
    const double contacts = 6.0 * 24.0, deep = 3.0 * contacts * curve.pull_off * curve.stretch;
    EXPECT_LE(growth(cluster(linear(1.0, 0.4), Hamaker{3.6e-3, 0.0, 4e-10, {}, {}}, seed, speed), 2.0), 1.01);
    EXPECT_LE(growth(cluster(hertz(1.0, 0.4), Jkr{3.6e-3, {}, {}}, seed, speed), 2.0), 1.01 + deep / start);
    EXPECT_LE(growth(cluster(hertz(1.0, 0.4), Dmt{3.6e-3, 4e-10, {}, {}}, seed, speed), 2.0), 1.01 + deep / start);
  }
}
