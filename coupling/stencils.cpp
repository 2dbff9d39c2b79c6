#include "coupling/stencils.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

namespace {

constexpr int nowhere =
    std::numeric_limits<int>::min() / 4;  // nearest cell of a carrier that is far away or not finite

int nearest_cell(double cells) { return std::abs(cells) < 1e8 ? static_cast<int>(std::lround(cells)) : nowhere; }

/// Room for one block of cells around a carrier.
struct Block {
  std::vector<std::int32_t> slots;
  std::vector<double> weights;
  std::vector<char> reached;
  std::vector<int> todo;
};

/// Drops the weights of cells that are not connected to the heaviest active cell through active cells of the block.
void keep_connected(int width, Block& block) {
  const int cells = width * width * width;
  int seed = -1;
  for (int n = 0; n < cells; ++n)
    if (block.slots[n] >= 0 && (seed < 0 || block.weights[n] > block.weights[seed])) seed = n;
  block.reached.assign(cells, 0);
  block.todo.clear();
  if (seed >= 0 && block.weights[seed] > 0.0) {
    block.reached[seed] = 1;
    block.todo.push_back(seed);
  }
  while (!block.todo.empty()) {
    const int n = block.todo.back();
    block.todo.pop_back();
    const std::array<int, 3> at{n % width, n / width % width, n / (width * width)};
    const std::array<int, 3> stride{1, width, width * width};
    for (int d = 0; d < 3; ++d)
      for (int step = -1; step <= 1; step += 2) {
        if (at[d] + step < 0 || at[d] + step >= width) continue;
        const int next = n + step * stride[d];
        if (block.slots[next] < 0 || block.reached[next]) continue;
        block.reached[next] = 1;
        block.todo.push_back(next);
      }
  }
  for (int n = 0; n < cells; ++n)
    if (!block.reached[n]) block.weights[n] = 0.0;
}

/// Fills the entries of one carrier; returns their number.
int fill(const CellIndex& cells, const Kernel& kernel, const Eigen::Vector3d& position, Block& block,
         Eigen::Vector3d& offset, StencilEntry* entries) {
  const Eigen::Vector3d at = (position - cells.origin()) / cells.dx();
  const int reach = kernel.reach(), width = 2 * reach + 1;
  std::array<int, 3> base;
  std::array<std::array<double, 2 * Kernel::max_reach + 1>, 3> weight;
  for (int d = 0; d < 3; ++d) {
    base[d] = nearest_cell(at[d]);
    if (base[d] == nowhere) return 0;
    offset[d] = at[d] - base[d];
    kernel.weights(offset[d], weight[d].data());
  }
  block.slots.resize(width * width * width);
  block.weights.resize(width * width * width);
  bool whole = true;
  for (int k = 0, n = 0; k < width; ++k)
    for (int j = 0; j < width; ++j, n += width) {
      whole &= cells.active_slots(base[0] - reach, base[1] + j - reach, base[2] + k - reach, width, &block.slots[n]);
      const double across = weight[1][j] * weight[2][k];
      for (int i = 0; i < width; ++i) block.weights[n + i] = weight[0][i] * across;
    }
  if (!whole) keep_connected(width, block);
  double sum = 0.0;
  for (const double w : block.weights) sum += w;
  if (!(sum > 0.0)) return 0;
  const double scale = 1.0 / sum;
  int count = 0, n = 0;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i, ++n)
        if (block.weights[n] > 0.0)
          entries[count++] = {block.slots[n], static_cast<std::int8_t>(i), static_cast<std::int8_t>(j),
                              static_cast<std::int8_t>(k), block.weights[n] * scale};
  return count;
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
  kernels_.resize(stencils_.size());
  std::size_t room = 0;
  last = -1.0;
  const Kernel* kernel = nullptr;
  for (std::size_t s = 0; s < stencils_.size(); ++s) {
    const double r = radius[stencils_[s].carrier];
    if (r != last) kernel = &kernel_for(2.0 * r / cells.dx());
    last = r;
    kernels_[s] = kernel;
    stencils_[s].begin = room;
    const std::size_t width = 2 * kernel->reach() + 1;
    room += width * width * width;
  }
  if (entries_.size() < room + entries_ahead) entries_.resize(room + entries_ahead);

  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, stencils_.size(), 64), [&](const auto& range) {
    Block block;
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      Stencil& stencil = stencils_[s];
      stencil.count =
          fill(cells, *kernels_[s], position[stencil.carrier], block, stencil.offset, entries_.data() + stencil.begin);
    }
  });

  outside_.clear();
  for (const Stencil& stencil : stencils_)
    if (stencil.count == 0) outside_.push_back(stencil.carrier);
  std::sort(outside_.begin(), outside_.end());
}

void Stencils::mark_runs(const CellIndex& cells, std::vector<char>& touched) const {
  if (touched.size() != cells.run_count()) throw std::invalid_argument("one mark a run is needed");
  for_each_stencil(*this, [&](const Stencil& stencil) {
    std::int32_t last = -1;
    for (const StencilEntry& entry : entries(stencil)) {
      const std::int32_t run = cells.run(entry.slot);
      if (run == last) continue;
      last = run;
      std::atomic_ref<char> mark(touched[run]);
      if (!mark.load(std::memory_order_relaxed)) mark.store(1, std::memory_order_relaxed);
    }
  });
}

}  // namespace puffin::coupling
