#include "coupling/stencils.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "coupling/stencil_loop.hpp"
#include "tests/coupling/boxes.hpp"

namespace {
using namespace puffin;
using namespace puffin::coupling;
using namespace puffin::coupling::testing;

Stencils stencils_of(const CellIndex& cells, const std::vector<Eigen::Vector3d>& position, double diameter) {
  Stencils s;
  s.build(cells, position, std::vector<double>(position.size(), 0.5 * diameter), all(position.size()));
  return s;
}

TEST(CellIndex, AgreesWithRowsEverywhere) {
  const auto rows =
      box({7, 5, 6}, 1e-4, [](int i, int j, int k) { return (i * 3 + j * 5 + k * 7) % 4 != 0; }, {true, false, true});
  const CellIndex cells(rows);
  for (int k = -8; k < 14; ++k)
    for (int j = -3; j < 8; ++j)
      for (int i = -9; i < 16; ++i) EXPECT_EQ(cells.active_slot(i, j, k), rows.active_slot(i, j, k));
  for (std::size_t r = 0; r < rows.runs().size(); ++r)
    for (int n = 0; n < rows.runs()[r].count; ++n)
      EXPECT_EQ(cells.run(static_cast<std::int32_t>(rows.runs()[r].first + n)), static_cast<int>(r));
}

TEST(Stencils, WeightsArePositiveAndSumToOneBesideWallsToo) {
  // Division by the sum leaves the rounding of up to 343 additions of numbers below 1: 343 * 1.1e-16 < 4e-14.
  const auto rows = box({20, 12, 9}, 2e-4, [](int i, int j, int k) { return i + j > 6 && k > 0; });
  const CellIndex cells(rows);
  for (const double d : {0.7e-4, 1.5e-4, 3.1e-4}) {
    const auto s = stencils_of(cells, places(rows, 500, {4, 4, 0.5}, {19, 11, 8.5}), d);
    EXPECT_TRUE(s.outside().empty());
    for (const Stencil& stencil : s.stencils()) {
      double sum = 0.0;
      for (const StencilEntry& e : s.entries(stencil)) {
        EXPECT_GT(e.weight, 0.0);
        EXPECT_TRUE(rows.is_active(e.slot));
        sum += e.weight;
      }
      EXPECT_NEAR(sum, 1.0, 4e-14);
    }
  }
}

TEST(Stencils, PlaceIsReproducedAwayFromWalls) {
  // sum_j w_j x_j = x: the first moment vanishes; rounding only, 343 terms of size 1e-2 m times 1e-16.
  const auto rows = full_box({30, 30, 30}, 2e-4);
  const CellIndex cells(rows);
  const auto position = places(rows, 200, {8, 8, 8}, {21, 21, 21});
  for (const double d : {0.7e-4, 2.0e-4, 4.4e-4}) {
    const auto s = stencils_of(cells, position, d);
    for (const Stencil& stencil : s.stencils()) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (const StencilEntry& e : s.entries(stencil)) x += e.weight * rows.centre(e.slot);
      EXPECT_LT((x - position[stencil.carrier]).norm(), 1e-15);
    }
  }
}

TEST(Stencils, AirBehindAThinWallTakesNoPart) {
  // A wall one cell thick at i = 10 between two full ducts: Roma's kernel of a carrier at i = 9.4 reaches cell 10 only,
  // but the wide kernel (d = 2 dx, half width 3 dx) reaches beyond it.
  const auto rows = box({21, 9, 9}, 2e-4, [](int i, int, int) { return i != 10; });
  const CellIndex cells(rows);
  const auto s = stencils_of(cells, places(rows, 50, {8.2, 2, 2}, {9.4, 6, 6}), 4e-4);
  for (const Stencil& stencil : s.stencils())
    for (const StencilEntry& e : s.entries(stencil)) EXPECT_LT(rows.cell(e.slot)[0], 10);
}

