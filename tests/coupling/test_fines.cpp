#include "coupling/fines.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "coupling/carry_fines.hpp"
#include "coupling/release_fines.hpp"
#include "tests/coupling/boxes.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;
using namespace puffin::coupling::testing;

constexpr std::size_t triangles = 40;

dem::Carriers carriers_at(const std::vector<Eigen::Vector3d>& position, double per_entry) {
  dem::Carriers c;
  for (std::size_t n = 0; n < position.size(); ++n) {
    c.id.push_back(static_cast<std::int64_t>(n));
    c.position.push_back(position[n]);
    c.velocity.emplace_back(Eigen::Vector3d::Zero());
    c.spin.emplace_back(Eigen::Vector3d::Zero());
    c.radius.push_back(75e-6);
    c.mass.push_back(per_entry * 2.8e-10);
    c.carriers.push_back(per_entry);
    c.single_radius.push_back(35e-6);
    c.rest.push_back(dem::Rest::awake);
  }
  return c;
}

dem::ContactBegun wall_hit(std::int64_t a, int triangle, double speed, double time = 1.0) {
  dem::ContactBegun contact;
  contact.point = contact.normal = Eigen::Vector3d::Zero();
  contact.a = a;
  contact.triangle = triangle;
  contact.normal_speed = speed;
  contact.time = time;
  return contact;
}

/// A device full of air, parcels of 10 in it, two sets of scalars.
struct Device {
  explicit Device(int count = 200)
      : rows(full_box({40, 8, 8}, 2e-4)),
        cells(rows),
        carriers(carriers_at(places(rows, count, {1, 1, 1}, {38, 6, 6}), 10.0)),
        fines(carriers, 2000.0, triangles),
        fields(rows, 2 * mechanisms),
        budget(rows, 2 * mechanisms, 1) {
    models.wall_detach = micromodels::PowerLaw({0.02, 1.0, 3.0, 0.03, 0.8});
    models.wall_attach = micromodels::PowerLaw({0.004, 1.0, 3.0, 0.005, 0.8});
    models.particle_detach = micromodels::PowerLaw({0.01, 0.9, 3.0, 0.02, 0.5});
    models.drag_detach = micromodels::PowerLaw({1e-3, 2.0, 10.0, 1e-3, 2.0});
  }
  /// 100 contacts at once, as a step of a dense dose may have.
  std::vector<dem::ContactBegun> contacts(std::mt19937& random) {
    std::uniform_int_distribution<int> carrier(0, static_cast<int>(carriers.size()) - 1), triangle(0, triangles - 1);
    std::uniform_real_distribution<double> speed(0.0, 12.0);
    std::vector<dem::ContactBegun> result;
    for (int n = 0; n < 100; ++n) {
      result.push_back(wall_hit(carrier(random), triangle(random), speed(random)));
      if (n % 3) continue;
      result.back().triangle = -1;
      do result.back().b = carrier(random);
      while (result.back().b == result.back().a);
      result.back().tangential_speed = speed(random);
    }
    return result;
  }
  lbm::Rows rows;
  CellIndex cells;
  dem::Carriers carriers;
  Fines fines;
  lbm::ScalarFields fields;
  lbm::ScalarBudget budget;
  micromodels::FinesModels models;
  FinesRelease release;
};

TEST(Fines, TakingClipsToWhatIsLeftAndLosesNothing) {
  double left = 10.0;
  Taken t = take(6.0, 1.5, left);
  EXPECT_EQ(t.air, 6.0);
  EXPECT_EQ(t.wall, 1.5);
  EXPECT_EQ(left, 2.5);
  t = take(2.0, 1.0, left);  // more than is left: the wall has its part, the air the rest
  EXPECT_EQ(t.air + t.wall, 2.5);
  EXPECT_EQ(left, 0.0);
  t = take(1.0, 0.0, left);
  EXPECT_EQ(t.air + t.wall, 0.0);
}

