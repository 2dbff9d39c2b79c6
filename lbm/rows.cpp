#include "lbm/rows.hpp"

#include <algorithm>
#include <stdexcept>

namespace puffin::lbm {

namespace {

int wrapped(int i, int n) { return (i % n + n) % n; }

/// Unites overlapping and touching intervals.
void unite(std::vector<geometry::FluidRun>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  std::size_t kept = 0;
  for (const geometry::FluidRun& i : intervals) {
    if (kept > 0 && i.begin <= intervals[kept - 1].end)
      intervals[kept - 1].end = std::max(intervals[kept - 1].end, i.end);
    else
      intervals[kept++] = i;
  }
  intervals.resize(kept);
}

/// The cells of a row (ghost rows too) that must be stored: active ones and every cell they stream to or from, as
/// maximal intervals. Neighbours in two of y, z at once are streamed to straight, without a step along x. `room`: the
/// same with that step, which makes the rows around a straight duct equally long.
void stored_cells(const geometry::Voxels& voxels, int j, int k, std::vector<geometry::FluidRun>& stored,
                  std::vector<geometry::FluidRun>& room) {
  stored.clear();
  room.clear();
  for (int cz = -1; cz <= 1; ++cz)
    for (int cy = -1; cy <= 1; ++cy) {
      const int more = cy != 0 && cz != 0 ? 0 : 1;
      for (const geometry::FluidRun& run : voxels.row(j + cy, k + cz)) {
        stored.push_back({run.begin - more, run.end + more});
        room.push_back({run.begin - 1, run.end + 1});
      }
    }
  unite(stored);
  unite(room);
}

}  // namespace

Rows::Rows(const geometry::Voxels& voxels, std::array<bool, 3> periodic)
    : origin_(voxels.origin), dx_(voxels.dx), box_(voxels.size), periodic_(periodic) {
  const int ny = box_[1], nz = box_[2];
  active_ = voxels.cells();
  if (active_ == 0) throw std::invalid_argument("no cell centre lies inside the surface: dx is too large");

  // Rows: along x every cell beside an active cell of the row or of a neighbouring row must be contiguous with it, so a
  // stretch is a maximal interval of stored cells, widened where (x, y+cy, z+cz) of a run would fall outside.
  // D3Q19 has no (1,1,1) links, but a run's shift must hold for all of cx = -1, 0, 1 that are used with (cy,cz).
  row_begin_.assign(static_cast<std::size_t>(ny + 2) * (nz + 2) + 1, 0);
  std::ptrdiff_t next = padding;
  std::vector<geometry::FluidRun> stored, room;
  for_each_row(1, [&](int j, int k) {
    row_begin_[row(j, k)] = static_cast<std::int32_t>(stretches_.size());
    stored_cells(voxels, j, k, stored, room);
    auto first_stored = stored.begin();
    for (const geometry::FluidRun& place : room) {
      for (; first_stored != stored.end() && first_stored->begin < place.end; ++first_stored)
        stretches_.push_back(
            {first_stored->begin, first_stored->end - first_stored->begin, next + (first_stored->begin - place.begin)});
      next += place.end - place.begin;
    }
  });
  row_begin_.back() = static_cast<std::int32_t>(stretches_.size());
  slots_ = static_cast<std::size_t>(next + padding);
  kind_.assign(slots_, Kind::padding);
  cell_.assign(slots_, {-2, -2, -2});
  for_each_row(1, [&](int j, int k) {
    for (int s = row_begin_[row(j, k)]; s < row_begin_[row(j, k) + 1]; ++s)
      for (int n = 0; n < stretches_[s].count; ++n) {
        kind_[stretches_[s].first + n] = Kind::ghost;
        cell_[stretches_[s].first + n] = {stretches_[s].x + n, j, k};
      }
  });

  // Runs of active cells. All nine neighbouring rows store x-1..x+1 only where D3Q19 links go; (cy,cz) both non-zero is
  // used with cx = 0 alone, and there the stretch covers x itself, which is all that is read.
  for_each_row(0, [&](int j, int k) {
    for (const geometry::FluidRun& fluid : voxels.row(j, k)) {
      Run run{fluid.begin, j, k, fluid.end - fluid.begin, slot(fluid.begin, j, k), {}};
      std::fill_n(kind_.begin() + run.first, run.count, Kind::active);
      for (int cy = -1; cy <= 1; ++cy)
        for (int cz = -1; cz <= 1; ++cz) run.shift[cy + 1][cz + 1] = slot(run.x, j + cy, k + cz) - run.first;
      if (!runs_.empty()) run.span = runs_.back().span + (run.shift == runs_.back().shift ? 0 : 1);
      runs_.push_back(run);
    }
  });

  active_lanes_.assign(slots_ / 16 + 2, 0);
  for (std::size_t s = 0; s < slots_; ++s) {
    if (kind_[s] == Kind::active) active_lanes_[s / 16] |= static_cast<std::uint16_t>(1U << s % 16);
    if (kind_[s] != Kind::ghost) continue;
    const auto c = cell_[s];
    const std::ptrdiff_t image = active_slot(c[0], c[1], c[2]);
    if (image >= 0) images_.push_back({static_cast<std::ptrdiff_t>(s), image});
  }

  // Chunks of about equal work, whose populations fit into the second-level cache. Their number depends on the number
  // of cells alone.
  const std::size_t wanted = std::max<std::size_t>(active_ / 4096, 1);
  const std::size_t per_chunk = (active_ + wanted - 1) / wanted;
  std::size_t filled = 0;
  int begin = 0;
  for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
    filled += runs_[r].count;
    if (filled >= per_chunk || r + 1 == static_cast<int>(runs_.size())) {
      chunks_.push_back({begin, r + 1});
      begin = r + 1;
      filled = 0;
    }
  }
}

std::size_t Rows::row(int j, int k) const {
  const bool along_z = box_[2] < box_[1];
  return along_z ? (k + 1) + static_cast<std::size_t>(box_[2] + 2) * (j + 1)
                 : (j + 1) + static_cast<std::size_t>(box_[1] + 2) * (k + 1);
}

template <class Body>
void Rows::for_each_row(int margin, const Body& body) const {
  const bool along_z = box_[2] < box_[1];
  for (int outer = -margin; outer < std::max(box_[1], box_[2]) + margin; ++outer)
    for (int inner = -margin; inner < std::min(box_[1], box_[2]) + margin; ++inner)
      along_z ? body(outer, inner) : body(inner, outer);
}

std::ptrdiff_t Rows::slot(int i, int j, int k) const {
  if (i < -1 || j < -1 || k < -1 || i > box_[0] || j > box_[1] || k > box_[2]) return -1;
  const std::size_t here = row(j, k);
  for (int s = row_begin_[here]; s < row_begin_[here + 1]; ++s)
    if (i >= stretches_[s].x && i < stretches_[s].x + stretches_[s].count)
      return stretches_[s].first + (i - stretches_[s].x);
  return -1;
}

std::ptrdiff_t Rows::active_slot(int i, int j, int k) const {
  std::array<int, 3> c{i, j, k};
  for (int d = 0; d < 3; ++d)
    if (periodic_[d]) c[d] = wrapped(c[d], box_[d]);
  const std::ptrdiff_t s = slot(c[0], c[1], c[2]);
  return s >= 0 && is_active(s) ? s : -1;
}

}  // namespace puffin::lbm
