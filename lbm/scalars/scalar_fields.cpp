#include "lbm/scalars/scalar_fields.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lbm/scalars/run_faces.hpp"

namespace puffin::lbm {

namespace {

using Pair = std::array<std::ptrdiff_t, 2>;

/// The active cell that a stored slot stands for: itself, the cell it mirrors, or -1.
std::vector<std::ptrdiff_t> cells_stood_for(const Rows& rows) {
  std::vector<std::ptrdiff_t> cell(rows.slots(), -1);
  for (std::size_t s = 0; s < rows.slots(); ++s)
    if (rows.is_active(s)) cell[s] = s;
  for (const auto& [ghost, image] : rows.periodic_images()) cell[ghost] = image;
  return cell;
}

void find_faces(const Rows& rows, const std::vector<std::ptrdiff_t>& cell, ScalarWork& work) {
  const auto& runs = rows.runs();
  work.run_of.assign(rows.slots(), -1);
  for (std::size_t r = 0; r < runs.size(); ++r)
    std::fill_n(work.run_of.begin() + runs[r].first, runs[r].count, static_cast<std::int32_t>(r));
  std::vector<int> chunk_of(runs.size());
  for (std::size_t c = 0; c < rows.chunks().size(); ++c)
    for (int r = rows.chunks()[c].first_run; r < rows.chunks()[c].last_run; ++r) chunk_of[r] = static_cast<int>(c);
  for (int d = 0; d < 3; ++d) {
    work.neighbour_begin[d].assign(1, 0);
    work.local[d].assign(runs.size(), 1);
    for (std::size_t r = 0; r < runs.size(); ++r) {
      std::vector<std::int32_t> found;
      for (int i = 0; i < runs[r].count; ++i)
        for (const bool high : {false, true}) {
          const std::ptrdiff_t s = runs[r].first + i;
          const std::ptrdiff_t beside = s + (high ? offset_high(runs[r], d) : offset_low(runs[r], d));
          if (cell[beside] >= 0) {
            found.push_back(work.run_of[cell[beside]]);
            if (chunk_of[found.back()] != chunk_of[r]) work.local[d][r] = 0;
          }
          if (rows.is_active(beside)) continue;
          if (cell[beside] >= 0)
            work.periodic[d].push_back({beside, cell[beside]}), work.local[d][r] = 0;
          else if (work.opening_patch[beside] >= 0)
            work.openings[d].push_back({s, beside, work.opening_patch[beside], high}), work.local[d][r] = 0;
        }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      std::erase(found, static_cast<std::int32_t>(r));
      work.neighbour_runs[d].insert(work.neighbour_runs[d].end(), found.begin(), found.end());
      work.neighbour_begin[d].push_back(static_cast<std::int32_t>(work.neighbour_runs[d].size()));
    }
    auto& periodic = work.periodic[d];
    std::sort(periodic.begin(), periodic.end());
    periodic.erase(std::unique(periodic.begin(), periodic.end()), periodic.end());
  }
}

/// Maximal chains of neighbouring cells in direction d. A chain without an end (periodic) starts anywhere and is
/// marked.
void find_lines(const Rows& rows, const std::vector<std::ptrdiff_t>& cell, ScalarWork& work) {
  const auto& runs = rows.runs();
  for (int d = 0; d < 3; ++d) {
    const auto beside = [&](std::ptrdiff_t s, bool high) {
      const Run& run = runs[work.run_of[s]];
      return cell[s + (high ? offset_high(run, d) : offset_low(run, d))];
    };
    std::vector<std::uint8_t> done(rows.slots(), 0);
    auto& slots = work.line_slots[d];
    work.line_begin[d].assign(1, 0);
    for (const bool rings : {false, true})  // chains with a first cell, then what is left: rings
      for (const Run& run : runs)
        for (int i = 0; i < run.count; ++i) {
          const std::ptrdiff_t first = run.first + i;
          if (done[first] || (!rings && beside(first, false) >= 0)) continue;
          for (std::ptrdiff_t s = first; s >= 0 && !done[s]; s = beside(s, true)) {
            done[s] = 1;
            slots.push_back(static_cast<std::int32_t>(s));
          }
          work.line_begin[d].push_back(static_cast<std::int32_t>(slots.size()));
          work.line_closes[d].push_back(rings);
        }
  }
}

}  // namespace

ScalarBudget::ScalarBudget(const Rows& rows, int scalars, int patches)
    : left(scalars, std::vector<CompensatedSum>(patches)),
      entered(scalars, std::vector<CompensatedSum>(patches)),
      absorbed_at(scalars, std::vector<double>(rows.slots(), 0.0)) {}

ScalarFields::ScalarFields(const Rows& rows, int scalars, const std::vector<int>& opening_patch)
    : amount(scalars, std::vector<double>(rows.slots(), 0.0)), air(rows.slots(), 0.0) {
  if (scalars < 0) throw std::invalid_argument("the number of scalars is negative");
  if (!opening_patch.empty() && opening_patch.size() != rows.slots())
    throw std::invalid_argument("opening_patch has " + std::to_string(opening_patch.size()) +
                                " entries, the rows have " + std::to_string(rows.slots()) + " slots");
  const auto cell = cells_stood_for(rows);
  work.opening_patch = opening_patch.empty() ? std::vector<int>(rows.slots(), -1) : opening_patch;
  find_faces(rows, cell, work);
  find_lines(rows, cell, work);
  work.computed.assign(rows.runs().size(), 0);
}

double total(const ScalarFields& fields, int scalar) {
  CompensatedSum sum;
  for (const double a : fields.amount.at(scalar)) sum.add(a);
  return sum.value();
}

double absorbed(const ScalarBudget& budget, int scalar) {
  CompensatedSum sum;
  for (const double a : budget.absorbed_at.at(scalar)) sum.add(a);
  return sum.value();
}

double gone(const ScalarBudget& budget, int scalar) {
  CompensatedSum sum;
  for (const auto& patch : budget.left.at(scalar)) sum.add(patch.value());
  for (const auto& patch : budget.entered.at(scalar)) sum.add(-patch.value());
  sum.add(absorbed(budget, scalar));
  return sum.value();
}

}  // namespace puffin::lbm