TEST(Fines, AMillionTinyTakingsAddUpToWhatIsMissing) {
  // Each difference left - left' is exact; the sum is compensated. A plain sum of the amounts asked for would be off by
  // the rounding of left, up to 1e6 * 1.8e-12 = 2e-6 of 20,000.
  double left = 20000.0;
  lbm::CompensatedSum air;
  for (int n = 0; n < 1'000'000; ++n) air.add(take(1.2345678e-3, 0.0, left).air);
  EXPECT_EQ(air.value(), 20000.0 - left);
}

TEST(FinesRelease, LedgerClosesAfterAHundredThousandContactsWithClippingAndEmission) {
  Device d;
  std::mt19937 random(3);
  const std::vector<int> which = all(d.carriers.size());
  Stencils stencils;
  stencils.build(d.cells, d.carriers.position, d.carriers.radius, which);
  const std::vector<double> slip(d.carriers.size(), 8.0);
  bool clipped = false;
  for (int step = 0; step < 1000; ++step) {
    d.release.by_contacts(d.contacts(random), 0.0, d.carriers, d.models, d.cells, d.fines, d.fields);
    d.release.by_drag(stencils, slip, 1e-6, d.carriers, d.models, d.fines, d.fields);
    if (step == 20) mark_emitted(std::vector<std::int64_t>{3, 7, 199}, d.fines);
  }
  for (const double left : d.fines.left) {
    EXPECT_GE(left, 0.0);
    clipped = clipped || left == 0.0;
  }
  EXPECT_TRUE(clipped);  // about 1,000 contacts each: all are empty long before the end
  // The demand: 1e-12 of the dose at every output.
  for (const int set : {0, 1}) {
    const Ledger books = ledger(d.fines, d.fields, d.budget, set);
    EXPECT_LT(std::abs(books.error()), 1e-12);
    EXPECT_NEAR(books.FFE() + books.FFW() + books.FFCR() + books.FFCE() + books.air_fraction(), 1.0, 1e-12);
    EXPECT_DOUBLE_EQ(books.loaded, 200 * 10 * 2000.0);
    EXPECT_GT(books.FFW(), 0.0);
    EXPECT_GT(books.by_mechanism[0].released, 0.0);
    EXPECT_GT(books.by_mechanism[1].released, 0.0);
    EXPECT_GT(books.by_mechanism[2].released, 0.0);
    for (const auto& shares : books.by_mechanism) EXPECT_NEAR(shares.in_air / shares.released, 1.0, 1e-12);
    // the wall map adds up to FFW
    const std::vector<double> map = wall_map(d.fines, d.budget, set, {});
    EXPECT_NEAR(std::accumulate(map.begin(), map.end(), 0.0) / books.loaded, books.FFW(), 1e-12);
  }
}

TEST(FinesRelease, OneHitMovesWhatTheLawsSay) {
  // v = 2 m/s, below the switch: 0.02 * 2 = 0.04 of 20,000 fines to the air, 0.004 * 2 of them to the wall; rounding
  // only.
  Device d;
  const std::vector<dem::ContactBegun> hit{wall_hit(5, 17, 2.0)};
  d.release.by_contacts(hit, 0.0, d.carriers, d.models, d.cells, d.fines, d.fields);
  EXPECT_NEAR(d.fines.stuck[17], 160.0, 1e-10);
  EXPECT_NEAR(lbm::total(d.fields, scalar_index(0, Mechanism::wall)), 800.0, 1e-10);
  EXPECT_NEAR(lbm::total(d.fields, scalar_index(1, Mechanism::wall)), 800.0, 1e-10);
  EXPECT_EQ(lbm::total(d.fields, scalar_index(0, Mechanism::particle)), 0.0);
  EXPECT_NEAR(d.fines.left[5], 19040.0, 1e-10);
  EXPECT_EQ(d.fines.left[4], 20000.0);
}

TEST(FinesRelease, BothPartnersOfAContactLose) {
  // relative speed sqrt(1.2^2 + 1.6^2) = 2: 0.01 * 2^0.9 of each.
  Device d;
  dem::ContactBegun contact = wall_hit(5, -1, 1.2);
  contact.b = 9;
  contact.tangential_speed = 1.6;
  d.release.by_contacts(std::vector{contact}, 0.0, d.carriers, d.models, d.cells, d.fines, d.fields);
  const double loss = 20000.0 * 0.01 * std::pow(2.0, 0.9);
  EXPECT_NEAR(d.fines.left[5], 20000.0 - loss, 1e-9);
  EXPECT_NEAR(d.fines.left[9], 20000.0 - loss, 1e-9);
  EXPECT_NEAR(lbm::total(d.fields, scalar_index(0, Mechanism::particle)), 2.0 * loss, 1e-9);
}

