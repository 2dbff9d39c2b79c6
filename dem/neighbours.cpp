#include "dem/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "dem/parts.hpp"

namespace puffin::dem {
namespace {

constexpr std::size_t carriers_a_part = 512;  // shared among threads

/// What the search asks of a carrier; copied into the order of the cells, where those of a cell lie side by side.
struct Member {
  Eigen::Matrix<std::int64_t, 3, 1> key;  // of its cell
  Eigen::Vector3d position;
  double radius, budget;
  std::int32_t place;
};

/// Carriers sorted into cubic cells by a hash of the cell's indices: any extent of space, cost ~ number of carriers.
class Cells {
 public:
  Cells(const Carriers& carriers, const std::vector<double>& budget, double edge) : edge_(edge) {
    const std::size_t n = carriers.size();
    std::size_t buckets = 64;
    while (buckets < 2 * n) buckets *= 2;
    mask_ = buckets - 1;
    begin_.assign(buckets + 1, 0);
    for (const auto& x : carriers.position) ++begin_[bucket(cell(x)) + 1];
    for (std::size_t b = 0; b < buckets; ++b) begin_[b + 1] += begin_[b];
    members_.resize(n);
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < n; ++i) {
      const Key key = cell(carriers.position[i]);
      members_[next[bucket(key)]++] = {key, carriers.position[i], carriers.radius[i], budget[i],
                                       static_cast<std::int32_t>(i)};
    }
  }

  using Key = Eigen::Matrix<std::int64_t, 3, 1>;
  Key cell(const Eigen::Vector3d& x) const { return {index(x[0]), index(x[1]), index(x[2])}; }
  /// Calls use(member) for each carrier in the cell, in ascending order of their places.
  template <class Use>
  void visit(const Key& key, Use use) const {
    const std::size_t b = bucket(key);
    for (std::int32_t m = begin_[b]; m < begin_[b + 1]; ++m)
      if (members_[m].key == key) use(members_[m]);
  }
  const std::vector<Member>& members() const { return members_; }
  /// Carriers in the cell of x, at most `enough`.
  std::int32_t crowd(const Eigen::Vector3d& x, std::int32_t enough) const {
    const Key key = cell(x);
    const std::size_t b = bucket(key);
    std::int32_t count = 0;
    for (std::int32_t m = begin_[b]; m < begin_[b + 1] && count < enough; ++m) count += members_[m].key == key;
    return count;
  }

 private:
  /// What is further than an index reaches, or is no number, is in the last cell.
  std::int64_t index(double x) const {
    constexpr double last = 0x1p62;
    const double cells = std::floor(x / edge_);
    return static_cast<std::int64_t>(cells > -last ? std::min(cells, last) : -last);
  }
  std::size_t bucket(const Key& key) const {
    const auto u = [&](int d) { return static_cast<std::uint64_t>(key[d]); };
    std::uint64_t h = u(0) * 0x9E3779B97F4A7C15ull ^ u(1) * 0xC2B2AE3D27D4EB4Full ^ u(2) * 0x165667B19E3779F9ull;
    h ^= h >> 29;
    return (h * 0xBF58476D1CE4E5B9ull >> 32) & mask_;
  }
  double edge_;
  std::size_t mask_ = 0;
  std::vector<std::int32_t> begin_;
  std::vector<Member> members_;
};

double reach_of(const Carriers& carriers, const std::vector<double>& budget, double largest, std::size_t i) {
  return carriers.radius[i] + largest + 2.0 * budget[i];
}

double mean_reach(const std::vector<double>& budget, double largest) {
  double mean_budget = 0.0;
  for (const double b : budget)
    if (std::isfinite(b)) mean_budget += b / static_cast<double>(budget.size());
  return 2.0 * largest + 2.0 * mean_budget;
}

/// Cells of edges e, 2e, 4e ...: a carrier searches those it reaches across, 27 to 125 of them. In cells of one edge a
/// few that are fast beside a resting crowd searched (reach/e)^3 of them each: 2,000 fines in a bend spent 99 % there.
class Levels {
 public:
  Levels(const Carriers& carriers, const std::vector<double>& budget, double largest, double edge) : edge_(edge) {
    cells_.emplace_back(Cells(carriers, budget, edge));
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      const double reach = reach_of(carriers, budget, largest, i);
      if (!std::isfinite(reach)) continue;
      const std::size_t level = level_of(reach);
      if (level >= cells_.size()) cells_.resize(level + 1);
      if (!cells_[level]) cells_[level].emplace(carriers, budget, std::ldexp(edge, static_cast<int>(level)));
    }
  }
  const Cells& of(double reach) const { return *cells_[level_of(reach)]; }
  /// All carriers, those of a small cell one after the other.
  const std::vector<Member>& members() const { return cells_[0]->members(); }