TEST(Stencils, OnlyCellsThatHangTogetherWithTheHeaviestTakePart) {
  // Random porous blocks against a search cell by cell, for stencils of three cells a direction.
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    std::vector<char> solid(5 * 5 * 5);
    for (char& s : solid) s = random() % 3 == 0;
    const auto rows = box({5, 5, 5}, 2e-4, [&](int i, int j, int k) { return solid[i + 5 * (j + 5 * k)] == 0; });
    const CellIndex cells(rows);
    const auto position = places(rows, 1, {1.6, 1.6, 1.6}, {2.4, 2.4, 2.4}, 100 + round);
    const auto s = stencils_of(cells, position, 1e-4);
    const Eigen::Vector3d at = (position[0] - cells.origin()) / cells.dx();
    std::map<std::array<int, 3>, double> weight;  // of the active cells in reach
    std::array<int, 3> heaviest{};
    double most = -1.0;
    for (int k = 1; k < 4; ++k)
      for (int j = 1; j < 4; ++j)
        for (int i = 1; i < 4; ++i) {
          if (cells.active_slot(i, j, k) < 0) continue;
          const double w = roma(i - at.x()) * roma(j - at.y()) * roma(k - at.z());
          weight[{i, j, k}] = w;
          if (w > most) most = w, heaviest = {i, j, k};
        }
    std::set<std::array<int, 3>> reached;
    std::vector<std::array<int, 3>> todo;
    if (most > 0.0) todo.push_back(heaviest);
    while (!todo.empty()) {
      const auto c = todo.back();
      todo.pop_back();
      if (!weight.count(c) || !reached.insert(c).second) continue;
      for (int d = 0; d < 3; ++d)
        for (int step = -1; step <= 1; step += 2) {
          auto next = c;
          next[d] += step;
          todo.push_back(next);
        }
    }
    std::set<std::int32_t> expected, found;
    for (const auto& c : reached)
      if (weight[c] > 0.0) expected.insert(cells.active_slot(c[0], c[1], c[2]));
    for (const Stencil& stencil : s.stencils())
      for (const StencilEntry& e : s.entries(stencil)) found.insert(e.slot);
    EXPECT_EQ(found, expected) << "round " << round;
  }
}

TEST(Stencils, CarriersWithoutAirInReachAreReported) {
  const auto rows = full_box({10, 10, 10}, 2e-4);
  const CellIndex cells(rows);
  std::vector<Eigen::Vector3d> position = places(rows, 3, {2, 2, 2}, {8, 8, 8});
  position[1].x() += 5e-3;
  position.push_back({std::nan(""), 0.0, 0.0});
  position.push_back({1e300, 0.0, 0.0});
  const auto s = stencils_of(cells, position, 1e-4);
  EXPECT_EQ(s.outside(), (std::vector<int>{1, 3, 4}));
}

TEST(Stencils, PeriodicBoxesWrapAround) {
  const auto rows = full_box({12, 12, 12}, 2e-4, {true, true, true});
  const CellIndex cells(rows);
  // the same carrier seen from the first and from the next period
  std::vector<Eigen::Vector3d> position{rows.origin() + 2e-4 * Eigen::Vector3d(-0.3, 11.4, 5.0)};
  position.push_back(position[0] + 2e-4 * Eigen::Vector3d(12, -12, 24));
  const auto s = stencils_of(cells, position, 1e-4);
  ASSERT_TRUE(s.outside().empty());
  std::array<std::map<int, double>, 2> weights;
  for (const Stencil& stencil : s.stencils())
    for (const StencilEntry& e : s.entries(stencil)) weights[stencil.carrier][e.slot] = e.weight;
  ASSERT_EQ(weights[0].size(), weights[1].size());
  // positions differ by rounding of 1e-2 m / 2e-4 m = 50 cells times 1e-16; weights have slope < 1 (infinite slope does
  // not occur away from the kernel's edge, whose weights are below 1e-7)
  for (const auto& [slot, w] : weights[0]) EXPECT_NEAR(w, weights[1].at(slot), 1e-7);
}

TEST(Stencils, TilesOfOneColourNeverShareACell) {
  for (const std::array<bool, 3> periodic : {std::array{false, false, false}, std::array{true, true, true}}) {
    const auto rows = full_box({10, 41, 22}, 2e-4, periodic);
    const CellIndex cells(rows);
    for (const double d : {1e-4, 3.9e-4}) {
      const auto s = stencils_of(cells, places(rows, 600, {0, 0, 0}, {9, 40.4, 21.4}), d);
      const auto [across, up] = s.tile_counts();
      EXPECT_GT(across * up, 4);
      std::vector<std::set<int>> touched(across * up);
      std::size_t seen = 0;
      for (int t = 0; t < across * up; ++t)
        for (int n = s.tiles()[t]; n < s.tiles()[t + 1]; ++n, ++seen)
          for (const StencilEntry& e : s.entries(s.stencils()[n])) touched[t].insert(e.slot);
      EXPECT_EQ(seen, s.stencils().size());
      for (int a = 0; a < across * up; ++a)
        for (int b = 0; b < a; ++b) {
          const bool one_colour = (a % across - b % across) % 2 == 0 && (a / across - b / across) % 2 == 0;
          if (!one_colour) continue;
          for (const int slot : touched[a]) EXPECT_FALSE(touched[b].count(slot));
        }
    }
  }
}

