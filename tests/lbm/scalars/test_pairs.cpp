// Mirrored pairs of sub-steps: five sweeps a b c b a instead of six.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "lbm/scalars/sub_step.hpp"
#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

StepLimit limit_of(const Scene& s, double cfl) {
  std::vector<LimitFound> limits;
  find_limits(s.rows, s.fluxes, s.fluxes.density, cfl, {}, limits);
  return strictest(limits, cfl, {});
}

TEST(Pairs, in_a_uniform_flow_the_slowest_direction_takes_both_steps_at_once) {
  Scene s = make_scene({8, 8, 8}, {true, true, true});
  set_flow(s, [](int d, int, int, int) { return d == 0 ? 0.1 : d == 1 ? 0.02 : -0.08; });
  const StepLimit limit = limit_of(s, 0.8);
  EXPECT_NEAR(limit.steps, 8.0, 1e-12);
  EXPECT_NEAR(limit.pair[0], 8.0, 1e-12);
  EXPECT_NEAR(limit.pair[1], 16.0, 1e-12);
  EXPECT_NEAR(limit.pair[2], 10.0, 1e-12);
}

TEST(Pairs, mind_the_air_that_earlier_sweeps_took_and_brought) {
  // n steps for each half of the jet's pair. Around z, the cells that feed it lose most: 2n 0.2 <= cfl. Around x, of
  // which the middle cell loses 2n 0.2: y has taken 0.2 n before, z has brought 0.4 n: 2n 0.2 <= cfl (1 + 0.2 n);
  // around y likewise.
  const StepLimit limit = limit_of(make_jet(), 0.3);
  EXPECT_NEAR(limit.pair[2], 2.0 * 0.3 / 0.4, 1e-12);
  for (const int c : {0, 1}) EXPECT_NEAR(limit.pair[c], 2.0 * 0.3 / (0.4 - 0.3 * 0.2), 1e-12);
}

TEST(Pairs, are_taken_where_they_save_sweeps) {
  StepLimit flow{5.0, {5.0, 6.0, 10.0}, 1.0};
  const StepsAllowed allowed = allowed_steps(flow, {{{}}}, {0}, 0.0);
  EXPECT_EQ(allowed.single, 5.0);
  EXPECT_EQ(allowed.pair, 10.0);
  EXPECT_FALSE(cut_update(5.0, flow, allowed).middle);  // one sub-step does
  const Cut two = cut_update(10.0, flow, allowed);
  ASSERT_TRUE(two.middle);
  EXPECT_EQ(*two.middle, 2);
  EXPECT_EQ(two.share, 10.0);
  EXPECT_FALSE(cut_update(11.0, flow, allowed).middle);  // 3 sub-steps 10.5, 2 pairs 11
  const Cut four = cut_update(18.0, flow, allowed);
  ASSERT_TRUE(four.middle);
  EXPECT_EQ(four.share, 9.0);

  int directions[5], n = 0;
  double covered[3] = {};
  for (const Stroke& stroke : strokes(two, 10.0, false)) {
    directions[n++] = stroke.direction;
    covered[stroke.direction] += stroke.steps;
  }
  for (const double steps : covered) EXPECT_EQ(steps, 10.0);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(directions[i], directions[4 - i]);
}

TEST(Pairs, are_no_longer_than_explicit_diffusion_allows) {
  const StepLimit flow{5.0, {5.0, 6.0, 10.0}, 1.0};
  // No flow would be left to outrun diffusion: with the rate r = 0.8/10, 4 D n <= (1 - r n)^2 (half of the air, two
  // faces: sub_step.cpp), D = 0.1: n <= 1.75.
  const StepsAllowed allowed = allowed_steps(flow, {{{Scheme::mc, 0.1}}}, {0}, 0.0);
  EXPECT_NEAR(4.0 * 0.1 * allowed.pair, std::pow(1.0 - 0.08 * allowed.pair, 2), 1e-12);
  EXPECT_FALSE(cut_update(10.0, flow, allowed).middle);
}

/// Relative L2 error of a hill after a turn of a ball about a tilted axis, so that all three sweeps carry; `part` of
/// the longest single sub-step an update.
double turned_hill_error(double part, std::int64_t& sub_steps) {
  const int n = 36;
  Scene s = make_scene({n, n, n}, {false, false, false});
  const double turn = 0.1 / 16.0, radius = 17.0, axis[3] = {0.3, 0.4, 0.87};
  const auto from_middle = [](double i) { return i - 0.5 * (n - 1); };
  set_curl(s, [&](int d, int i, int j, int k) {  // on the edge along d
    const double x = from_middle(i + 0.5 * (d != 0)), y = from_middle(j + 0.5 * (d != 1)),
                 z = from_middle(k + 0.5 * (d != 2)), r2 = x * x + y * y + z * z;
    return r2 > radius * radius ? 0.0 : 0.5 * turn * axis[d] * (radius * radius - r2);
  });
  ScalarFields f = s.fields();
  ScalarBudget b = s.budget();
  const auto hill = [&](const std::array<int, 3>& c) {
    const double x = from_middle(c[0]) - 6.0, y = from_middle(c[1]) + 4.0, z = from_middle(c[2]);
    return std::exp(-0.5 * (x * x + y * y + z * z) / 9.0);
  };
  const auto each_cell = [&](auto visit) {
    for (const auto& run : s.rows.runs())
      for (int c = 0; c < run.count; ++c) visit(run.first + c, hill({run.x + c, run.y, run.z}));
  };
  each_cell([&](std::ptrdiff_t slot, double value) { f.amount[0][slot] = value; });
  const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const double before = total(f, 0), time = 2.0 * std::acos(-1.0) / (turn * length);
  const double steps = part * max_steps(s.rows, s.fluxes, 0.8);
  const int updates = static_cast<int>(std::ceil(time / steps));
  for (int m = 0; m < updates; ++m) advance_scalars(s.rows, s.fluxes, time / updates, {{{}}}, f, b);
  EXPECT_NEAR(total(f, 0) / before, 1.0, 1e-12);
  double error = 0.0, norm = 0.0;
  each_cell([&](std::ptrdiff_t slot, double value) {
    EXPECT_GE(f.amount[0][slot], 0.0);
    EXPECT_LE(f.amount[0][slot], 1.0 + 1e-12);
    error += std::pow(f.amount[0][slot] - value, 2);
    norm += value * value;
  });
  sub_steps = b.sub_steps;
  return std::sqrt(error / norm);
}

