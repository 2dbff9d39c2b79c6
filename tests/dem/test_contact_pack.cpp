// Contacts in packs follow the same law as one contact, to the bit, on every instruction set.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dem/contact_pack.hpp"
#include "dem/contact_step.hpp"
#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;

namespace {

/// Eight pairs of carriers in all phases, pressed, in tension, at the knee, sliding, parting; of one size or of
/// several.
Cluster eight_pairs(const Rules& rules, bool one_size, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0; };
  const auto any_vector = [&](double size, double(&out)[3]) {
    for (double& x : out) x = size * uniform();
  };
  Cluster cluster;
  for (int n = 0; n < 16; ++n) {
    Body& body = cluster.bodies.emplace_back();
    BodyRecord& record = cluster.records.emplace_back();
    record.carrier = n, record.id = n;
    body.radius = record.single_radius = one_size ? 35e-6 : 35e-6 * (1.0 + 0.1 * uniform());
    record.mass = record.single_mass = 6e3 * body.radius * body.radius * body.radius;
    body.inverse_mass = 1.0 / record.mass;
    body.inverse_inertia = 2.5 / (record.mass * body.radius * body.radius);
    any_vector(1e-3, body.x), any_vector(0.1, body.v), any_vector(0.01, body.kick);
    any_vector(rules.rotation ? 1e3 : 0.0, body.w), any_vector(rules.rotation ? 1e2 : 0.0, body.twist);
  }
  for (int n = 0; n < 8; ++n) {
    Body &a = cluster.bodies[2 * n], &b = cluster.bodies[2 * n + 1];
    double way[3];
    any_vector(1.0, way);
    const double length = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    const double overlap = (n < 2 ? -4e-10 : n < 4 ? 1e-9 : 2e-6) * (1.0 + 0.5 * uniform());
    for (int d = 0; d < 3; ++d) b.x[d] = a.x[d] - way[d] / length * (a.radius + b.radius - overlap);
    Contact contact;
    contact.phase = static_cast<ContactPhase>(1 + (n + seed) % 3);
    contact.stiffness = 100.0 * (1.1 + uniform());
    contact.slip = Eigen::Vector3d(uniform(), uniform(), uniform()) * 1e-9;
    restore_contact(add_touch(2 * n, 2 * n + 1, rules, cluster), contact, rules, cluster);
  }
  cluster.events.assign(1, 0);
  return cluster;
}

/// Largest difference of anything that the contacts change, in parts of the largest of its kind; 1 for another phase.
double difference(const Cluster& a, const Cluster& b) {
  double largest = 0.0;
  const auto compare = [&](auto of) {
    double apart = 0.0, size = 1e-300;
    for (int l = 0; l < Springs::lanes; ++l) {
      const double x = of(a, l), y = of(b, l);
      apart = std::max(apart, std::abs(x - y)), size = std::max(size, std::abs(x));
    }
    largest = std::max(largest, apart / size);
  };
  for (const auto row : {&Springs::knee_stiffness, &Springs::spring, &Springs::dashpot, &Springs::limit,
                         &Springs::max_force, &Springs::max_overlap})
    compare([row](const Cluster& c, int l) { return (c.springs[0].*row)[l]; });
  for (int d = 0; d < 3; ++d) {
    compare([d](const Cluster& c, int l) { return c.springs[0].slip[d][l]; });
    compare([d](const Cluster& c, int l) { return c.pulls[l].force[d]; });
    compare([d](const Cluster& c, int l) { return c.pulls[l].moment[d]; });
  }
  for (int l = 0; l < Springs::lanes; ++l)
    if (a.springs[0].phase[l] != b.springs[0].phase[l]) largest = 1.0;
  return largest;
}

}  // namespace

// The normal, the overlap and the surface velocities are rounded alike (the text is one from there on); moments of
// force are multiplied by the sum of the arms in one and by the distance in the other: 1e-14.
TEST(ContactPack, EveryInstructionSetFollowsTheLawOfOneContact) {
  std::vector<PairContacts*> kinds = {baseline::pair_contacts()};
  if (__builtin_cpu_supports("avx2")) kinds.push_back(avx2::pair_contacts());
#if !defined(__clang__)  // never chosen there: decision 0010
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    kinds.push_back(avx512::pair_contacts());
#endif
  int events_met = 0;
  for (const bool rotation : {true, false})
    for (const bool constant : {true, false})
      for (unsigned seed = 1; seed <= 50; ++seed) {
        Models models;
        LinearContact law;
        if (!constant) law.friction = SpeedFriction{0.5, 0.2, 0.1, 0.05, 0.2};
        models.carrier = {law, Hamaker{3.6e-3, 0.0, 4e-10, ParcelScaling::ddpm, {}}};
        models.rotation = rotation;
        const Rules rules(models);
        const Cluster start = eight_pairs(rules, seed % 2 == 0, seed);
        Cluster one = start;
        std::uint32_t expected = 0;
        double step = 1e300;
        for (std::size_t l = 0; l < 8; ++l) {
          const Followed followed = follow(l, 1e-8, 1e-8, rules, one);
          if (followed.event) expected |= 1u << l, ++events_met;
          step = std::min(step, followed.step);
        }
        Cluster first;
        for (PairContacts* contacts : kinds) {
          Cluster packed = start;
          std::uint32_t events = 0;
          const double allowed = contacts(rules.carrier_springs, 1e-8, packed.bodies.data(), packed.constants.data(),
                                          packed.springs[0], packed.pulls.data(), events);
          EXPECT_EQ(events, expected);
          EXPECT_NEAR(allowed, step, 1e-9 * step);
          EXPECT_LT(difference(one, packed), 1e-9) << "seed " << seed;
          if (contacts == kinds.front()) first = packed;
          EXPECT_EQ(difference(first, packed), 0.0) << "seed " << seed;
        }
      }
  EXPECT_GT(events_met, 50);
}