TEST(FinesRelease, FinesAppearWhereTheCarrierIs) {
  // The first moment of the kernel vanishes away from walls, so the centre of the new fines is the carrier's; 1e-2 m *
  // 1e-16
  // * 343 terms.
  Device d;
  d.carriers.position[5] = d.rows.origin() + 2e-4 * Eigen::Vector3d(20.3, 3.6, 3.9);
  d.release.by_contacts(std::vector{wall_hit(5, 17, 2.0)}, 0.0, d.carriers, d.models, d.cells, d.fines, d.fields);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& run : d.rows.runs())
    for (int n = 0; n < run.count; ++n)
      centre += d.fields.amount[0][run.first + n] / 800.0 * d.rows.centre(run.first + n);
  EXPECT_LT((centre - d.carriers.position[5]).norm(), 1e-14);
}

TEST(FinesRelease, SettlingContactsAndCarriersBeyondTheAirMoveNothing) {
  Device d;
  const std::vector<dem::ContactBegun> hit{wall_hit(5, 17, 2.0, 0.03)};
  d.release.by_contacts(hit, std::nullopt, d.carriers, d.models, d.cells, d.fines, d.fields);
  d.release.by_contacts(hit, 0.05, d.carriers, d.models, d.cells, d.fines, d.fields);
  EXPECT_EQ(d.fines.left, d.fines.initial);
  d.carriers.position[5].x() += 1.0;
  d.release.by_contacts(hit, 0.01, d.carriers, d.models, d.cells, d.fines, d.fields);
  EXPECT_EQ(d.fines.left, d.fines.initial);
  EXPECT_EQ(d.fines.without_air, 1);
  EXPECT_THROW(
      d.release.by_contacts(std::vector{wall_hit(1000, 1, 1.0)}, 0.0, d.carriers, d.models, d.cells, d.fines, d.fields),
      std::invalid_argument);
}

TEST(FinesRelease, DragTakesItsRateTimesTheTime) {
  // 1e-3 * 8^2 a second of 20,000 fines, over 1 ms: 1.28 from each of 200 entries; one rounding of 20,000 (2e-12) each.
  Device d;
  Stencils stencils;
  stencils.build(d.cells, d.carriers.position, d.carriers.radius, all(d.carriers.size()));
  d.release.by_drag(stencils, std::vector<double>(200, 8.0), 1e-3, d.carriers, d.models, d.fines, d.fields);
  EXPECT_NEAR(d.fines.left[11], 20000.0 - 1.28, 4e-12);
  EXPECT_NEAR(lbm::total(d.fields, scalar_index(1, Mechanism::drag)), 256.0, 1e-9);
}

// Its place in the history of slips lay far outside the table, and a law refuses what is no number: a run with such a
// carrier is ended by its health check, which names it.
TEST(FinesRelease, WhatHasNoFiniteSpeedLosesNothingAndTheOthersDo) {
  Device d;
  Stencils stencils;
  stencils.build(d.cells, d.carriers.position, d.carriers.radius, all(d.carriers.size()));
  std::vector<double> slip(200, 8.0);
  slip[0] = std::numeric_limits<double>::infinity();
  slip[1] = std::numeric_limits<double>::quiet_NaN();
  d.release.by_drag(stencils, slip, 1e-3, d.carriers, d.models, d.fines, d.fields);
  EXPECT_EQ(d.fines.left[0], 20000.0);
  EXPECT_EQ(d.fines.left[1], 20000.0);
  EXPECT_NEAR(d.fines.left[2], 20000.0 - 1.28, 4e-12);
  EXPECT_NEAR(lbm::total(d.fields, scalar_index(1, Mechanism::drag)), 198 * 1.28, 1e-9);
}

