#include "lbm/scalars/busy_runs.hpp"

#include <algorithm>

namespace puffin::lbm {

namespace {

double sum_of(const std::vector<Content>& contents) {
  double everything = 0.0;
  for (const Content& c : contents) everything += c.sum;
  return everything;
}

}  // namespace

std::vector<double> find_resting(const RunContents& contents) {
  std::vector<double> resting;
  for (const auto& of_scalar : contents) resting.push_back(std::max(dust, resting_part * sum_of(of_scalar)));
  return resting;
}

void mark_moving_scalars(const ScalarOptions& options, const RunContents& contents, ScalarFields& fields) {
  fields.work.moving.clear();
  for (int k = 0; k < fields.scalars(); ++k) {
    const auto& fixed = options.scalar[k].fixed;
    const bool brought = std::any_of(fixed.begin(), fixed.end(), [](const auto& v) { return v && *v > 0.0; });
    if (!(options.negligible > 0.0) || brought || sum_of(contents[k]) > options.negligible)
      fields.work.moving.push_back(k);
  }
}

bool mark_busy_runs(const Rows& rows, bool all, const RunContents& contents, const std::vector<double>& resting,
                    const std::vector<Stroke>& sweeps, ScalarFields& fields) {
  ScalarWork& work = fields.work;
  const std::size_t runs = rows.runs().size();
  std::vector<std::uint8_t> busy(runs, all);
  if (!all) {
    for (const int k : work.moving)
      for (std::size_t r = 0; r < runs; ++r)
        if (contents[k][r].most > resting[k]) busy[r] = 1;
    for (const Stroke& sweep : sweeps) {
      const int d = sweep.direction;
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
    const auto clear = [&](auto& scratch) {
      for (auto* field : {&scratch.concentration, &scratch.out_high, &scratch.out_low})
        for (std::size_t first = rows.runs()[r].first; first < field->size(); first += slots)
          std::fill_n(field->begin() + static_cast<std::ptrdiff_t>(first), rows.runs()[r].count, 0);
    };
    clear(work.narrow);
    clear(work.wide);
  }
  work.computed.swap(busy);
  return std::find(work.computed.begin(), work.computed.end(), 1) != work.computed.end();
}

}  // namespace puffin::lbm
