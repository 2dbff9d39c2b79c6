#include "lbm/band_level.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace puffin::lbm {

namespace {

constexpr float most_share = 0.16F, most_of_a_root = 0.5F;

/// Axis links between computed cells that a thin wall cuts, a bit each.
std::vector<std::uint8_t> cut_faces(const Rows& rows, const Links& links) {
  std::vector<std::uint8_t> cut(rows.slots(), 0);
  for (const auto& link : links.thin) {
    if (link.direction > 6) continue;
    cut[link.slot] |= static_cast<std::uint8_t>(1U << (link.direction - 1));
    const auto c = rows.cell(link.slot);
    const auto& e = d3q19::velocity[link.direction];
    const std::ptrdiff_t other = rows.active_slot(c[0] + e[0], c[1] + e[1], c[2] + e[2]);
    if (other >= 0) cut[other] |= static_cast<std::uint8_t>(1U << (d3q19::opposite(link.direction) - 1));
  }
  return cut;
}

}  // namespace

std::vector<std::ptrdiff_t> band_roots(const Rows& rows, const std::vector<std::uint8_t>& fluid, const Links& links) {
  const std::vector<std::uint8_t> cut = cut_faces(rows, links);
  std::vector<std::ptrdiff_t> root(rows.slots(), -1), layer;
  for (const Run& run : rows.runs())
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
      if (fluid[s] != 0) root[s] = s, layer.push_back(s);
  while (!layer.empty()) {
    std::vector<std::ptrdiff_t> next;
    for (const std::ptrdiff_t s : layer)
      for (int d = 0; d < 3; ++d)
        for (const int sign : {-1, 1}) {
          const int i = 2 * d + (sign > 0 ? 1 : 2);
          if (cut[s] >> (i - 1) & 1U) continue;
          auto c = rows.cell(s);
          c[d] += sign;
          const std::ptrdiff_t other = rows.active_slot(c[0], c[1], c[2]);
          if (other < 0 || root[other] >= 0) continue;
          root[other] = root[s];
          next.push_back(other);
        }
    layer = std::move(next);
  }
  return root;
}

BandLevel find_band_level(const Rows& rows, const std::vector<std::uint8_t>& fluid, const Links& links) {
  const std::vector<std::ptrdiff_t> root = band_roots(rows, fluid, links);
  std::vector<std::int32_t> run_of(rows.slots(), -1);
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> pairs;  // root, cell of the band
  for (std::size_t r = 0; r < rows.runs().size(); ++r) {
    const Run& run = rows.runs()[r];
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
      run_of[s] = static_cast<std::int32_t>(r);
      if (fluid[s] == 0 && root[s] >= 0) pairs.emplace_back(root[s], s);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  BandLevel level;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const auto [own, cell] = pairs[n];
    if (n == 0 || own != pairs[n - 1].first) {
      level.roots.push_back({own, run_of[own]});
      level.first.push_back(level.first.back());
    }
    level.cells.push_back({cell, run_of[cell]});
    ++level.first.back();
  }
  for (std::size_t k = 0; k < level.roots.size(); ++k) {
    const auto count = static_cast<float>(level.first[k + 1] - level.first[k]);
    level.share.push_back(std::min(most_share, most_of_a_root / count));
  }
  return level;
}

namespace {

/// The populations that have arrived at a cell.
template <class T>
struct Arrived {
  Arrived(const Rows& rows, const BandLevel::Cell& cell, Populations<T>& p) {
    const Run& run = rows.runs()[cell.run];
    for (int i = 0; i < d3q19::q; ++i) at[i] = &p.arrived(run, cell.slot, i);
    for (int i = 0; i < d3q19::q; ++i) sum += *at[i];
  }
  void gain(T mass) const {
    for (int i = 0; i < d3q19::q; ++i) *at[i] += static_cast<T>(d3q19::weight[i]) * mass;
  }

  std::array<T*, d3q19::q> at;
  T sum = T(0);  // rho - 1
};

}  // namespace

template <class T>
void level_band(const BandLevel& level, const Rows& rows, Populations<T>& p) {
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, level.roots.size(), 256),
      [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const Arrived<T> root(rows, level.roots[k], p);
          T given = T(0);
          for (std::int32_t n = level.first[k]; n < level.first[k + 1]; ++n) {
            const Arrived<T> cell(rows, level.cells[n], p);
            const T mass = static_cast<T>(level.share[k]) * (root.sum - cell.sum);
            cell.gain(mass);
            given += mass;
          }
          root.gain(-given);
        }
      },
      oneapi::tbb::static_partitioner());
}

template void level_band(const BandLevel&, const Rows&, Populations<float>&);
template void level_band(const BandLevel&, const Rows&, Populations<double>&);

}  // namespace puffin::lbm
