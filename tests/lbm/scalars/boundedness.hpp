#pragma once
// Many updates of the scalars in random flow: no new extremum, nothing lost.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "lbm/scalars/sub_step.hpp"
#include "tests/lbm/scalars/scene.hpp"
#include "tests/sanitized.hpp"

namespace puffin::lbm {

/// Random flow at cell Peclet number 1e4, in sub-steps alone and in mirrored pairs.
inline void stay_bounded(int updates) {
  const auto is_air = [](int i, int j, int k) { return !(i > 5 && i < 9 && j > 4) || k < 2; };
  Scene s = make_scene({18, 12, 8}, {true, false, false}, false, is_air);
  std::vector<FaceFluxes> flows;
  for (int n = 0; n < 16; ++n) {
    set_curl(s, [n](int d, int i, int j, int k) { return 0.05 * noise(100 + n, d, i, j, k); });
    flows.push_back(s.fluxes);
  }
  struct Kind {
    Scheme scheme;
    bool single;
  };
  for (const auto [scheme, single] : {Kind{Scheme::mc, false}, {Scheme::van_leer, false}, {Scheme::mc, true}}) {
    ScalarFields f = s.fields();
    ScalarBudget b = s.budget();
    for (const auto& run : s.rows.runs())
      for (int i = 0; i < run.count; ++i) f.amount[0][run.first + i] = run.x + i < 9;
    const double start = total(f, 0);
    ScalarOptions o{{{scheme, 0.1 / 1e4}}};
    o.single = single;
    double least = 0.0, most = 1.0;
    int in_pairs = 0;
    for (int n = 0; n < updates; ++n) {
      // Every now and then a fresh spike, as a source would make it.
      const std::ptrdiff_t spike = s.at(n % 5, n % 11, n % 8);
      const double held = f.amount[0][spike];
      if (n % 50 == 0) f.amount[0][spike] = n % 100 ? 0.0 : 1.0;
      const double given = f.amount[0][spike] - held;
      const double steps = 2.0 + 6.0 * std::abs(noise(1, n, 0, 0, 0));
      in_pairs += pieces_of(steps, advance_scalars(s.rows, flows[n * 7 % 16], steps, o, f, b)).pairs;
      b.left[0][0].add(-given);  // the ledger of the test
      for (const auto& run : s.rows.runs())
        for (int i = 0; i < run.count; ++i) {
          least = std::min(least, f.amount[0][run.first + i]);
          most = std::max(most, f.amount[0][run.first + i]);
        }
    }
    // Beyond 1 by rounding alone. In a sweep a cell's value passes fewer than 30 roundings of at most one unit u each:
    // what leaves and what comes four each (steps, flux, air, value), the sums four, what is stored three; those of
    // what leaves count 1.6 times, as at most 0.8 of the air leaves and at least half is left. Independent errors add
    // up to more than lambda u sqrt(n) after n roundings, or at any time before, with a probability of at most
    // exp(-lambda^2/2) (Hoeffding; N. J. Higham & T. Mary, SIAM J. Sci. Comput. 41, A2815 (2019)): lambda = 7 makes
    // 4e-8 of the 1,600 cells. Never below 0: of what is there at most 0.8 leaves.
    const double unit = single ? 0x1p-24 : 0x1p-53;
    EXPECT_GE(least, 0.0);
    EXPECT_LE(most, 1.0 + 7.0 * unit * std::sqrt(30.0 * 5.0 * static_cast<double>(b.sub_steps)));
    EXPECT_NEAR((total(f, 0) + gone(b, 0)) / start, 1.0, 1e-12);
    EXPECT_GT(in_pairs, updates / 4);
    EXPECT_LT(in_pairs, updates * 3 / 4);
    std::cout << updates << " updates, " << b.sub_steps << " sub-steps or pairs: from " << least << " to 1 + "
              << most - 1.0 << ", ledger " << (total(f, 0) + gone(b, 0)) / start - 1.0 << '\n';
  }
}

}  // namespace puffin::lbm
