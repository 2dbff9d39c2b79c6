// The neighbour list holds exactly the pairs within both budgets, whatever the budgets are beside each other.

#include "dem/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/dem/scene.hpp"

namespace puffin::dem {
namespace {

TEST(Neighbours, are_the_pairs_within_both_budgets_also_where_one_carrier_is_far_faster_than_the_rest) {
  // 1,000 carriers of radius 1 in a box of 200 rest (budget 0.01), ten are faster, one of them may go 20 box lengths.
  // Compared with all pairs. In cells of one edge (2.02 + 2 4020/1000 = 10) that one alone would search 800^3 of them
  // and this test last a minute; it takes a millisecond.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 200.0);
  Carriers carriers;
  Neighbours neighbours;
  for (int i = 0; i < 1000; ++i) {
    carriers.position.emplace_back(place(random), place(random), place(random));
    carriers.id.push_back(i);
    carriers.radius.push_back(1.0);
    const int hundred = i / 100 + 1;
    neighbours.budget.push_back(i % 100 == 7 ? 2.0 * hundred : 0.01);
  }
  neighbours.budget[507] = 4000.0;
  build(carriers, neighbours);
  std::size_t pairs = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::int32_t> near;
    for (int j = 0; j < 1000; ++j) {
      const double far = 2.0 + neighbours.budget[i] + neighbours.budget[j];
      if (j != i && (carriers.position[i] - carriers.position[j]).norm() < far) near.push_back(j);
    }
    const std::vector<std::int32_t> listed(neighbours.list.begin() + neighbours.begin[i],
                                           neighbours.list.begin() + neighbours.begin[i + 1]);
    EXPECT_EQ(listed, near) << i;
    pairs += near.size();
  }
  EXPECT_GT(pairs, 2 * 999u);  // the fast one has all others
}

TEST(Neighbours, of_a_carrier_that_is_no_number_are_none_and_the_others_keep_theirs) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d far = Eigen::Vector3d::Constant(1e300);
  for (const double budget : {0.01, 1e300, endless, none})
    for (const double place : {0.0, 1e300, endless, none}) {
      Carriers carriers;
      carriers.position = {{0.0, 0.0, 0.0}, {2.01, 0.0, 0.0}, {place, 50.0, 0.0}, far};
      carriers.id = {0, 1, 2, 3};
      carriers.radius = {1.0, 1.0, 1.0, 1.0};
      Neighbours neighbours;
      neighbours.budget = {0.01, 0.01, budget, 0.01};
      build(carriers, neighbours);
      SCOPED_TRACE(::testing::Message() << "budget " << budget << ", place " << place);
      if (budget == 1e300 && std::isfinite(place)) continue;  // it may meet all of them
      EXPECT_EQ(neighbours.list, (std::vector<std::int32_t>{1, 0}));
      EXPECT_EQ(neighbours.begin, (std::vector<std::int32_t>{0, 1, 2, 2, 2}));
    }
}

// Evenly spread carriers: 2,000 of radius 1 in a box of 100, budget 5, so each has (4/3) pi 12^3 2000/100^3 = 14.5
// neighbours less what lies outside of the box, a sixth to a third. The estimate counts whole spheres: cells of 12 hold
// 3.5 others on average, with a deviation of sqrt(3.5) from one carrier to the next.
TEST(Neighbours, are_about_as_many_as_expected) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 100.0);
  Carriers carriers;
  Neighbours neighbours;
  std::vector<std::int32_t> all;
  for (int i = 0; i < 2000; ++i) {
    carriers.position.emplace_back(place(random), place(random), place(random));
    carriers.id.push_back(i);
    carriers.radius.push_back(1.0);
    neighbours.budget.push_back(5.0);
    all.push_back(i);
  }
  build(carriers, neighbours);
  const double listed = static_cast<double>(neighbours.list.size()) / 2000.0;
  const double expected = expected_neighbours(carriers, neighbours.budget, all);
  EXPECT_GT(listed, 14.5 * 2.0 / 3.0);
  EXPECT_LT(listed, 14.5);
  EXPECT_NEAR(expected, 14.5, 0.1 * 14.5);
  EXPECT_EQ(expected_neighbours(carriers, neighbours.budget, {}), 0.0);
}

// Ten that fly far beside 1,000 at rest, none near: they do not make the lists of all long.
TEST(Neighbours, of_a_lone_flyer_are_none_however_far_it_goes) {
  Carriers carriers;
  std::vector<double> budget;
  std::vector<std::int32_t> awake;
  for (int i = 0; i < 1010; ++i) {
    const bool flies = i >= 1000;
    carriers.position.emplace_back(flies ? 1e6 * (i - 999) : 3.0 * i, 0.0, 0.0);
    carriers.id.push_back(i);
    carriers.radius.push_back(1.0);
    budget.push_back(flies ? 200.0 : 0.01);
    if (flies) awake.push_back(i);
  }
  EXPECT_LT(expected_neighbours(carriers, budget, awake), 1.0);
}

// Fines of 2.9 um at 30 m/s fly 34 diameters in a step of 3.3 us. A list for eight such steps would hold all 4,000 of
// this cloud for each of them (1.1 millimetres of reach in a box of 1.6); one for a single step holds those within
// 2 * 1.1 * 99 um: (4/3) pi 0.22^3 4000/1.6^3 = 44.
TEST(Neighbours, of_fast_fines_are_those_of_one_step) {
  testing::Scene s;
  s.walls = testing::PlaneWalls::box(10e-3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(4e-3, 5.6e-3), part(-1.0, 1.0);
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d way(part(random), part(random), part(random));
    s.add(testing::lactose(i, {place(random), place(random), place(random)}, 30.0 * way.normalized(), 1.45e-6));
  }
  s.run(3.3e-6, 3.3e-6);
  const double listed = static_cast<double>(s.state.neighbours.list.size()) / 4000.0;
  EXPECT_LT(listed, 50.0);
  EXPECT_GT(listed, 20.0);
}

}  // namespace
}  // namespace puffin::dem
