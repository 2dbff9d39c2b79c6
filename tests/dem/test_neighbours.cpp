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

}  // namespace
}  // namespace puffin::dem
