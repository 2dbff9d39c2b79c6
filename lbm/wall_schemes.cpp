#include "lbm/wall_schemes.hpp"

#include <oneapi/tbb/parallel_for.h>

#include "lbm/marker_step.hpp"
#include "lbm/markers.hpp"
#include "lbm/psm.hpp"
#include "lbm/wall_model.hpp"

namespace puffin::lbm {

namespace {

template <class T>
PartialInput<T> partial_input(PartialCells& cells, const Air& air, Populations<T>& p) {
  PartialInput<T> input;
  input.f = p.f.data();
  input.stride = p.stride;
  input.runs = air.rows.runs().data();
  input.segments = cells.segments.data();
  input.parity = p.next;
  input.least_tau = psm_least_tau;
  input.les = air.les.data();
  input.eddy = air.gradients.viscosity_wanted ? 0.0 : 1.0;
  input.solid = cells.solid.data();
  for (int d = 0; d < 3; ++d) {
    input.wall[d] = cells.wall[d].empty() ? nullptr : cells.wall[d].data();
    input.taken[d] = cells.taken[d].data();
  }
  if constexpr (std::is_same_v<T, float>)
    input.kept = cells.kept_float.data();
  else
    input.kept = cells.kept_double.data();
  input.cells = cells.cells();
  return input;
}

template <class T>
void for_each_part(const PartialCells& cells, const PartialInput<T>& input, PartialKernel<T> kernel) {
  oneapi::tbb::parallel_for(
      std::size_t{0}, cells.chunks.size() - 1,
      [&](std::size_t c) {
        PartialInput<T> mine = input;
        mine.first = cells.chunks[c];
        mine.last = cells.chunks[c + 1];
        kernel(mine);
      },
      oneapi::tbb::static_partitioner());
}

}  // namespace

double wall_speed(const Drive& drive, const Air& air) {
  double speed = 0.0;
  for (std::size_t b = 0; b < air.boundaries.size(); ++b)
    if (air.boundaries[b].kind == BoundaryKind::wall && air.boundaries[b].profile) speed = drive.speed[b];
  return speed;
}

void prepare_walls(const CollisionConstants& constants, const Drive& drive, Air& air) {
  if (air.markers) {
    if (air.steps % steps_between_levels == 0)
      std::visit([&](auto& p) { level_band(air.markers->level, air.rows, p); }, air.populations);
    push_from_markers(drive, wall_speed(drive, air), air);
  }
  if (air.wall_model) {
    const double tau = constants.rescale != 1.0 ? constants.tau0_rescaled : constants.tau0;
    find_wall_stress((tau - 0.5) / 3.0, wall_speed(drive, air), air);
  }
  if (!air.partial) return;
  std::visit(
      [&]<class T>(Populations<T>& p) {
        PartialInput<T> input = partial_input(*air.partial, air, p);
        input.constants = constants;
        for (int d = 0; d < 3; ++d) input.uniform_force[d] = drive.uniform_force[d];
        input.wall_speed = wall_speed(drive, air);
        for_each_part(*air.partial, input, select_partial_kernels<T>(air.options.isa).find_solid);
      },
      air.populations);
}

void settle_walls(const Drive& drive, Air& air) {
  if (air.markers) push_from_markers(drive, wall_speed(drive, air), air);
}

void blend_partial_cells(Air& air) {
  if (!air.partial) return;
  std::visit(
      [&]<class T>(Populations<T>& p) {
        const PartialInput<T> input = partial_input(*air.partial, air, p);
        for_each_part(*air.partial, input, select_partial_kernels<T>(air.options.isa).blend);
      },
      air.populations);
}

std::array<double, 3> force_on_cells(const Air& air, int boundary) {
  std::array<double, 3> force{0, 0, 0};
  if (air.markers) {
    const Markers& m = *air.markers;
    for (std::size_t k = 0; k < m.count(); ++k)
      if (m.patch[k] == boundary)
        for (int d = 0; d < 3; ++d) force[d] -= static_cast<double>(m.mass[k]) * m.push[4 * k + d];
  }
  if (air.partial) {
    const PartialCells& cells = *air.partial;
    for (std::size_t n = 0; n < cells.cells(); ++n)
      if (cells.patch[n] == boundary)
        for (int d = 0; d < 3; ++d) force[d] += cells.taken[d][n];
  }
  return force;
}

}  // namespace puffin::lbm
