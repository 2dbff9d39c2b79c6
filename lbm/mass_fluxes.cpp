#include "lbm/mass_fluxes.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace puffin::lbm {

namespace {

using Cell = std::array<int, 3>;

Cell moved(Cell c, int axis, int sign) {
  c[axis] += sign;
  return c;
}

}  // namespace

FluxRoutes find_routes(const Air& air, FaceFluxes& fluxes) {
  const Rows& rows = air.rows;
  FluxRoutes routes;
  for (int d = 0; d < 3; ++d) {
    fluxes.mass[d].assign(rows.slots(), 0.0);
    fluxes.open[d].assign(rows.slots(), 0);
    routes.shares[d].assign(rows.slots(), 0);
  }
  fluxes.density.assign(rows.slots(), 1.0);
  const auto fluid = [&](const Cell& c) { return rows.active_slot(c[0], c[1], c[2]) >= 0; };
  // Links between active cells that a thin wall cuts carry nothing.
  std::vector<std::uint32_t> cut(rows.slots(), 0);
  for (const auto& link : air.links.thin) {
    cut[link.slot] |= 1U << link.direction;
    const std::ptrdiff_t other = link.slot + neighbour_offset(rows.runs()[link.run], link.direction);
    cut[other] |= 1U << d3q19::opposite(link.direction);
  }
  const auto link_open = [&](const Cell& from, const Cell& to) {
    const std::ptrdiff_t s = rows.active_slot(from[0], from[1], from[2]);
    if (s < 0 || !fluid(to)) return false;
    for (int i = 1; i < d3q19::q; ++i) {
      const auto& c = d3q19::velocity[i];
      if (c[0] == to[0] - from[0] && c[1] == to[1] - from[1] && c[2] == to[2] - from[2]) return !(cut[s] >> i & 1U);
    }
    return false;
  };
  /// Halves of the diagonal from -> to that pass through `via`.
  const auto halves = [&](const Cell& from, const Cell& to, const Cell& via, const Cell& other) {
    if (!link_open(from, to) || !link_open(from, via) || !link_open(via, to)) return 0;
    return link_open(from, other) && link_open(other, to) ? 1 : 2;
  };
  for (const Run& run : rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const std::ptrdiff_t s = run.first + n;
      const Cell here{run.x + n, run.y, run.z};
      for (int d = 0; d < 3; ++d) {
        const Cell ahead = moved(here, d, 1);
        if (!link_open(here, ahead)) continue;
        fluxes.open[d][s] = 1;
        int k = 0, code = 0;
        for (int step = 1; step <= 2; ++step) {
          const int b = (d + step) % 3;
          for (const int sb : {-1, 1}) {
            const Cell beside = moved(here, b, sb), far = moved(ahead, b, sb);
            code |= halves(here, far, ahead, beside) << (2 * k++);
            code |= halves(beside, ahead, here, far) << (2 * k++);
          }
        }
        routes.shares[d][s] = static_cast<std::uint16_t>(code);
      }
    }
  // Openings: every link of a cell that an opening cuts is booked on one face of that cell, along the opening's normal;
  // that of a cell of the band behind a wall on the face of the fluid cell that it passes.
  std::set<std::array<std::ptrdiff_t, 3>> faces;  // slot, direction, patch
  if (air.markers)
    for (const auto& link : air.links.outlets)
      if (link.direction <= 6) faces.insert({link.slot, link.direction, link.patch});
  const auto booked = [&](const OpeningLink& link) {
    if (!air.markers || air.is_fluid(link.slot)) return link.slot;
    const auto cell = rows.cell(link.slot);
    for (int i = 1; i <= 6; ++i) {
      Cell beside = cell;
      int along = 0;
      for (int d = 0; d < 3; ++d) {
        const int c = d3q19::velocity[link.direction][d], a = d3q19::velocity[i][d];
        along += a * c;
        if (a == 0) beside[d] += c;
      }
      const std::ptrdiff_t other = along > 0 ? rows.active_slot(beside[0], beside[1], beside[2]) : -1;
      if (other >= 0 && faces.contains({other, i, link.patch})) return other;
    }
    return link.slot;
  };
  for (const auto* list : {&air.links.inlets, &air.links.outlets})
    for (const auto& link : *list) {
      const std::ptrdiff_t own = booked(link);
      const Run& run = rows.runs()[air.run_of_slot[own]];
      const auto& away = d3q19::velocity[link.direction];
      const geometry::Vec3& mean = air.outward(link);
      const geometry::Vec3 normal = mean.isZero() ? geometry::Vec3(away[0], away[1], away[2]) : mean;
      int best = 0;
      double most = -2.0;
      for (int i = 1; i <= 6; ++i) {
        const auto& c = d3q19::velocity[i];
        const double along = normal.dot(geometry::Vec3(c[0], c[1], c[2]));
        if (along > most && rows.is_ghost(own + neighbour_offset(run, i))) {
          most = along;
          best = i;
        }
      }
      if (best == 0) continue;  // a cell that touches the opening by a corner alone has no face to book on
      const int axis = (best - 1) / 2, sign = best % 2 ? 1 : -1;
      const std::ptrdiff_t face = sign > 0 ? own : own + neighbour_offset(run, best);
      fluxes.open[axis][face] = 2;
      routes.openings.push_back(
          {link.slot, link.run, link.direction, static_cast<std::int8_t>(axis), static_cast<std::int8_t>(sign), face});
    }
  // What of the cells' sides lies in an oblique opening and takes no flux: there is no wall.
  for (const auto* list : {&air.links.inlets, &air.links.outlets})
    for (const auto& link : *list) {
      if (link.direction > 6) continue;
      const int axis = (link.direction - 1) / 2;
      const bool high = link.direction % 2 == 1;
      const std::ptrdiff_t face =
          high ? link.slot : link.slot + neighbour_offset(rows.runs()[link.run], link.direction);
      if (fluxes.open[axis][face] == 0) fluxes.open[axis][face] = passed_over;
    }
  for (const SlipLink& link : air.links.slip) {
    if (link.source == link.slot) continue;
    // The part of the velocity that the wall leaves as it is.
    const auto &in = d3q19::velocity[link.source_direction], &out = d3q19::velocity[link.direction];
    for (int d = 0; d < 3; ++d)
      if (in[d] != 0 && in[d] == -out[d])
        routes.slips.push_back({link.source, link.source_run, link.source_direction, static_cast<std::int8_t>(d),
                                static_cast<std::int8_t>(in[d]), in[d] > 0 ? link.source : link.slot});
  }
  routes.band = find_band_fluxes(air, fluxes);
  for (const auto& [ghost, active] : rows.periodic_images()) {
    routes.images.push_back({ghost, active});
    for (int d = 0; d < 3; ++d)
      if (fluxes.open[d][active] == 1) fluxes.open[d][ghost] = 1;
  }
  return routes;
}

