#include "coupling/stencils.hpp"

#include "coupling/cut_stencil.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace puffin::coupling {

namespace {

constexpr int nowhere =
    std::numeric_limits<int>::min() / 4;  // nearest cell of a carrier that is far away or not finite

int nearest_cell(double cells) { return std::abs(cells) < 1e8 ? static_cast<int>(std::lround(cells)) : nowhere; }

using Weights = std::array<std::array<double, 2 * Kernel::max_reach + 1>, 3>;  // by direction

/// Every cell of the block is active: its entries are the products of the weights.
void fill_whole(int reach, const Weights& weight, const Block& block, Stencil& stencil, StencilEntry* entries) {
  int n = 0;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j) {
      const double across = weight[1][j + reach] * weight[2][k + reach];
      for (int i = -reach; i <= reach; ++i, ++n) {
        const double part = weight[0][i + reach] * across;
        if (!(part > 0.0)) continue;
        entries[stencil.count++] = {block.slots[n], static_cast<std::int8_t>(i), static_cast<std::int8_t>(j),
                                    static_cast<std::int8_t>(k), part};
        stencil.squares += part * part;
      }
    }
}

/// Fills the entries and shifts of one carrier.
void fill(const CellIndex& cells, const Kernel& kernel, const Eigen::Vector3d& position, Block& block, Stencil& stencil,
          StencilEntry* entries, std::vector<Shift>& shifts) {
  shifts.clear();
  stencil.count = 0;
  stencil.squares = 0.0;
  const Eigen::Vector3d at = (position - cells.origin()) / cells.dx();
  const int reach = kernel.reach(), width = 2 * reach + 1;
  std::array<int, 3> base;
  Weights weight;
  for (int d = 0; d < 3; ++d) {
    base[d] = nearest_cell(at[d]);
    if (base[d] == nowhere) return;
    stencil.offset[d] = at[d] - base[d];
    kernel.weights(stencil.offset[d], weight[d].data());
  }
  block.slots.resize(width * width * width);
  bool whole = true;
  for (int k = 0, n = 0; k < width; ++k)
    for (int j = 0; j < width; ++j, n += width)
      whole &= cells.active_slots(base[0] - reach, base[1] + j - reach, base[2] + k - reach, width, &block.slots[n]);
  if (whole) {  // away from walls: the weights sum to 1 as they are
    fill_whole(reach, weight, block, stencil, entries);
    return;
  }
  block.weights.resize(width * width * width);
  for (int k = 0, n = 0; k < width; ++k)
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < width; ++i, ++n) block.weights[n] = weight[0][i] * weight[1][j] * weight[2][k];
  keep_connected(width, block);
  double sum = 0.0;
  for (const double w : block.weights) sum += w;
  if (!(sum > 0.0)) return;
  const double scale = 1.0 / sum;
  int n = 0;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i, ++n) {
        if (!(block.weights[n] > 0.0)) continue;
        const double part = block.weights[n] * scale;
        entries[stencil.count++] = {block.slots[n], static_cast<std::int8_t>(i), static_cast<std::int8_t>(j),
                                    static_cast<std::int8_t>(k), part};
        stencil.squares += part * part;
      }
  find_shifts(cells, base, stencil.offset, reach, {entries, static_cast<std::size_t>(stencil.count)}, block, shifts);
}

}  // namespace

const Kernel& Stencils::kernel_for(double diameter_in_cells) {
  const double key = diameter_in_cells <= 1.0 ? 0.0 : diameter_in_cells;  // all small carriers share Roma's kernel
  const auto found = known_kernels_.find(key);
  return found != known_kernels_.end() ? found->second : known_kernels_.emplace(key, Kernel(key)).first->second;
}

namespace {

/// Sorts what is nearly sorted in linear time, and anything else as std::sort does. The order is total: one result.
template <class T>
void sort_nearly_sorted(std::vector<T>& items) {
  std::size_t moves = 0;
  for (std::size_t n = 1; n < items.size(); ++n) {
    const T item = items[n];
    std::size_t to = n;
    for (; to > 0 && item < items[to - 1]; --to, ++moves) items[to] = items[to - 1];
    items[to] = item;
    if (moves > 4 * items.size()) return std::sort(items.begin(), items.end());
  }
}

}  // namespace