TEST(FinesRelease, WhatIsHeldLosesNothingByDragAndHasNoHistory) {
  Device d;
  d.carriers.rest[11] = dem::Rest::held;
  Stencils stencils;
  stencils.build(d.cells, d.carriers.position, d.carriers.radius, all(d.carriers.size()));
  d.release.by_drag(stencils, std::vector<double>(200, 8.0), 1e-3, d.carriers, d.models, d.fines, d.fields);
  EXPECT_EQ(d.fines.left[11], 20000.0);
  EXPECT_EQ(d.fines.slip.asked[11], 0.0);
  for (int k = 0; k < SlipHistory::classes; ++k) EXPECT_EQ(d.fines.slip.seconds[11 * SlipHistory::classes + k], 0.0);
  EXPECT_NEAR(lbm::total(d.fields, scalar_index(1, Mechanism::drag)), 199 * 1.28, 1e-9);
}

TEST(FinesRelease, IsTheSameForOneAndTwoThreads) {
  std::array<Device, 2> d;
  for (int n = 0; n < 2; ++n) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, n + 1);
    std::mt19937 random(3);
    for (int step = 0; step < 20; ++step)
      d[n].release.by_contacts(d[n].contacts(random), 0.0, d[n].carriers, d[n].models, d[n].cells, d[n].fines,
                               d[n].fields);
  }
  EXPECT_EQ(d[0].fines.left, d[1].fines.left);
  EXPECT_EQ(d[0].fields.amount, d[1].fields.amount);
}

// A dry scene: what comes off stays in the one place that stands for the air; 2,600 takings and sums, rounding each.
TEST(FinesRelease, WithoutAirWhatComesOffStaysInTheBooks) {
  Device d;
  State s;
  keep_fines_in_one_place(2, s);
  std::mt19937 random(3);
  for (int step = 0; step < 20; ++step)
    d.release.by_contacts(d.contacts(random), 0.0, d.carriers, d.models, CellIndex(), d.fines, s.scalars);
  EXPECT_EQ(d.fines.without_air, 0);
  for (const int set : {0, 1}) {
    const Ledger books = ledger(d.fines, s.scalars, s.budget, set);
    EXPECT_GT(books.in_air, 0.05 * books.loaded);
    EXPECT_NEAR(books.in_air, d.fines.to_air[0].value() + d.fines.to_air[1].value(), 1e-12 * books.loaded);
    EXPECT_GT(books.by_mechanism[1].in_air, 0.0);
    EXPECT_GT(books.on_walls, 0.0);
    EXPECT_NEAR(books.error(), 0.0, 1e-13);
  }
}

TEST(Ledger, SeesWhatLeftAndWhatTheAirDeposited) {
  // 1,000 fines in the air; 300 leave through the opening, 100 stay in a cell beside triangle 4.
  Device d;
  double left = d.fines.left[0];
  const Taken t = take(1000.0, 0.0, left);
  d.fines.left[0] = left;
  d.fines.to_air[0].add(t.air);
  const auto slot = d.rows.runs()[0].first;
  d.fields.amount[0][slot] = 600.0;
  d.budget.left[0][0].add(300.0);
  d.budget.absorbed_at[0][slot] = 100.0;
  d.fields.amount[3][slot] = 1000.0;  // the second set kept all of it in the air
  const Ledger first = ledger(d.fines, d.fields, d.budget, 0), second = ledger(d.fines, d.fields, d.budget, 1);
  EXPECT_NEAR(first.error(), 0.0, 1e-15);
  EXPECT_NEAR(second.error(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(first.emitted, 300.0);
  EXPECT_DOUBLE_EQ(first.on_walls, 100.0);
  EXPECT_DOUBLE_EQ(second.in_air, 1000.0);
  std::vector<int> nearest(d.rows.slots(), -1);
  EXPECT_THROW(wall_map(d.fines, d.budget, 0, nearest), std::invalid_argument);
  nearest[slot] = 4;
  EXPECT_DOUBLE_EQ(wall_map(d.fines, d.budget, 0, nearest)[4], 100.0);
  d.fields.amount[0][slot] = 599.0;  // a fine lost is a fine seen
  EXPECT_NEAR(ledger(d.fines, d.fields, d.budget, 0).error(), -1.0 / 4e6, 1e-15);
}
}  // namespace