void find_mass_fluxes(const Air& air, const FluxRoutes& routes, double wall_speed, FaceFluxes& fluxes) {
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        FluxInput<T> input;
        input.f = p.f.data();
        input.stride = p.stride;
        input.runs = air.rows.runs().data();
        input.next = p.next;
        for (int d = 0; d < 3; ++d) {
          input.routes[d] = routes.shares[d].data();
          input.open[d] = routes.band.open[d].empty() ? fluxes.open[d].data() : routes.band.open[d].data();
          input.mass[d] = fluxes.mass[d].data();
        }
        input.density = fluxes.density.data();
        const FluxKernel<T> kernel = select_flux_kernel<T>(air.options.isa);
        for_each_chunk(air.rows, [&](int, const Chunk& chunk) {
          FluxInput<T> mine = input;
          mine.first_run = chunk.first_run;
          mine.last_run = chunk.last_run;
          kernel(mine);
        });
        const Parity last = p.next == Parity::even ? Parity::odd : Parity::even;
        for (const auto& o : routes.openings) fluxes.mass[o.axis][o.face] = 0.0;
        for (const auto& o : routes.openings) {
          const Run& run = air.rows.runs()[o.run];
          const double out = static_cast<double>(p.departed(run, o.slot, o.direction, last)) -
                             static_cast<double>(p.arrived(run, o.slot, d3q19::opposite(o.direction)));
          fluxes.mass[o.axis][o.face] += o.sign * out;
        }
        for (const auto& s : routes.slips)
          fluxes.mass[s.axis][s.face] +=
              s.sign * static_cast<double>(p.departed(air.rows.runs()[s.run], s.source, s.direction, last));
      },
      air.populations);
  for (const Links::Carried& c : air.links.carried) fluxes.mass[c.axis][c.face] += wall_speed * c.mass;
  book_band_fluxes(routes.band, fluxes);
  for (const auto& image : routes.images)
    for (int d = 0; d < 3; ++d) fluxes.mass[d][image.ghost] = fluxes.mass[d][image.active];
}

}  // namespace puffin::lbm