TEST(Stencils, TheLoopVisitsEveryStencilOnce) {
  for (const std::array<int, 3> size : {std::array{9, 41, 4}, std::array{9, 5, 4}, std::array{4, 4, 30}}) {
    const auto rows = full_box(size, 2e-4);
    const CellIndex cells(rows);
    const auto s = stencils_of(cells, places(rows, 200, {0, 0, 0}, {3, 3, 3}), 1e-4);
    std::vector<int> visits(200, 0);
    for_each_by_tile(s, [&](int, const Stencil& stencil) { ++visits[stencil.carrier]; });
    EXPECT_EQ(visits, std::vector<int>(200, 1));
  }
}

TEST(Stencils, DoNotDependOnWhatWasBuiltBefore) {
  const auto rows = full_box({30, 30, 30}, 2e-4);
  const CellIndex cells(rows);
  const auto first = places(rows, 300, {2, 2, 2}, {27, 27, 27}), second = places(rows, 300, {2, 2, 2}, {27, 27, 27}, 7);
  const std::vector<double> radius(300, 0.5e-4);
  Stencils used, fresh;
  used.build(cells, first, radius, all(300));
  used.build(cells, second, radius, all(300));
  fresh.build(cells, second, radius, all(300));
  ASSERT_EQ(used.tiles(), fresh.tiles());
  for (std::size_t n = 0; n < 300; ++n) EXPECT_EQ(used.stencils()[n].carrier, fresh.stencils()[n].carrier);
}

TEST(Stencils, WhatHasNotMovedIsKeptAndStillRight) {
  // Two sizes, a wall, and each time other carriers that move, change their cell or are not wanted: as if built anew.
  const auto rows = box({30, 20, 20}, 2e-4, [](int i, int j, int) { return i < 12 || j > 6; });
  const CellIndex cells(rows);
  auto position = places(rows, 400, {1, 8, 1}, {28, 18, 18});
  std::vector<double> radius(400, 0.5e-4);
  for (std::size_t p = 0; p < 400; p += 3) radius[p] = 1.6e-4;
  Stencils used;
  for (int round = 0; round < 6; ++round) {
    std::vector<int> wanted;
    for (int p = 0; p < 400; ++p)
      if ((p + round) % 7 != 0 || round < 2) wanted.push_back(p);
    used.build(cells, position, radius, wanted);
    Stencils fresh;
    fresh.build(cells, position, radius, wanted);
    ASSERT_EQ(used.cells(), fresh.cells());
    ASSERT_EQ(used.stencils().size(), fresh.stencils().size());
    std::set<std::int32_t> seen;
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      const Stencil &a = used.stencils()[n], &b = fresh.stencils()[n];
      ASSERT_EQ(a.carrier, b.carrier);
      ASSERT_EQ(a.count, b.count);
      EXPECT_EQ(a.squares, b.squares);
      EXPECT_EQ(a.offset, b.offset);
      for (int e = 0; e < a.count; ++e) {
        ASSERT_EQ(used.entries(a)[e].slot, fresh.entries(b)[e].slot);
        ASSERT_EQ(used.entries(a)[e].weight, fresh.entries(b)[e].weight);
        seen.insert(used.entries(a)[e].slot);
      }
    }
    EXPECT_EQ(used.cells(), std::vector<std::int32_t>(seen.begin(), seen.end()));
    for (std::size_t p = round; p < 400; p += 5) position[p].x() += (p % 2 == 0 ? 1e-6 : -1.7e-4);
    radius[10 * round] = 1.6e-4;
  }
}

TEST(Stencils, AreTheSameForOneAndTwoThreadsAndMarkTheirRuns) {
  const auto rows = box({40, 20, 20}, 2e-4, [](int i, int j, int k) { return i % 13 != 0 || (j + k) % 3 == 0; });
  const CellIndex cells(rows);
  const auto position = places(rows, 3000, {1, 1, 1}, {38, 18, 18});
  std::array<Stencils, 2> s;
  std::array<std::vector<char>, 2> marks;
  for (int n = 0; n < 2; ++n) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, n + 1);
    s[n] = stencils_of(cells, position, 1.5e-4);
    marks[n].assign(cells.run_count(), 0);
    s[n].mark_runs(cells, marks[n]);
  }
  EXPECT_EQ(marks[0], marks[1]);
  std::vector<char> expected(cells.run_count(), 0);
  for (std::size_t n = 0; n < s[0].stencils().size(); ++n) {
    const Stencil &a = s[0].stencils()[n], &b = s[1].stencils()[n];
    ASSERT_EQ(a.carrier, b.carrier);
    ASSERT_EQ(a.count, b.count);
    for (int e = 0; e < a.count; ++e) {
      const StencilEntry &x = s[0].entries(a)[e], &y = s[1].entries(b)[e];
      EXPECT_EQ(x.slot, y.slot);
      EXPECT_EQ(x.weight, y.weight);
      expected[cells.run(x.slot)] = 1;
    }
  }
  EXPECT_EQ(marks[0], expected);
}
}  // namespace
