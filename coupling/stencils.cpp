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
  int n = 0;
  for (int k = 0; k < width; ++k)
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < width; ++i, ++n) {
        block.slots[n] = cells.active_slot(base[0] + i - reach, base[1] + j - reach, base[2] + k - reach);
        block.weights[n] = weight[0][i] * (weight[1][j] * weight[2][k]);
        whole = whole && block.slots[n] >= 0;
      }
  if (!whole) keep_connected(width, block);
  double sum = 0.0;
  for (const double w : block.weights) sum += w;
  if (!(sum > 0.0)) return 0;
  int count = 0;
  n = 0;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i, ++n)
        if (block.weights[n] > 0.0)
          entries[count++] = {block.slots[n], static_cast<std::int8_t>(i), static_cast<std::int8_t>(j),
                              static_cast<std::int8_t>(k), block.weights[n] / sum};
  return count;
}

}  // namespace

const Kernel& Stencils::kernel_for(double diameter_in_cells) {
  const double key = diameter_in_cells <= 1.0 ? 0.0 : diameter_in_cells;  // all small carriers share Roma's kernel
  const auto found = known_kernels_.find(key);
  return found != known_kernels_.end() ? found->second : known_kernels_.emplace(key, Kernel(key)).first->second;
}

void Stencils::sort_into_slabs(const CellIndex& cells, std::span<const Eigen::Vector3d> position,
                               std::span<const int> carriers, int reach) {
  const auto box = cells.box();
  const int axis = static_cast<int>(std::max_element(box.begin(), box.end()) - box.begin());
  // An even number of slabs, so that the first and the last of a periodic box differ in parity.
  const int count = std::max(1, 2 * (box[axis] / (2 * (2 * reach + 1))));
  const auto slab = [&](int carrier) {
    int cell = nearest_cell((position[carrier][axis] - cells.origin()[axis]) / cells.dx());
    if (cells.periodic()[axis]) cell = (cell % box[axis] + box[axis]) % box[axis];
    return static_cast<int>(static_cast<std::int64_t>(std::clamp(cell, 0, box[axis] - 1)) * count / box[axis]);
  };
  slabs_.assign(count + 1, 0);
  for (const int carrier : carriers) ++slabs_[slab(carrier) + 1];
  for (int s = 0; s < count; ++s) slabs_[s + 1] += slabs_[s];
  std::vector<int> next(slabs_.begin(), slabs_.end() - 1);
  stencils_.resize(carriers.size());
  for (const int carrier : carriers) stencils_[next[slab(carrier)]++].carrier = carrier;
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
  sort_into_slabs(cells, position, carriers, reach);
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
  if (entries_.size() < room) entries_.resize(room);

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
