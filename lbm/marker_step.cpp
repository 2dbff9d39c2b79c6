#include "lbm/marker_step.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "lbm/markers.hpp"

namespace puffin::lbm {

namespace {

using Range = oneapi::tbb::blocked_range<std::size_t>;

void read_air(Air& air) {
  Markers& m = *air.markers;
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        ReadInput<T> input;
        input.f = p.f.data();
        input.stride = p.stride;
        input.runs = air.rows.runs().data();
        input.segments = m.segments.data();
        input.parity = p.next;
        input.state = m.state.data();
        const ReadKernel<T> kernel = select_read_kernel<T>(air.options.isa);
        oneapi::tbb::parallel_for(
            std::size_t{0}, m.segment_chunks.size() - 1,
            [&](std::size_t c) {
              ReadInput<T> mine = input;
              mine.first = m.segment_chunks[c];
              mine.last = m.segment_chunks[c + 1];
              kernel(mine);
            },
            oneapi::tbb::static_partitioner());
      },
      air.populations);
}

/// Half of the other forces belongs to the velocity.
void add_other_forces(const Drive& drive, Air& air) {
  Markers& m = *air.markers;
  const bool uniform = drive.uniform_force[0] != 0.0 || drive.uniform_force[1] != 0.0 || drive.uniform_force[2] != 0.0;
  oneapi::tbb::parallel_for(
      Range(0, m.segments.size(), 256),
      [&](const Range& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const CellSegment& segment = m.segments[k];
          const bool foreign = (air.run_flags[segment.run] & run_forced) != 0;
          if (!foreign && !uniform) continue;
          for (int n = 0; n < segment.count; ++n) {
            float* const u = m.state.data() + 4 * (segment.at + n);
            const std::ptrdiff_t s = segment.first + n;
            const float other[3] = {foreign ? air.force.x[s] : 0.0F, foreign ? air.force.y[s] : 0.0F,
                                    foreign ? air.force.z[s] : 0.0F};
            for (int d = 0; d < 3; ++d) u[d] += 0.5F * (other[d] + static_cast<float>(drive.uniform_force[d])) / u[3];
          }
        }
      },
      oneapi::tbb::static_partitioner());
}

void find_pushes(double wall_speed, Markers& m) {
  const auto speed = static_cast<float>(wall_speed);
  oneapi::tbb::parallel_for(
      Range(0, m.count(), 512),
      [&](const Range& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          float sum[4] = {0, 0, 0, 0};
          for (std::int32_t e = m.marker_cells.first[k]; e < m.marker_cells.first[k + 1]; ++e) {
            const float* const u = m.state.data() + 4 * static_cast<std::size_t>(m.marker_cells.other[e]);
            const float w = m.marker_cells.weight[e];
            for (int d = 0; d < 4; ++d) sum[d] += w * u[d];
          }
          for (int d = 0; d < 3; ++d) m.push[4 * k + d] = m.gain[k] * (speed * m.wall[4 * k + d] - sum[d]);
          m.mass[k] = sum[3];
        }
      },
      oneapi::tbb::static_partitioner());
}

/// The forces of others as they are, where they changed or change.
void copy_other_forces(Air& air) {
  Markers& m = *air.markers;
  const auto& runs = air.rows.runs();
  const float* const from[3] = {air.force.x.data(), air.force.y.data(), air.force.z.data()};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const bool foreign = (air.run_flags[r] & run_forced) != 0;
    m.run_flags[r] = static_cast<std::uint8_t>(air.run_flags[r] | (m.touched_runs[r] ? run_forced : 0));
    if (!foreign && !m.foreign_runs[r]) continue;
    m.foreign_runs[r] = foreign;
    for (int d = 0; d < 3; ++d)
      for (std::ptrdiff_t s = runs[r].first; s < runs[r].first + runs[r].count; ++s)
        m.force[d][s] = foreign ? from[d][s] : 0.0F;
  }
}

void spread_pushes(Air& air) {
  Markers& m = *air.markers;
  const float* const other[3] = {air.force.x.data(), air.force.y.data(), air.force.z.data()};
  oneapi::tbb::parallel_for(
      Range(0, m.segments.size(), 64),
      [&](const Range& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const CellSegment& segment = m.segments[k];
          const bool foreign = (air.run_flags[segment.run] & run_forced) != 0;
          for (int n = 0; n < segment.count; ++n) {
            const std::size_t cell = segment.at + n;
            float sum[4] = {0, 0, 0, 0};
            for (std::int32_t e = m.cell_markers.first[cell]; e < m.cell_markers.first[cell + 1]; ++e) {
              const float* const a = m.push.data() + 4 * static_cast<std::size_t>(m.cell_markers.other[e]);
              const float w = m.cell_markers.weight[e];
              for (int d = 0; d < 4; ++d) sum[d] += w * a[d];
            }
            const std::ptrdiff_t s = segment.first + n;
            const float rho = m.state[4 * cell + 3];
            for (int d = 0; d < 3; ++d) m.force[d][s] = rho * sum[d] + (foreign ? other[d][s] : 0.0F);
          }
        }
      },
      oneapi::tbb::static_partitioner());
}

}  // namespace

void push_from_markers(const Drive& drive, double wall_speed, Air& air) {
  read_air(air);
  add_other_forces(drive, air);
  find_pushes(wall_speed, *air.markers);
  copy_other_forces(air);
  spread_pushes(air);
}

}  // namespace puffin::lbm
