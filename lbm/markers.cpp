#include "lbm/markers.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "lbm/geometry/surface_check.hpp"
#include "lbm/marker_samples.hpp"

namespace puffin::lbm {

using geometry::Vec3;

namespace {

Weights transposed(const Weights& rows, std::size_t columns) {
  Weights out;
  out.first.assign(columns + 1, 0);
  for (const std::int32_t c : rows.other) ++out.first[c + 1];
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  out.other.resize(rows.other.size());
  out.weight.resize(rows.other.size());
  std::vector<std::int32_t> next(out.first.begin(), out.first.end() - 1);
  for (std::size_t r = 0; r + 1 < rows.first.size(); ++r)
    for (std::int32_t e = rows.first[r]; e < rows.first[r + 1]; ++e) {
      const std::int32_t to = next[rows.other[e]]++;
      out.other[to] = static_cast<std::int32_t>(r);
      out.weight[to] = rows.weight[e];
    }
  return out;
}

}  // namespace

MarkerOptions::MarkerOptions() : spacing(1.3), retraction(retraction_for(0.5)) {}

double retraction_for(double tau0) { return std::clamp(0.78 - 0.18 * (tau0 - 0.51) / 0.09, 0.6, 0.78); }

double roma_kernel(double r) {
  const double a = std::abs(r);
  if (a >= 1.5) return 0.0;
  if (a <= 0.5) return (1.0 + std::sqrt(1.0 - 3.0 * a * a)) / 3.0;
  return (5.0 - 3.0 * a - std::sqrt(std::max(0.0, 1.0 - 3.0 * (1.0 - a) * (1.0 - a)))) / 6.0;
}

std::vector<double> row_sum_gain(const Weights& marker_cells, const Weights& cell_markers,
                                 const std::vector<double>& area) {
  const std::size_t markers = area.size(), cells = cell_markers.first.size() - 1;
  std::vector<double> gain = area, spread(cells);
  // Sinkhorn's way: divide each gain by its row sum until the sums are 1.
  for (int pass = 0; pass < 12; ++pass) {
    for (std::size_t j = 0; j < cells; ++j) {
      double s = 0.0;
      for (std::int32_t e = cell_markers.first[j]; e < cell_markers.first[j + 1]; ++e)
        s += cell_markers.weight[e] * gain[cell_markers.other[e]];
      spread[j] = s;
    }
    double most = 0.0;
    for (std::size_t k = 0; k < markers; ++k) {
      double row = 0.0;
      for (std::int32_t e = marker_cells.first[k]; e < marker_cells.first[k + 1]; ++e)
        row += marker_cells.weight[e] * spread[marker_cells.other[e]];
      most = std::max(most, row);
      if (pass < 11 && row > 0.0) gain[k] /= row;
    }
    if (pass == 11 && most > 1.0)
      for (double& g : gain) g /= most;
  }
  return gain;
}

Markers place_markers(const Rows& rows, const WallSides& sides, const LinkGeometry& surface,
                      const MarkerOptions& options) {
  const double dx = rows.dx();
  const std::vector<SurfaceMarker> placed = spread_markers(surface, options.spacing * dx);
  Markers m;
  struct Stencil {
    std::ptrdiff_t nearest = -1;
    std::vector<std::pair<std::ptrdiff_t, float>> cells;
  };
  std::vector<Stencil> stencils(placed.size());
  oneapi::tbb::parallel_for(std::size_t{0}, placed.size(), [&](std::size_t k) {
    const SurfaceMarker& marker = placed[k];
    const Vec3 at = (marker.surface + options.retraction * dx * marker.normal - rows.origin()) / dx;
    const WallPlace own{marker.surface, marker.normal, 0.0, marker.triangle};
    std::array<int, 3> base;
    for (int d = 0; d < 3; ++d) base[d] = static_cast<int>(std::lround(at[d]));
    double sum = 0.0, largest = 0.0;
    std::vector<std::pair<std::ptrdiff_t, double>> cells;
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const std::ptrdiff_t slot = rows.active_slot(base[0] + x, base[1] + y, base[2] + z);
          if (slot < 0) continue;
          const WallPlace* place = sides.of(slot);
          if (place != nullptr && sides.parted(own, *place)) continue;
          const double w =
              roma_kernel(base[0] + x - at[0]) * roma_kernel(base[1] + y - at[1]) * roma_kernel(base[2] + z - at[2]);
          if (!(w > 1e-6)) continue;
          cells.emplace_back(slot, w);
          sum += w;
          if (w > largest) largest = w, stencils[k].nearest = slot;
        }
    std::sort(cells.begin(), cells.end());
    for (const auto& [slot, w] : cells) stencils[k].cells.emplace_back(slot, static_cast<float>(w / sum));
  });
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < placed.size(); ++k)
    if (!stencils[k].cells.empty()) order.push_back(k);
  if (order.empty() && !placed.empty())
    throw geometry::GeometryError("no marker of the walls has a cell; dx is too large");
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return stencils[a].nearest < stencils[b].nearest; });

  // Number the cells in the order of the rows.
  std::vector<std::int32_t> number(rows.slots(), -1);
  for (const std::size_t k : order)
    for (const auto& [slot, w] : stencils[k].cells) number[slot] = 0;
  m.segment_chunks.push_back(0);
  m.touched_runs.assign(rows.runs().size(), 0);
  std::size_t filled = 0;
  for (std::size_t r = 0; r < rows.runs().size(); ++r) {
    const Run& run = rows.runs()[r];
    bool joined = false;
    for (int n = 0; n < run.count; ++n) {
      const std::ptrdiff_t s = run.first + n;
      if (number[s] < 0) {
        joined = false;
        continue;
      }
      if (!joined) m.segments.push_back({s, 0, static_cast<std::int32_t>(r), m.slot.size()});
      joined = true;
      ++m.segments.back().count;
      number[s] = static_cast<std::int32_t>(m.slot.size());
      m.slot.push_back(static_cast<std::int32_t>(s));
      m.touched_runs[r] = 1;
      ++filled;
    }
    if (filled >= 2048 && m.segments.size() > m.segment_chunks.back()) {
      m.segment_chunks.push_back(m.segments.size());
      filled = 0;
    }
  }
  if (m.segments.size() > m.segment_chunks.back()) m.segment_chunks.push_back(m.segments.size());

  std::vector<double> area;
  bool moving = false;
  for (const std::size_t k : order) {
    for (const auto& [slot, w] : stencils[k].cells) {
      m.marker_cells.other.push_back(number[slot]);
      m.marker_cells.weight.push_back(w);
    }
    m.marker_cells.first.push_back(static_cast<std::int32_t>(m.marker_cells.other.size()));
    if (stencils[k].cells.size() < 4) ++m.few_cells;
    area.push_back(placed[k].area / (dx * dx));
    const int patch = surface.patch_of_triangle[placed[k].triangle];
    m.patch.push_back(static_cast<std::int16_t>(patch));
    Vec3 u = Vec3::Zero();
    if (surface.boundaries[patch].profile) u = surface.boundaries[patch].profile(placed[k].surface);
    moving = moving || u.norm() > 0.0;
    for (int d = 0; d < 4; ++d) m.wall.push_back(d < 3 ? static_cast<float>(u[d]) : 0.0F);
  }
  m.cell_markers = transposed(m.marker_cells, m.slot.size());
  for (const double c : row_sum_gain(m.marker_cells, m.cell_markers, area))
    m.gain.push_back(static_cast<float>(2.0 * c));
  m.push.assign(4 * m.count(), 0.0F);
  m.mass.assign(m.count(), 0.0F);
  m.state.assign(4 * m.cells(), 0.0F);
  for (auto& f : m.force) f.assign(rows.slots(), 0.0F);
  m.run_flags.assign(rows.runs().size(), 0);
  m.foreign_runs.assign(rows.runs().size(), 0);
  return m;
}

}  // namespace puffin::lbm
