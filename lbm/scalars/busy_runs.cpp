#include "lbm/scalars/busy_runs.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace puffin::lbm {

namespace {

/// Sum of a scalar over each run.
std::vector<double> run_sums(const Rows& rows, const std::vector<double>& amount) {
  std::vector<double> sums(rows.runs().size());
  tbb::parallel_for(std::size_t{0}, rows.chunks().size(), [&](std::size_t c) {
    for (int r = rows.chunks()[c].first_run; r < rows.chunks()[c].last_run; ++r) {
      const Run& run = rows.runs()[r];
      const double* a = amount.data() + run.first;
      double part[4] = {0.0, 0.0, 0.0, 0.0};  // four sums that do not wait for each other
      int i = 0;
      for (; i + 4 <= run.count; i += 4)
        for (int n = 0; n < 4; ++n) part[n] += a[i + n];
      for (; i < run.count; ++i) part[0] += a[i];
      sums[r] = (part[0] + part[1]) + (part[2] + part[3]);
    }
  });
  return sums;
}

double sum_of(const std::vector<double>& sums) {
  double everything = 0.0;
  for (const double s : sums) everything += s;
  return everything;
}

}  // namespace

void mark_moving_scalars(const Rows& rows, const ScalarOptions& options, ScalarFields& fields) {
  fields.work.moving.clear();
  for (int k = 0; k < fields.scalars(); ++k) {
    const auto& fixed = options.scalar[k].fixed;
    const bool brought = std::any_of(fixed.begin(), fixed.end(), [](const auto& v) { return v && *v > 0.0; });
    if (!(options.negligible > 0.0) || brought || sum_of(run_sums(rows, fields.amount[k])) > options.negligible)
      fields.work.moving.push_back(k);
  }
}

bool mark_busy_runs(const Rows& rows, bool all, ScalarFields& fields) {
  ScalarWork& work = fields.work;
  const std::size_t runs = rows.runs().size();
  std::vector<std::uint8_t> busy(runs, all);
  if (!all) {
    for (const int k : work.moving) {
      const std::vector<double> sums = run_sums(rows, fields.amount[k]);
      const double everything = sum_of(sums);
      for (std::size_t r = 0; r < runs; ++r)
        if (sums[r] > 1e-30 * everything) busy[r] = 1;
    }
    for (int sweep = 0; sweep < 3; ++sweep) {
      const int d = fields.reversed ? 2 - sweep : sweep;
      const std::vector<std::uint8_t> before = busy;
      for (std::size_t r = 0; r < runs; ++r)
        if (before[r])
          for (int n = work.neighbour_begin[d][r]; n < work.neighbour_begin[d][r + 1]; ++n)
            busy[work.neighbour_runs[d][n]] = 1;
    }
  }
  const std::size_t slots = rows.slots();
  for (std::size_t r = 0; r < runs; ++r) {
    if (!work.computed[r] || busy[r]) continue;
    for (int k = 0; k < fields.scalars(); ++k)
      for (auto* field : {&work.concentration, &work.out_high, &work.out_low})
        std::fill_n(field->begin() + k * slots + rows.runs()[r].first, rows.runs()[r].count, 0.0);
  }
  work.computed.swap(busy);
  return std::find(work.computed.begin(), work.computed.end(), 1) != work.computed.end();
}

}  // namespace puffin::lbm