 private:
  std::size_t level_of(double reach) const {
    return reach <= 2.0 * edge_ ? 0 : static_cast<std::size_t>(std::ilogb(reach / edge_));
  }
  double edge_;
  std::vector<std::optional<Cells>> cells_;  // by level; only those that are searched
};

}  // namespace

double expected_neighbours(const Carriers& carriers, const std::vector<double>& budget,
                           std::span<const std::int32_t> which) {
  if (which.empty()) return 0.0;
  const double largest = *std::max_element(carriers.radius.begin(), carriers.radius.end());
  const double edge = mean_reach(budget, largest);
  const Cells cells(carriers, budget, edge);
  const double most = static_cast<double>(carriers.size() - 1);
  constexpr std::int32_t enough = 100;  // a crowd that is counted no further
  double sum = 0.0;
  for (const std::int32_t i : which)
    if (const double reach = reach_of(carriers, budget, largest, i) / edge; std::isfinite(reach))
      sum += std::min(
          most, 4.0 / 3.0 * std::numbers::pi * reach * reach * reach * (cells.crowd(carriers.position[i], enough) - 1));
  return sum / static_cast<double>(which.size());
}

void build(const Carriers& carriers, Neighbours& neighbours) {
  const std::size_t n = carriers.size();
  neighbours.built_at = carriers.position;
  neighbours.begin.assign(n + 1, 0);
  neighbours.list.clear();
  neighbours.valid = true;
  if (n == 0) return;
  const double largest = *std::max_element(carriers.radius.begin(), carriers.radius.end());
  const Levels levels(carriers, neighbours.budget, largest, mean_reach(neighbours.budget, largest));

  // Each pair is found by the partner with the larger budget (the larger place if equal), whose search reaches far
  // enough.
  std::vector<std::vector<std::array<std::int32_t, 2>>> found((n + carriers_a_part - 1) / carriers_a_part);
  in_parts(n, carriers_a_part, [&](std::size_t part, std::size_t first, std::size_t last) {
    auto& pairs = found[part];
    for (std::size_t m = first; m < last; ++m) {  // in their order: those of one cell search the same cells
      const Member& own = levels.members()[m];
      const double reach = own.radius + largest + 2.0 * own.budget;
      if (!std::isfinite(reach)) continue;
      const Cells& cells = levels.of(reach);
      const Eigen::Vector3d arm = Eigen::Vector3d::Constant(reach);
      const auto low = cells.cell(own.position - arm), high = cells.cell(own.position + arm);
      for (std::int64_t cz = low[2]; cz <= high[2]; ++cz)
        for (std::int64_t cy = low[1]; cy <= high[1]; ++cy)
          for (std::int64_t cx = low[0]; cx <= high[0]; ++cx)
            cells.visit({cx, cy, cz}, [&](const Member& other) {
              if (other.budget > own.budget || (other.budget == own.budget && other.place >= own.place)) return;
              const double far = own.radius + other.radius + own.budget + other.budget;
              if ((other.position - own.position).squaredNorm() < far * far) pairs.push_back({own.place, other.place});
            });
    }
  });
  for (const auto& pairs : found)
    for (const auto& [i, j] : pairs) ++neighbours.begin[i + 1], ++neighbours.begin[j + 1];
  for (std::size_t i = 0; i < n; ++i) neighbours.begin[i + 1] += neighbours.begin[i];
  neighbours.list.resize(static_cast<std::size_t>(neighbours.begin.back()));
  std::vector<std::int32_t> next(neighbours.begin.begin(), neighbours.begin.end() - 1);
  for (const auto& pairs : found)
    for (const auto& [i, j] : pairs) neighbours.list[next[i]++] = j, neighbours.list[next[j]++] = i;
  in_parts(n, carriers_a_part, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      std::sort(neighbours.list.begin() + neighbours.begin[i], neighbours.list.begin() + neighbours.begin[i + 1]);
  });
}

}  // namespace puffin::dem
