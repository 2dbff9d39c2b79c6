#include "coupling/cell_index.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace puffin::coupling {

CellIndex::CellIndex(const lbm::Rows& rows, const std::vector<std::uint8_t>& fluid)
    : run_count_(rows.runs().size()),
      dx_(rows.dx()),
      origin_(rows.origin()),
      box_(rows.box()),
      periodic_(rows.periodic()) {
  if (rows.slots() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument("more than 2^31 stored cells; use a larger dx");
  rows_.assign(static_cast<std::size_t>(box_[1]) * box_[2], {});
  runs_.assign(rows.slots(), -1);
  const auto row_of = [&](const lbm::Run& run) -> Row& {
    return rows_[run.y + static_cast<std::size_t>(box_[1]) * run.z];
  };
  for (const lbm::Run& run : rows.runs()) {
    Row& row = row_of(run);
    if (row.last == 0) row.first = run.x;
    row.first = std::min(row.first, run.x);
    row.last = std::max(row.last, run.x + run.count);
  }
  std::size_t size = 0;
  for (Row& row : rows_) {
    row.begin = size;
    size += row.last - row.first;
  }
  slots_.assign(size, -1);
  for (std::size_t r = 0; r < run_count_; ++r) {
    const lbm::Run& run = rows.runs()[r];
    const Row& row = row_of(run);
    for (int n = 0; n < run.count; ++n) {
      const auto slot = static_cast<std::int32_t>(run.first + n);
      if (fluid.empty() || fluid[slot] != 0) slots_[row.begin + (run.x + n - row.first)] = slot;
      runs_[slot] = static_cast<std::int32_t>(r);
    }
  }
}

}  // namespace puffin::coupling