TEST(Pairs, turn_a_hill_as_well_as_single_sub_steps) {
  // Nearly equal half steps. Each sweep flattens the hill by what its limited slopes miss, and pairs make five where
  // single sub-steps make six, the middle one nearer to a whole cell: they must not be worse.
  std::int64_t singles = 0, pairs = 0;
  const double by_singles = turned_hill_error(0.99, singles), by_pairs = turned_hill_error(1.98, pairs);
  std::cout << "L2 errors: " << by_singles << " with " << singles << " sub-steps, " << by_pairs << " with " << pairs
            << " pairs\n";
  EXPECT_LE(std::abs(2 * pairs - singles), 2);
  EXPECT_LT(by_pairs, by_singles);
  EXPECT_GT(by_singles, 0.05);  // there is an error to compare
}

/// The largest part of its air that leaves a cell in a sweep of a pair around `c`, and the least air between sweeps.
struct Walk {
  double most_out = 0.0, least_air = 1.0;
};
Walk walk(const double (&high)[3], const double (&low)[3], int c, double half) {
  const int a = c == 0 ? 1 : 0, b = c == 2 ? 1 : 2;
  Walk seen;
  double air = 1.0;
  int sweep = 0;
  for (const auto& [d, steps] : {Stroke{a, half}, {b, half}, {c, 2.0 * half}, {b, half}, {a, half}}) {
    const double out = steps * (std::max(high[d], 0.0) + std::max(-low[d], 0.0));
    seen.most_out = std::max(seen.most_out, out / air);
    air -= steps * (high[d] - low[d]);
    if (++sweep < 5) seen.least_air = std::min(seen.least_air, air);
  }
  return seen;
}

TEST(Pairs, allow_just_what_the_sweeps_one_by_one_can_bear) {
  // One cell of a closed box with fluxes through its six faces. Its neighbours gain or lose through one face alone:
  // they are kept out of the limit by a density of 100.
  int by_outflow = 0, by_air = 0;
  for (int n = 0; n < 200; ++n) {
    Scene s = make_scene({3, 3, 3}, {false, false, false});
    std::fill(s.fluxes.density.begin(), s.fluxes.density.end(), 100.0);
    s.fluxes.density[s.at(1, 1, 1)] = 1.0;
    double high[3], low[3];
    for (int d = 0; d < 3; ++d) {
      high[d] = 0.1 * noise(7, n, d, 0, 0);
      low[d] = 0.1 * noise(7, n, d, 1, 0);
      s.fluxes.mass[d][s.at(1, 1, 1)] = high[d];
      s.fluxes.mass[d][s.at(d == 0 ? 0 : 1, d == 1 ? 0 : 1, d == 2 ? 0 : 1)] = low[d];
    }
    const StepLimit limit = limit_of(s, 0.8);
    for (int c = 0; c < 3; ++c) {
      if (limit.pair[c] > 400.0) continue;  // the middle cell allows more than a neighbour
      const Walk seen = walk(high, low, c, 0.5 * limit.pair[c]);
      ASSERT_LE(seen.most_out, 0.8 + 1e-12);
      ASSERT_GE(seen.least_air, 0.5 - 1e-12);
      const bool outflow = seen.most_out > 0.8 - 1e-9, air = seen.least_air < 0.5 + 1e-9;
      ASSERT_TRUE(outflow || air) << "stricter than it need be";
      by_outflow += outflow;
      by_air += air;
    }
  }
  EXPECT_GT(by_outflow, 20);
  EXPECT_GT(by_air, 20);
}

TEST(Pairs, keep_a_constant_concentration) {
  for (const bool single : {false, true}) {
    Scene s = make_scene({24, 20, 16}, {false, true, false});
    set_curl(s, [](int d, int i, int j, int k) { return (d == 2 ? 0.06 : 0.01) * noise(5, d, i, j, k); });
    const StepLimit limit = limit_of(s, 0.8);
    ASSERT_GT(limit.pair[2], 1.2 * limit.steps);
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    for (const auto& run : s.rows.runs()) std::fill_n(f.amount[0].begin() + run.first, run.count, 1.0);
    ScalarOptions o{{{}}};
    o.single = single;
    for (int n = 0; n < 50; ++n) advance_scalars(s.rows, s.fluxes, limit.pair[2], o, f, b);
    EXPECT_EQ(b.sub_steps, 50);  // one pair an update
    for (const auto& run : s.rows.runs())
      for (int i = 0; i < run.count; ++i) ASSERT_NEAR(f.amount[0][run.first + i], 1.0, single ? 1e-6 : 1e-12);
  }
}

}  // namespace
}  // namespace puffin::lbm
