#include "lbm/air.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace puffin::lbm {

using geometry::Vec3;

namespace {

/// 18 sqrt2 L^2 with L = min(C_s, d/14), d the wall distance in cells (at least 1/2), and C_s raised up to threefold in
/// the sponge. d/14: the cell beside a wall (y+ of 20 to 60 at device scale) then carries the stress of the log law,
/// tau_w = rho (L u/d)^2 = rho (u/u+)^2 with u+ = 14. With kappa d instead (0.2 at d = 1/2, so C_s) the friction of a
/// channel 6 cells high came out five times too large: docs/decisions/0002-mixing-length-at-walls.md.
/// Vreman's viscosity needs no help at walls, so there L = C_s but for the sponge; returned is c L^2, c = 2.5.
std::vector<float> eddy_lengths(const Rows& rows, const LinkGeometry& surface, const AirOptions& options) {
  std::vector<float> les(rows.slots(), 0.0F);
  if (options.smagorinsky <= 0.0) return les;
  const bool vreman = options.eddy == Eddy::vreman;
  constexpr double slope = 1.0 / 14.0;
  auto walls = std::make_shared<geometry::TriangleMesh>(), outlets = std::make_shared<geometry::TriangleMesh>();
  walls->vertices = outlets->vertices = surface.mesh->vertices;
  for (std::size_t t = 0; t < surface.mesh->triangles.size(); ++t) {
    const BoundaryKind kind = surface.boundaries[surface.patch_of_triangle[t]].kind;
    if (kind == BoundaryKind::wall || kind == BoundaryKind::pressure_outlet) {
      auto& mesh = kind == BoundaryKind::wall ? walls : outlets;
      mesh->triangles.push_back(surface.mesh->triangles[t]);
      mesh->solid.push_back(0);
    }
  }
  using geometry::TriangleTree;
  const auto tree_of = [](const std::shared_ptr<geometry::TriangleMesh>& mesh) {
    return mesh->triangles.empty() ? nullptr : std::make_unique<TriangleTree>(mesh);
  };
  const auto wall_tree = tree_of(walls), outlet_tree = tree_of(outlets);
  const double dx = rows.dx(), reach = options.smagorinsky / slope * dx;
  for_each_chunk(rows, [&](int, const Chunk& chunk) {
    for (int r = chunk.first_run; r < chunk.last_run; ++r)
      for (int n = 0; n < rows.runs()[r].count; ++n) {
        const std::ptrdiff_t slot = rows.runs()[r].first + n;
        const Vec3 x = rows.centre(slot);
        double length = options.smagorinsky;
        if (outlet_tree && options.sponge_length > 0.0) {
          const double d = outlet_tree->closest(x, options.sponge_length).distance;
          if (d < options.sponge_length) length *= 3.0 - 2.0 * d / options.sponge_length;
        }
        if (wall_tree && !vreman)
          length = std::min(length, slope * std::max(0.5, wall_tree->closest(x, 3.0 * reach).distance / dx));
        les[slot] = static_cast<float>((vreman ? 2.5 : 18.0 * std::sqrt(2.0)) * length * length);
      }
  });
  return les;
}

}  // namespace

Parity Air::parity() const {
  return std::visit([](const auto& p) { return p.next; }, populations);
}

Air make_air(const geometry::Voxels& voxels, const LinkGeometry& surface, const AirOptions& options) {
  std::array<bool, 3> periodic{false, false, false};
  Air air;
  air.boundaries = surface.boundaries;
  air.normal.assign(surface.boundaries.size(), Vec3::Zero());
  for (std::size_t t = 0; t < surface.mesh->triangles.size(); ++t)
    air.normal[surface.patch_of_triangle[t]] += surface.mesh->area_vector(static_cast<int>(t));
  for (std::size_t b = 0; b < surface.boundaries.size(); ++b) {
    if (air.normal[b].norm() > 0.0) air.normal[b].normalize();
    if (surface.boundaries[b].kind == BoundaryKind::periodic)
      for (int d = 0; d < 3; ++d) periodic[d] = periodic[d] || std::abs(air.normal[b][d]) > 0.99;
  }
  air.options = options;
  air.rows = Rows(voxels, periodic);
  air.links = build_links(air.rows, surface, options.wall);
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
  std::vector<float> length2;
  if (options.eddy == Eddy::vreman && options.smagorinsky > 0.0) {
    length2.assign(slots, 0.0F);
    std::swap(length2, air.les);
  }
  air.gradients = make_velocity_gradients(air.rows, air.links, air.boundaries, options.law == Law::hrr, length2);
  return air;
}

CellMoments<double> moments_at(const Air& air, std::ptrdiff_t slot) {
  return std::visit(
      [&]<class T>(const Populations<T>& p) {
        const Run& run = air.rows.runs()[air.run_of_slot[slot]];
        double g[19];
        for (int i = 0; i < d3q19::q; ++i) g[i] = p.arrived(run, slot, i);
        const double none[3] = {0, 0, 0};
        return moments_of(hydrodynamics<false>([&](auto i) { return g[i]; }, none));
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

std::array<double, 3> force_on_patch(const Air& air, int boundary) {
  std::array<double, 3> force{0, 0, 0};
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        const Parity last = p.next == Parity::even ? Parity::odd : Parity::even;
        for (const WallRun& wall : air.links.walls) {
          const Run& run = air.rows.runs()[wall.run];
          int k = 0;
          for (int i = 1; i < d3q19::q; ++i) {
            if (!(wall.directions >> i & 1U)) continue;
            for (int n = 0; n < wall.count; ++n) {
              if (air.links.wall_patch[wall.coefficient + static_cast<std::size_t>(k) * wall.count + n] != boundary)
                continue;
              const std::ptrdiff_t slot = wall.first + n;
              const double exchanged = p.departed(run, slot, i, last) + p.arrived(run, slot, d3q19::opposite(i));
              for (int d = 0; d < 3; ++d) force[d] += exchanged * d3q19::velocity[i][d];
            }
            ++k;
          }
        }
        for (const SlipLink& link : air.links.slip) {
          if (link.patch != boundary) continue;
          const double f = p.departed(air.rows.runs()[link.source_run], link.source, link.source_direction, last);
          const auto &in = d3q19::velocity[link.source_direction], &out = d3q19::velocity[link.direction];
          for (int d = 0; d < 3; ++d) force[d] += f * (in[d] + out[d]);  // what comes back moves against `direction`
        }
      },
      air.populations);
  return force;
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
