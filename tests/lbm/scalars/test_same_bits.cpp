#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "lbm/kernel.hpp"
#include "lbm/scalars/sweep.hpp"
#include "tests/lbm/scalars/scene.hpp"

namespace puffin::lbm {
namespace {

class SameBitsIn : public testing::TestWithParam<bool> {};  // single: in float
INSTANTIATE_TEST_SUITE_P(Numbers, SameBitsIn, testing::Bool());

TEST_P(SameBitsIn, for_any_number_of_threads) {
  std::vector<std::vector<double>> first;
  double left = 0.0;
  for (const int threads : {1, 2, 5}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Scene s = make_scene({50, 40, 12}, {false, false, false}, true);  // several chunks
    set_curl(s, [](int d, int i, int j, int k) { return 0.03 * noise(1, d, i, j, k); });
    for (auto& m : s.fluxes.mass[0]) m += 0.05;
    ScalarFields f = s.fields(3);
    ScalarBudget b = s.budget(3);
    ScalarOptions o{{{Scheme::mc, 1e-4}, {Scheme::van_leer, 0.5}, {Scheme::upwind, 0.3, WallRule::absorb}}};
    o.single = GetParam();
    for (int n = 0; n < 12; ++n) {
      for (int k = 0; k < 3; ++k) f.amount[k][s.at(20 + n % 3, 20, 6)] += 1.0 / 3.0;
      advance_scalars(s.rows, s.fluxes, 7.0, o, f, b);
    }
    if (first.empty()) {
      first = f.amount;
      left = gone(b, 0) + gone(b, 1) + gone(b, 2);
      EXPECT_GT(s.rows.chunks().size(), 3u);
    } else {
      EXPECT_EQ(f.amount, first) << threads;
      EXPECT_EQ(gone(b, 0) + gone(b, 1) + gone(b, 2), left) << threads;
    }
  }
}

TEST(SameBits, for_every_instruction_set) {
  // Lengths around the width of a register; what lies beyond the run (Rows::padding) may be read but is not written.
  for (const int n : {1, 2, 3, 5, 7, 8, 9, 15, 22, 137}) {
    const int slots = n + 1 + Rows::padding;
    std::vector<double> mass(slots), air(slots), amount(slots), y(slots), eddy(slots);
    std::vector<std::uint8_t> open(slots);
    for (int i = 0; i < slots; ++i) {
      mass[i] = 0.2 * noise(1, i, 0, 0, 0);
      air[i] = 1.0 + 0.1 * noise(2, i, 0, 0, 0);
      amount[i] = 1.0 + noise(3, i, 0, 0, 0);
      y[i] = amount[i] / air[i];
      open[i] = static_cast<std::uint8_t>(3.0 * (0.5 + 0.49 * noise(4, i, 0, 0, 0)));
      eddy[i] = 1e-3 * (1.0 + noise(5, i, 0, 0, 0));
    }
    const auto result = [&]<class Real>(Real, const SweepKernel& kernel, Scheme scheme, bool eddies) {
      std::vector<double> a = air, c = amount, all;
      const std::vector<Real> y_before(y.begin(), y.end());
      std::vector<Real> conc = y_before, high(slots), low(slots);
      const SweepRun run{
          n, -1, 1, mass.data() + 1, open.data() + 1, 3.0, a.data() + 1, eddies ? eddy.data() + 1 : nullptr};
      const SweepScalar<Real> scalar{scheme,          1e-3,          dust, c.data() + 1, conc.data() + 1,
                                     high.data() + 1, low.data() + 1};
      kernel.of<Real>().outgoing(run, &scalar, 1);
      kernel.of<Real>().update(run, &scalar, 1);
      for (int i = n + 1; i < slots; ++i) {
        EXPECT_EQ(a[i], air[i]);
        EXPECT_EQ(c[i], amount[i]);
        EXPECT_EQ(conc[i], y_before[i]);
        EXPECT_EQ(high[i], 0.0);
        EXPECT_EQ(low[i], 0.0);
      }
      for (const auto* v : {&a, &c}) all.insert(all.end(), v->begin(), v->end());
      for (const auto* v : {&conc, &high, &low}) all.insert(all.end(), v->begin(), v->end());
      std::vector<Real> poor(slots);  // one cell in two rests
      const SweepScalar<Real> resting{scheme, 0.0, 1.0, c.data() + 1, poor.data() + 1};
      kernel.of<Real>().concentrate(n, a.data() + 1, &resting, 1);
      all.insert(all.end(), poor.begin(), poor.end());
      for (int i = n + 1; i < slots; ++i) EXPECT_EQ(poor[i], 0.0);
      const Content content = kernel.content(n, c.data() + 1);
      all.insert(all.end(), {content.sum, content.most, kernel.mismatch(n, a.data() + 1, air.data() + 1)});
      const double* faces = mass.data() + 1;
      const LimitRun limits{n, {faces, faces, faces}, {&open[1], &open[1], &open[1]}, {-1, -1, -1}, &air[1], 0.8};
      const LimitFound found = kernel.limit(limits);
      all.insert(all.end(), {found.demand, found.least_air, found.pair[0], found.pair[1], found.pair[2]});
      return all;
    };
    std::vector<SweepKernel> kernels{baseline_sweep(), select_sweep()};
    if (detect_isa() == Isa::avx512 && avx2_sweep().limit) kernels.push_back(avx2_sweep());
    for (const Scheme scheme : {Scheme::upwind, Scheme::minmod, Scheme::van_leer, Scheme::mc})
      for (const bool eddies : {false, true})
        for (std::size_t k = 1; k < kernels.size(); ++k) {
          EXPECT_EQ(result(1.0, kernels[k], scheme, eddies), result(1.0, kernels[0], scheme, eddies))
              << n << " cells, kernel " << k;
          EXPECT_EQ(result(1.0f, kernels[k], scheme, eddies), result(1.0f, kernels[0], scheme, eddies))
              << n << " cells, kernel " << k;
        }
  }
}

}  // namespace
}  // namespace puffin::lbm
