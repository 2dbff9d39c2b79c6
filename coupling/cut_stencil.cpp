#include "coupling/cut_stencil.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace puffin::coupling {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double flat = 1e-3;  // [cells^2] a variance of places in which no gradient is sought

/// Bits of the cells that are connected to `seed` through faces, all among `active`, in a block of 3 x 3 x 3.
std::uint32_t connected(std::uint32_t active, std::uint32_t seed) {
  constexpr std::uint32_t x0 = 0b001001001001001001001001001, x2 = x0 << 2;  // cells with x = 0, x = 2
  constexpr std::uint32_t y0 = 0b000000111000000111000000111, y2 = y0 << 6;  // rows with y = 0, y = 2
  for (std::uint32_t reached = seed, before = 0; true; reached = reached & active) {
    if (reached == before) return reached;
    before = reached;
    reached |= (reached & ~x2) << 1 | (reached & ~x0) >> 1 | (reached & ~y2) << 3 | (reached & ~y0) >> 3 |
               reached << 9 | reached >> 9;
  }
}

}  // namespace

void keep_connected(int width, Block& block, int seed) {
  const int cells = width * width * width;
  const bool asked_for_heaviest = seed < 0;
  for (int n = 0; n < cells && asked_for_heaviest; ++n)
    if (block.slots[n] >= 0 && (seed < 0 || block.weights[n] > block.weights[seed])) seed = n;
  if (width == 3) {
    std::uint32_t active = 0;
    for (int n = 0; n < cells; ++n) active |= static_cast<std::uint32_t>(block.slots[n] >= 0) << n;
    const bool any = seed >= 0 && block.weights[seed] > 0.0;
    const std::uint32_t reached = any ? connected(active, std::uint32_t{1} << seed) : 0;
    for (int n = 0; n < cells; ++n)
      if ((reached >> n & 1) == 0) block.weights[n] = 0.0;
    return;
  }
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

namespace {

Vector3d place_of(const StencilEntry& e) { return {double(e.x), double(e.y), double(e.z)}; }

/// C^-1 way, where C is flat in no direction.
bool solve(const Matrix3d& second, const Vector3d& way, Vector3d& slope) {
  Eigen::SelfAdjointEigenSolver<Matrix3d> directions;
  directions.computeDirect(second, Eigen::EigenvaluesOnly);
  if (directions.eigenvalues()[0] < flat) return false;
  slope = second.ldlt().solve(way);
  return true;
}

/// C^-1 way in the directions in which C is not flat.
Vector3d solve_where_not_flat(const Matrix3d& second, const Vector3d& way) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> directions(second);
  Vector3d slope = Vector3d::Zero();
  for (int d = 0; d < 3; ++d) {
    const Vector3d e = directions.eigenvectors().col(d);
    if (directions.eigenvalues()[d] >= flat) slope += e.dot(way) / directions.eigenvalues()[d] * e;
  }
  return slope;
}

/// The block one cell wider than the stencil, its weights falling linearly to 0 beyond its edge, connected to the
/// heaviest cell of the stencil. Returns their sum.
double widen(const CellIndex& cells, const std::array<int, 3>& base, const Vector3d& offset, int reach,
             std::span<const StencilEntry> entries, Block& block) {
  const int width = 2 * reach + 1;
  const auto tent = [&](int d, int cell) { return 1.0 - std::abs(cell - reach - offset[d]) / (reach + 1.0); };
  block.slots.resize(width * width * width);
  block.weights.resize(width * width * width);
  int n = 0;
  for (int k = 0; k < width; ++k)
    for (int j = 0; j < width; ++j) {
      cells.active_slots(base[0] - reach, base[1] + j - reach, base[2] + k - reach, width, &block.slots[n]);
      for (int i = 0; i < width; ++i, ++n)
        block.weights[n] = block.slots[n] < 0
                               ? 0.0
                               : std::max(tent(0, i), 0.0) * std::max(tent(1, j), 0.0) * std::max(tent(2, k), 0.0);
    }
  const StencilEntry* heaviest = &entries.front();
  for (const StencilEntry& e : entries)
    if (e.weight > heaviest->weight) heaviest = &e;
  keep_connected(width, block, heaviest->x + reach + width * (heaviest->y + reach + width * (heaviest->z + reach)));
  double sum = 0.0;
  for (const double v : block.weights) sum += v;
  return sum;
}

}  // namespace

void find_shifts(const CellIndex& cells, const std::array<int, 3>& base, const Vector3d& offset, int reach,
                 std::span<const StencilEntry> entries, Block& block, std::vector<Shift>& shifts) {
  shifts.clear();
  Vector3d mean = Vector3d::Zero(), slope;
  for (const StencilEntry& e : entries) mean += e.weight * place_of(e);
  const Vector3d way = offset - mean;
  if (way.norm() < 1e-9) return;  // what is left lies evenly around the carrier
  Matrix3d second = Matrix3d::Zero();
  for (const StencilEntry& e : entries) {
    const Vector3d x = place_of(e) - mean;
    second += e.weight * x * x.transpose();
  }
  if (solve(second, way, slope)) {
    for (const StencilEntry& e : entries) shifts.push_back({e.slot, e.weight * slope.dot(place_of(e) - mean)});
    return;
  }
  const int wide = reach + 1;
  const double scale = 1.0 / widen(cells, base, offset, wide, entries, block);
  const auto each = [&](const auto& visit) {
    for (int k = -wide, n = 0; k <= wide; ++k)
      for (int j = -wide; j <= wide; ++j)
        for (int i = -wide; i <= wide; ++i, ++n)
          if (block.weights[n] > 0.0) visit(n, scale * block.weights[n], Vector3d(i, j, k));
  };
  mean.setZero(), second.setZero();
  each([&](int, double v, const Vector3d& x) { mean += v * x; });
  each([&](int, double v, const Vector3d& x) { second += v * (x - mean) * (x - mean).transpose(); });
  slope = solve_where_not_flat(second, way);
  each([&](int n, double v, const Vector3d& x) { shifts.push_back({block.slots[n], v * slope.dot(x - mean)}); });
}

}  // namespace puffin::coupling
