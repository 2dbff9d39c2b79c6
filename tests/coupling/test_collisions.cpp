#include "coupling/collisions.hpp"

#include <gtest/gtest.h>

#include "coupling/first_motion.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;

dem::Carriers parcels(std::vector<double> counts) {
  dem::Carriers c;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    c.id.push_back(static_cast<std::int64_t>(n));
    c.position.emplace_back(n * 1e-3, 0.0, 0.0);
    c.mass.push_back(counts[n] * 2.84e-10);
    c.carriers.push_back(counts[n]);
    c.rest.push_back(dem::Rest::awake);
  }
  return c;
}

dem::ContactBegun contact(std::int64_t a, std::int64_t b, double normal, double tangential, double time = 1.0) {
  dem::ContactBegun c;
  c.point = c.normal = Eigen::Vector3d::Zero();
  c.a = a;
  c.b = b;
  c.triangle = b < 0 ? 2 : -1;
  c.normal_speed = normal;
  c.tangential_speed = tangential;
  c.time = time;
  return c;
}

TEST(Collisions, AParcelOfTenCountsTenForEachPartner) {
  const auto carriers = parcels({10.0, 10.0, 10.0});
  Collisions c(carriers, 4);
  count_collisions(std::vector{contact(0, 1, 1.0, 0.0), contact(2, -1, 2.0, 5.0)}, carriers, 0.0, c);
  EXPECT_EQ(c.particle, 20.0);
  EXPECT_EQ(c.wall, 10.0);
  EXPECT_EQ(c.contacts, (std::vector<std::int64_t>{1, 1, 1}));
  EXPECT_EQ(c.hits[2], 10.0);
}

TEST(Collisions, EnergiesUseTheSingleMassAndTheImpactSpeed) {
  // wall: normal speed alone, 0.5 * 2.84e-10 * 4; carriers: relative speed, 0.5 * 2.84e-10 * (1 + 9).
  const auto carriers = parcels({10.0, 10.0});
  Collisions c(carriers, 4);
  count_collisions(std::vector{contact(0, -1, 2.0, 7.0), contact(0, 1, 1.0, 3.0)}, carriers, 0.0, c);
  EXPECT_NEAR(*mean_wall_energy(c) / 5.68e-10, 1.0, 1e-14);
  EXPECT_NEAR(*mean_particle_energy(c) / 1.42e-9, 1.0, 1e-14);
  EXPECT_NEAR(c.energy[2] / 5.68e-9, 1.0, 1e-14);
}

TEST(Collisions, SettlingContactsAreNotCounted) {
  const auto carriers = parcels({10.0, 10.0});
  Collisions c(carriers, 4);
  const std::vector<dem::ContactBegun> begun{contact(0, 1, 1.0, 0.0, 0.004), contact(0, -1, 1.0, 0.0, 0.07)};
  count_collisions(begun, carriers, std::nullopt, c);
  EXPECT_EQ(c.wall + c.particle, 0.0);
  count_collisions(begun, carriers, 0.065, c);
  EXPECT_EQ(c.particle, 0.0);
  EXPECT_EQ(c.wall, 10.0);
  EXPECT_FALSE(mean_particle_energy(c).has_value());
}

TEST(Collisions, MedianIsOverRealCarriers) {
  // contacts 5, 1, 3 of entries that stand for 10, 1, 1 carriers: the median carrier of 12 belongs to the first.
  const auto carriers = parcels({10.0, 1.0, 1.0});
  Collisions c(carriers, 4);
  c.contacts = {5, 1, 3};
  EXPECT_EQ(median_contacts(c), 5.0);
  EXPECT_EQ(median_contacts(c, std::vector<std::uint8_t>{0, 1, 1}), 2.0);  // the middle two of two
  EXPECT_FALSE(median_contacts(c, std::vector<std::uint8_t>{0, 0, 0}).has_value());
}

TEST(Collisions, ContactsOfUnknownCarriersAreRefused) {
  const auto carriers = parcels({1.0});
  Collisions c(carriers, 4);
  EXPECT_THROW(count_collisions(std::vector{contact(7, -1, 1.0, 0.0)}, carriers, 0.0, c), std::invalid_argument);
}

TEST(FirstMotion, IsTheFirstCarrierMoreThanAMillimetreFromWhereItSettled) {
  auto carriers = parcels({1.0, 1.0});
  FirstMotion motion(carriers);
  carriers.position[1].z() -= 0.9e-3;  // falls and comes to rest
  motion.update(carriers, 0.004);
  carriers.rest[1] = dem::Rest::asleep;
  motion.update(carriers, 0.006);
  carriers.rest[1] = dem::Rest::awake;
  carriers.position[1].z() -= 0.8e-3;  // 1.7 mm from the start, 0.8 mm from the settled place
  motion.update(carriers, 0.060);
  EXPECT_FALSE(motion.time().has_value());
  carriers.position[1].x() += 0.7e-3;  // now sqrt(0.8^2 + 0.7^2) = 1.06 mm
  motion.update(carriers, 0.065);
  motion.update(carriers, 0.070);
  EXPECT_EQ(motion.time(), 0.065);
}

TEST(FirstMotion, IdsMustAscend) {
  auto carriers = parcels({1.0, 1.0});
  carriers.id = {1, 0};
  EXPECT_THROW(FirstMotion{carriers}, std::invalid_argument);
  carriers.id = {4, 9};
  EXPECT_EQ(id_range(carriers), 10u);
  EXPECT_EQ(place_of(carriers, 9), 1);
  EXPECT_EQ(place_of(carriers, 5), -1);
}
}  // namespace
