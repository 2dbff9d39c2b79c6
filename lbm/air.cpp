#include "lbm/air.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "lbm/eddy_length.hpp"
#include "lbm/markers.hpp"
#include "lbm/psm.hpp"
#include "lbm/slip.hpp"
#include "lbm/wall_model.hpp"
#include "lbm/wall_schemes.hpp"

namespace puffin::lbm {

using geometry::Vec3;

Parity Air::parity() const {
  return std::visit([](const auto& p) { return p.next; }, populations);
}

namespace {

/// The computed cells of the wall scheme, and what the scheme keeps of them.
CellKinds lay_out_cells(const geometry::Voxels& voxels, const LinkGeometry& surface,
                        const std::array<bool, 3>& periodic, Air& air) {
  const AirOptions& options = air.options;
  CellKinds kinds;
  if (options.wall != WallScheme::ibm && options.wall != WallScheme::psm) {
    air.rows = Rows(voxels, periodic);
    air.fluid_cells = air.rows.active_cells();
    return kinds;
  }
  const bool band = options.wall == WallScheme::ibm;
  const double depth = options.markers.band();
  const ActiveCells cells =
      band ? with_band(voxels, surface, depth, periodic) : with_cut_cells(voxels, surface, least_fluid);
  air.rows = Rows(cells.computed, periodic);
  air.fluid.assign(air.rows.slots(), 0);
  for (const Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const bool inside = cells.inside.is_fluid(run.x + n, run.y, run.z);
      air.fluid[run.first + n] = inside;
      air.fluid_cells += inside;
    }
  kinds.fluid = air.fluid;
  kinds.sides = std::make_shared<const WallSides>(air.rows, surface, depth + 1.0);
  if (band)
    air.markers = std::make_shared<Markers>(place_markers(air.rows, *kinds.sides, surface, options.markers));
  else
    air.partial =
        std::make_shared<PartialCells>(find_partial_cells(air.rows, cells, surface, options.double_precision));
  return kinds;
}

}  // namespace

Air make_air(const geometry::Voxels& voxels, const LinkGeometry& surface, const AirOptions& options) {
  std::array<bool, 3> periodic{false, false, false};
  Air air;
  air.boundaries = surface.boundaries;
  air.normal.assign(surface.boundaries.size(), Vec3::Zero());
  std::vector<double> all(surface.boundaries.size(), 0.0);
  for (std::size_t t = 0; t < surface.mesh->triangles.size(); ++t) {
    const Vec3 area = surface.mesh->area_vector(static_cast<int>(t));
    air.normal[surface.patch_of_triangle[t]] += area;
    all[surface.patch_of_triangle[t]] += area.norm();
  }
  for (std::size_t b = 0; b < surface.boundaries.size(); ++b) {
    if (air.normal[b].norm() > 1e-6 * all[b])
      air.normal[b].normalize();
    else
      air.normal[b].setZero();  // faces that look against each other
    if (surface.boundaries[b].kind == BoundaryKind::periodic)
      for (int d = 0; d < 3; ++d) periodic[d] = periodic[d] || std::abs(air.normal[b][d]) > 0.99;
  }
  air.options = options;
  const CellKinds kinds = lay_out_cells(voxels, surface, periodic, air);
  air.links = build_links(air.rows, surface, options.wall, kinds);
  if (air.markers) air.markers->level = find_band_level(air.rows, air.fluid, air.links);
  const std::size_t slots = air.rows.slots();
  if (options.double_precision)
    air.populations = Populations<double>(slots);
  else
    air.populations = Populations<float>(slots);
  for (auto* v : {&air.moments.density_excess, &air.moments.ux, &air.moments.uy, &air.moments.uz, &air.force.x,
                  &air.force.y, &air.force.z})
    v->assign(slots, 0.0F);
  air.run_flags.assign(air.rows.runs().size(), 0);
  air.run_of_slot.assign(slots, -1);
  for (std::size_t r = 0; r < air.rows.runs().size(); ++r)
    for (int n = 0; n < air.rows.runs()[r].count; ++n)
      air.run_of_slot[air.rows.runs()[r].first + n] = static_cast<std::int32_t>(r);
  air.les = eddy_lengths(air.rows, surface, options);
  if (air.markers)  // the band is not turbulent air: decision 0007
    for (std::size_t s = 0; s < slots; ++s)
      if (!air.is_fluid(static_cast<std::ptrdiff_t>(s))) air.les[s] = 0.0F;
  std::vector<float> length2;
  if (options.eddy == Eddy::vreman && options.smagorinsky > 0.0) {
    length2.assign(slots, 0.0F);
    std::swap(length2, air.les);
  }
  air.gradients = make_velocity_gradients(air.rows, air.links, air.boundaries, options.law == Law::hrr, length2);
  if (options.wall_model)
    air.wall_model = std::make_shared<WallModel>(find_modelled_cells(air.rows, air.links, surface));
  return air;
}

CellMoments<double> moments_at(const Air& air, std::ptrdiff_t slot) {
  return std::visit(
      [&]<class T>(const Populations<T>& p) {
        const Run& run = air.rows.runs()[air.run_of_slot[slot]];
        double g[19];
        for (int i = 0; i < d3q19::q; ++i) g[i] = p.arrived(run, slot, i);
        const double none[3] = {0, 0, 0};
        auto m = moments_of(hydrodynamics<false>([&](auto i) { return g[i]; }, none));
        if (air.markers) {
          double* const u[3] = {&m.ux, &m.uy, &m.uz};
          for (int d = 0; d < 3; ++d) *u[d] += 0.5 * air.markers->force[d][slot] / (1.0 + m.density_excess);
        }
        return m;
      },
      air.populations);
}

void find_moments(Air& air) {
  for_each_chunk(air.rows, [&](int, const Chunk& chunk) {
    for (int r = chunk.first_run; r < chunk.last_run; ++r)
      for (int n = 0; n < air.rows.runs()[r].count; ++n) {
        const std::ptrdiff_t s = air.rows.runs()[r].first + n;
        const auto m = moments_at(air, s);
        air.moments.density_excess[s] = static_cast<float>(m.density_excess);
        air.moments.ux[s] = static_cast<float>(m.ux);
        air.moments.uy[s] = static_cast<float>(m.uy);
        air.moments.uz[s] = static_cast<float>(m.uz);
      }
  });
}

double mass_excess(const Air& air) {
  std::vector<double> part(air.rows.chunks().size(), 0.0);
  for_each_chunk(air.rows, [&](int c, const Chunk& chunk) {
    for (int r = chunk.first_run; r < chunk.last_run; ++r)
      for (int n = 0; n < air.rows.runs()[r].count; ++n)
        part[c] += moments_at(air, air.rows.runs()[r].first + n).density_excess;
  });
  double sum = 0.0;
  for (const double v : part) sum += v;
  return sum;
}

void set_cells(const std::function<InitialCell(const Vec3& centre)>& state, Air& air) {
  std::visit(
      [&]<class T>(Populations<T>& p) {
        for (const Run& run : air.rows.runs())
          for (int n = 0; n < run.count; ++n) {
            const std::ptrdiff_t slot = run.first + n;
            const InitialCell cell = state(air.rows.centre(slot));
            const double none[3] = {0, 0, 0};
            CellState<double> r;
            r.drho = cell.density_excess;
            for (int d = 0; d < 3; ++d) r.u[d] = cell.velocity[d];
            for (int d = 0; d < 3; ++d) r.j[d] = (1.0 + r.drho) * r.u[d];
            std::copy(cell.stress.begin(), cell.stress.end(), r.p);
            remove_trace(r.p);
            Rr3::assemble<false>(r, none, [&](auto i, double g) { p.arrived(run, slot, i) = static_cast<T>(g); });
          }
      },
      air.populations);
}

double mass_through(const Air& air, int boundary) {
  return std::visit(
      [&]<class T>(const Populations<T>& p) {
        const Parity last = p.next == Parity::even ? Parity::odd : Parity::even;
        double mass = 0.0;
        for (const auto* list : {&air.links.inlets, &air.links.outlets})
          for (const auto& link : *list) {
            if (link.patch != boundary) continue;
            const Run& run = air.rows.runs()[link.run];
            mass += p.arrived(run, link.slot, d3q19::opposite(link.direction)) -
                    p.departed(run, link.slot, link.direction, last);
          }
        return mass;
      },
      air.populations);
}

}  // namespace puffin::lbm