void Stencils::sort_into_tiles(const CellIndex& cells, std::span<const Eigen::Vector3d> position,
                               std::span<const int> carriers, int reach) {
  const auto box = cells.box();
  // Even numbers of tiles, so that the first and the last of a periodic direction differ in colour.
  const int width = 2 * reach + 1;
  for (int d = 0; d < 2; ++d) tile_counts_[d] = std::max(1, 2 * (box[d + 1] / (2 * width)));
  if (!std::equal(carriers.begin(), carriers.end(), carriers_.begin(), carriers_.end())) {
    carriers_.assign(carriers.begin(), carriers.end());
    order_.resize(carriers_.size());
    for (std::size_t n = 0; n < carriers_.size(); ++n) order_[n].carrier = carriers_[n];
  }
  for (Place& place : order_) {
    const Eigen::Vector3d at = (position[place.carrier] - cells.origin()) / cells.dx();
    std::array<std::int64_t, 3> cell;
    for (int d = 0; d < 3; ++d) {
      int c = nearest_cell(at[d]);
      if (cells.periodic()[d] && c != nowhere) c = (c % box[d] + box[d]) % box[d];
      cell[d] = std::clamp(c, 0, box[d] - 1);
    }
    const std::int64_t tile =
        cell[1] * tile_counts_[0] / box[1] + tile_counts_[0] * (cell[2] * tile_counts_[1] / box[2]);
    place.key = ((tile * box[2] + cell[2]) * box[1] + cell[1]) * box[0] + cell[0];
  }
  sort_nearly_sorted(order_);
  const int count = tile_counts_[0] * tile_counts_[1];
  tiles_.assign(count + 1, 0);
  stencils_.resize(order_.size());
  const std::int64_t keys_a_tile = static_cast<std::int64_t>(box[0]) * box[1] * box[2];
  for (std::size_t n = 0; n < order_.size(); ++n) {
    stencils_[n].carrier = order_[n].carrier;
    ++tiles_[order_[n].key / keys_a_tile + 1];
  }
  for (int t = 0; t < count; ++t) tiles_[t + 1] += tiles_[t];
}

void Stencils::build(const CellIndex& cells, std::span<const Eigen::Vector3d> position, std::span<const double> radius,
                     std::span<const int> carriers) {
  int reach = 1;
  double last = -1.0;
  for (const int carrier : carriers) {
    if (radius[carrier] == last) continue;
    last = radius[carrier];
    reach = std::max(reach, kernel_for(2.0 * last / cells.dx()).reach());
  }
  sort_into_tiles(cells, position, carriers, reach);
  made_.resize(stencils_.size());
  shifts_.resize(stencils_.size());
  kernels_.resize(stencils_.size());
  std::size_t room = 0;
  last = -1.0;
  const Kernel* kernel = nullptr;
  for (std::size_t s = 0; s < stencils_.size(); ++s) {
    const std::int32_t carrier = stencils_[s].carrier;
    if (radius[carrier] != last) kernel = &kernel_for(2.0 * radius[carrier] / cells.dx());
    last = radius[carrier];
    Made& made = made_[s];
    const bool stays = made.carrier == carrier && made.begin == room && made.diameter == kernel->diameter_in_cells() &&
                       made.position == position[carrier];
    made = {carrier, kernel->diameter_in_cells(), position[carrier], room};
    kernels_[s] = stays ? nullptr : kernel;
    stencils_[s].begin = room;
    const std::size_t width = 2 * kernel->reach() + 1;
    room += width * width * width;
  }
  if (entries_.size() < room) entries_.resize(room);

  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, stencils_.size(), 64), [&](const auto& range) {
    Block block;
    for (std::size_t s = range.begin(); s != range.end(); ++s)
      if (kernels_[s] != nullptr)
        fill(cells, *kernels_[s], made_[s].position, block, stencils_[s], entries_.data() + made_[s].begin, shifts_[s]);
  });

  outside_.clear();
  for (const Stencil& stencil : stencils_)
    if (stencil.count == 0) outside_.push_back(stencil.carrier);
  std::sort(outside_.begin(), outside_.end());
  find_cells(cells.slots());
}

/// Marks every cell in a bit field, then reads it in order.
void Stencils::find_cells(std::size_t slots) {
  marks_.resize(slots / 64 + 2, 0);
  std::size_t first = marks_.size(), last = 0;
  const auto mark = [&](std::int32_t slot) {
    const std::size_t word = static_cast<std::size_t>(slot) / 64;
    marks_[word] |= std::uint64_t{1} << (slot % 64);
    first = std::min(first, word), last = std::max(last, word + 1);
  };
  for (const Stencil& stencil : stencils_)
    for (const StencilEntry& e : entries(stencil)) mark(e.slot);
  for (const auto& shifts : shifts_)
    for (const Shift& shift : shifts) mark(shift.slot);
  used_.clear();
  for (std::size_t word = first; word < last; ++word)
    for (std::uint64_t left = std::exchange(marks_[word], 0); left != 0; left &= left - 1)
      used_.push_back(static_cast<std::int32_t>(64 * word) + std::countr_zero(left));
}

void Stencils::mark_runs(const CellIndex& cells, std::vector<char>& touched) const {
  if (touched.size() != cells.run_count()) throw std::invalid_argument("one mark a run is needed");
  for (const std::int32_t slot : used_) touched[cells.run(slot)] = 1;
}

}  // namespace puffin::coupling
