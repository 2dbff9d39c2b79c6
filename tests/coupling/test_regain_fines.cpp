// Fines that come back to carriers, from the air and from walls.

#include "coupling/regain_fines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/coupling/boxes.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;
using namespace puffin::coupling::testing;

dem::Carriers one_parcel(const Eigen::Vector3d& position, double carriers) {
  dem::Carriers c;
  c.id = {0};
  c.position = {position};
  c.velocity = c.spin = {Eigen::Vector3d::Zero()};
  c.radius = {35e-6 * std::cbrt(carriers)};
  c.mass = {carriers * 2.8e-10};
  c.carriers = {carriers};
  c.single_radius = {35e-6};
  c.rest = {dem::Rest::awake};
  return c;
}

struct Cloud {
  Cloud()
      : rows(full_box({12, 12, 12}, 2e-4)),
        cells(rows),
        carriers(one_parcel(rows.centre(rows.active_slot(6, 6, 6)), 10.0)),
        fines(carriers, 2000.0, 4),
        fields(rows, mechanisms),
        budget(rows, mechanisms, 1) {
    stencils.build(cells, carriers.position, carriers.radius, all(1));
    regain.sticking = 0.5;
    regain.fine_diameter = 1.9e-6;
    regain.response_time = 1.83e-5;
    regain.area.assign(4, 1e-8);
    for (std::size_t s = 0; s < rows.slots(); ++s)
      if (rows.is_active(s)) fields.amount[scalar_index(0, Mechanism::particle)][s] = 3.0;
    fines.placed = {lbm::total(fields, scalar_index(0, Mechanism::particle))};
  }
  lbm::Rows rows;
  CellIndex cells;
  dem::Carriers carriers;
  Fines fines;
  lbm::ScalarFields fields;
  lbm::ScalarBudget budget;
  Stencils stencils;
  Regain regain;
};

TEST(Regain, efficiency_has_its_limits) {
  // Slow: interception alone, 3 r + ...; fast: all in the tube, and the interception on top.
  const double r = 1.9 / 70.0, interception = (1 + r) * (1 + r) - 1 / (1 + r);
  EXPECT_NEAR(collection_efficiency(0.1, 70e-6, 1.9e-6, 1.83e-5), interception, 1e-12);
  EXPECT_NEAR(collection_efficiency(1e6, 70e-6, 1.9e-6, 1.83e-5), 1.0 + interception, 1e-5);
  // K = 1/2: a quarter.
  EXPECT_NEAR(collection_efficiency(0.5 * 35e-6 / 1.83e-5, 70e-6, 1.9e-6, 1.83e-5), 0.25 + interception, 1e-12);
}

TEST(Regain, a_parcel_sweeps_the_air_that_slips_by) {
  // In a uniform cloud of n fines a volume: E sticking (pi/4) d^2 v n t for each carrier; 1 - exp(-x) differs from x by
  // x/2 where most is taken, x = 0.3 weight: below 1 %.
  Cloud c;
  const double slip = 10.0, time = 1e-6, n = 3.0 / std::pow(2e-4, 3);
  const double expected = 10.0 * 0.5 * collection_efficiency(slip, 70e-6, 1.9e-6, 1.83e-5) * 0.25 * std::numbers::pi *
                          70e-6 * 70e-6 * slip * n * time;
  reattach(c.stencils, std::vector<double>{slip}, time, 2e-4, c.carriers, c.regain, c.fines, c.fields);
  EXPECT_NEAR((c.fines.left[0] - 20000.0) / expected, 1.0, 0.01);
  EXPECT_GT(c.fines.regained[1].value(), 0.0);
  EXPECT_EQ(c.fines.regained[0].value(), 0.0);
}

TEST(Regain, the_ledger_closes_when_everything_is_taken_back) {
  Cloud c;
  for (int n = 0; n < 1000; ++n)
    reattach(c.stencils, std::vector<double>{30.0}, 1e-4, 2e-4, c.carriers, c.regain, c.fines, c.fields);
  const Ledger books = ledger(c.fines, c.fields, c.budget, 0);
  EXPECT_GT(books.by_mechanism[1].regained, 50.0);
  EXPECT_LT(std::abs(books.error()), 1e-12);
  for (const double a : c.fields.amount[1]) EXPECT_GE(a, 0.0);
}

TEST(Regain, a_hit_takes_along_what_its_reach_covers_and_never_more_than_there_is) {
  Cloud c;
  c.regain.pick_up = 0.5;
  c.fines.left[0] -= 1000.0;
  c.fines.stuck[2] = 1000.0;
  c.fines.to_wall.add(1000.0);
  dem::ContactBegun hit;
  hit.point = hit.normal = Eigen::Vector3d::Zero();
  hit.a = 0, hit.triangle = 2, hit.time = 1.0;
  // pi d_c d_f of ten carriers on 1e-8 m^2: 0.4178 of the triangle.
  const double covered = 10.0 * std::numbers::pi * 70e-6 * 1.9e-6 / 1e-8;
  pick_up_from_walls(std::vector{hit}, 0.0, c.carriers, c.regain, c.fines);
  EXPECT_NEAR(c.fines.picked_up.value(), 1000.0 * 0.5 * covered, 1e-9);
  EXPECT_LT(std::abs(ledger(c.fines, c.fields, c.budget, 0).error()), 1e-12);
  c.regain.pick_up = 1.0;
  c.regain.area.assign(4, 1e-12);  // all of it is in reach
  pick_up_from_walls(std::vector{hit}, 0.0, c.carriers, c.regain, c.fines);
  EXPECT_EQ(c.fines.stuck[2], 0.0);
  EXPECT_NEAR(ledger(c.fines, c.fields, c.budget, 0).on_walls, 0.0, 1e-9);
  pick_up_from_walls(std::vector{hit}, 2.0, c.carriers, c.regain, c.fines);  // before the first motion: nothing
  EXPECT_NEAR(c.fines.left[0], 20000.0, 1e-9);
}

}  // namespace
