#include "tools/puffin/sampling.hpp"

#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/air_steps.hpp"
#include "lbm/plane_flux.hpp"
#include "lbm/wall_force.hpp"

namespace puffin::tools {

namespace {

using coupling::Vec3;

/// Speed of one cell a step, as the cells hold it [m/s].
double speed_unit(const cases::Simulation& s) { return s.dx / coupling::step_of_cells(s.models, s.state); }

double total_pressure(const cases::Simulation& s, const PointReading& r) {
  return r.pressure + 0.5 * s.models.air.density * r.velocity.squaredNorm();
}

}  // namespace

PointReading read_cell(const cases::Simulation& s, std::ptrdiff_t slot) {
  const auto m = lbm::moments_at(*s.state.air, slot);
  PointReading reading;
  reading.velocity = speed_unit(s) * Vec3(m.ux, m.uy, m.uz);
  if (s.models.body_force)
    reading.velocity += 0.5 * s.state.scale.dt / s.models.air.density * s.models.body_force(s.state.time);
  reading.pressure = s.state.scale.pressure(m.density_excess);
  return reading;
}

DropReader::DropReader(const cases::Simulation& s) {
  if (!s.state.air || s.models.frozen_air) return;  // a frozen field has no pressure
  const auto& air = *s.state.air;
  const auto collect = [&](const std::vector<lbm::OpeningLink>& links, std::vector<Cell>& cells) {
    for (const auto& link : links) {
      if (link.direction > 6) continue;  // axis links only: each face cell once
      const auto& c = lbm::d3q19::velocity[link.direction];
      const auto own = air.rows.cell(link.slot);
      const auto inside = [&](int n, std::ptrdiff_t otherwise) {
        const std::ptrdiff_t slot = air.rows.active_slot(own[0] - n * c[0], own[1] - n * c[1], own[2] - n * c[2]);
        return slot < 0 ? otherwise : slot;
      };
      const std::ptrdiff_t second = inside(1, link.slot);
      cells.push_back({second, second == link.slot ? second : inside(2, second), link.patch, air.outward(link)});
    }
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.slot < b.slot; });
    cells.erase(std::unique(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.slot == b.slot; }),
                cells.end());
  };
  collect(air.links.inlets, inlet_);
  collect(air.links.outlets, outlet_);
  const auto other = [&](const Cell& c) { return c.patch != outlet_.front().patch; };
  between_pressures_ = inlet_.empty() && std::any_of(outlet_.begin(), outlet_.end(), other);
}

DropReading DropReader::read(const cases::Simulation& s) const {
  DropReading reading;
  std::vector<char> enters(s.models.patches.size(), 0);
  for (std::size_t b = 0; b < s.models.patches.size(); ++b) {
    const auto& patch = s.models.patches[b];
    // A plug keeps its speed on the cells of the opening, which may cover more or less than it.
    const bool on_cells = s.state.air && !s.models.frozen_air && !s.state.air->boundaries[b].exact_flow;
    if (patch.is_inlet)
      reading.flow_rate +=
          patch.speed(s.state.time) * (on_cells ? s.state.air->links.opening_cells_area[b] * s.dx * s.dx : patch.area);
    enters[b] = patch.is_inlet ? 1 : 0;
    if (!between_pressures_ || s.state.air->boundaries[b].kind != lbm::BoundaryKind::pressure_outlet) continue;
    const double in = lbm::mass_through(*s.state.air, static_cast<int>(b));
    enters[b] = in > 0.0 ? 1 : 0;
    reading.flow_rate += std::max(0.0, in) * s.state.scale.flow_rate();
  }
  if (!has_both()) return reading;
  struct Layer {
    double pressure = 0.0, flux = 0.0, carried = 0.0;
  };
  Layer second, third;  // cells from the inlets
  double p_out = 0.0, cells_in = 0.0, cells_out = 0.0;
  for (const auto* cells : {&inlet_, &outlet_})
    for (const Cell& c : *cells) {
      const auto& held = s.models.patches[c.patch].pressure;
      const auto at = [&](std::ptrdiff_t slot) {
        PointReading r = read_cell(s, slot);
        if (held) r.pressure = held(s.state.time);
        return r;
      };
      if (enters[c.patch] == 0) {
        p_out += at(c.slot).pressure, cells_out += 1.0;
        continue;
      }
      cells_in += 1.0;
      for (Layer* layer : {&second, &third}) {
        const PointReading r = at(held || layer == &second ? c.slot : c.next);
        const double inward = std::max(0.0, -r.velocity.dot(c.outward));
        layer->pressure += r.pressure;
        layer->flux += inward;
        layer->carried += inward * total_pressure(s, r);
      }
    }
  if (cells_in == 0.0 || cells_out == 0.0) return reading;  // nothing moves yet
  const auto at_plane = [](double second_cell, double third_cell) { return 2.5 * second_cell - 1.5 * third_cell; };
  const double p_in = at_plane(second.pressure, third.pressure) / cells_in;
  const bool flows = second.flux > 0.0 && third.flux > 0.0;
  p_out /= cells_out;
  reading.static_drop = p_in - p_out;
  reading.total_to_static_drop =
      (flows ? at_plane(second.carried / second.flux, third.carried / third.flux) : p_in) - p_out;
  return reading;
}

Totals read_totals(const cases::Simulation& s) {
  struct Sums {
    double energy = 0.0;
    Vec3 momentum = Vec3::Zero();
  };
  Totals totals;
  if (s.state.air) {
    const auto& runs = s.state.air->rows.runs();
    using Range = oneapi::tbb::blocked_range<std::size_t>;
    const Sums sums = oneapi::tbb::parallel_deterministic_reduce(
        Range(0, runs.size(), 64), Sums{},
        [&](const Range& range, Sums sum) {
          for (std::size_t r = range.begin(); r < range.end(); ++r)
            for (int n = 0; n < runs[r].count; ++n) {
              if (!s.state.air->is_fluid(runs[r].first + n)) continue;
              const auto m = lbm::moments_at(*s.state.air, runs[r].first + n);
              const Vec3 u(m.ux, m.uy, m.uz);
              sum.energy += 0.5 * u.squaredNorm();
              sum.momentum += (1.0 + m.density_excess) * u;
            }
          return sum;
        },
        [](const Sums& a, const Sums& b) {
          return Sums{a.energy + b.energy, a.momentum + b.momentum};
        });
    const double speed = speed_unit(s), dx = s.state.air->rows.dx();
    totals.kinetic_energy = sums.energy * speed * speed / static_cast<double>(s.state.air->fluid_cells);
    totals.air_momentum = sums.momentum * (speed * s.models.air.density * dx * dx * dx);
    for (const Vec3& impulse : s.state.impulse_on_air) totals.air_momentum += impulse;
  }
  const auto& c = s.state.carriers.carriers;
  for (std::size_t p = 0; p < c.size(); ++p) totals.carrier_momentum += c.mass[p] * c.velocity[p];
  return totals;
}

namespace {

struct Layer {
  double pressure = 0.0, carried = 0.0, flux = 0.0;
  std::size_t cells = 0;
};

Layer read_layer(const cases::Simulation& s, int axis, int index) {
  const auto& rows = s.state.air->rows;
  Layer layer;
  for (const auto& run : rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const int c[3] = {run.x + n, run.y, run.z};
      if (c[axis] != index) {
        if (axis != 0) break;
        continue;
      }
      if (!s.state.air->is_fluid(run.first + n)) continue;  // behind a wall: moves air, has no pressure of the fluid
      const PointReading r = read_cell(s, run.first + n);
      const double u = r.velocity[axis];
      layer.pressure += r.pressure;
      layer.flux += u;
      layer.carried += u * total_pressure(s, r);
      ++layer.cells;
    }
  return layer;
}

PlaneReading reading_of(const Layer& layer) {
  PlaneReading r;
  r.static_pressure = layer.pressure / static_cast<double>(layer.cells);
  r.total_pressure = layer.flux != 0.0 ? layer.carried / layer.flux : r.static_pressure;
  return r;
}

/// The pressures on the straight line through those of two layers: at a for part = 0, at b for 1.
PlaneReading on_line(const Layer& a, const Layer& b, double part) {
  const PlaneReading at_a = reading_of(a), at_b = reading_of(b);
  PlaneReading r;
  r.static_pressure = (1.0 - part) * at_a.static_pressure + part * at_b.static_pressure;
  r.total_pressure = (1.0 - part) * at_a.total_pressure + part * at_b.total_pressure;
  return r;
}

/// Mass flow over the reference density [m^3/s] of one layer of cells: for a domain that has no other.
double flow_of_cells(const cases::Simulation& s, int axis, int index) {
  double flow = 0.0;
  for (const auto& run : s.state.air->rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const int c[3] = {run.x + n, run.y, run.z};
      if (c[axis] != index) continue;
      const PointReading r = read_cell(s, run.first + n);
      flow += (1.0 + s.state.scale.density_excess_lu(r.pressure)) * r.velocity[axis] * s.dx * s.dx;
    }
  return flow;
}

/// Mass flow over the reference density [m^3/s] at a plane `place` cells along `axis`: linear between those through the
/// faces of cells on both sides; beyond the outermost faces theirs. Empty: there are none.
std::optional<double> flow_through(const cases::Simulation& s, int axis, double place) {
  const int below = static_cast<int>(std::floor(place - 0.5));
  const double part = place - 0.5 - below, unit = speed_unit(s) * s.dx * s.dx;
  double wall_speed = 0.0;
  for (std::size_t p = 0; p < s.models.patches.size(); ++p)
    if (s.state.air->boundaries[p].kind == lbm::BoundaryKind::wall && s.models.patches[p].speed)
      wall_speed = s.models.patches[p].speed(s.state.time) / speed_unit(s);
  const auto flux = [&](int index) { return lbm::plane_flux(*s.state.air, wall_speed, axis, index); };
  const lbm::PlaneFlux low = flux(below);
  const lbm::PlaneFlux high = part > 0.0 || low.links == 0 ? flux(below + 1) : low;
  if (low.links == 0 && high.links == 0) return std::nullopt;
  if (low.links == 0) return unit * high.mass;
  if (high.links == 0) return unit * low.mass;
  return unit * ((1.0 - part) * low.mass + part * high.mass);
}

}  // namespace

std::optional<PlaneReading> read_plane(const cases::Simulation& s, int axis, double at) {
  const auto& rows = s.state.air->rows;
  const double place = (at - rows.origin()[axis]) / rows.dx();
  if (place < -0.5 - 1e-6 || place > rows.box()[axis] - 0.5 + 1e-6) return std::nullopt;
  const int below = static_cast<int>(std::floor(place)), layers = rows.box()[axis];
  const double part = place - below;
  const auto index_of = [&](int index) { return rows.periodic()[axis] ? (index + layers) % layers : index; };
  const auto layer = [&](int index) { return read_layer(s, axis, index_of(index)); };
  const Layer low = layer(below), high = layer(below + 1);
  if (low.cells == 0 && high.cells == 0) return std::nullopt;
  PlaneReading r;
  if (low.cells == high.cells) {
    r = on_line(low, high, part);
  } else if (low.cells == 0 || high.cells == 0) {  // at an end: the pressure still has its slope there
    const Layer& last = low.cells == 0 ? high : low;
    const Layer before = layer(low.cells == 0 ? below + 2 : below - 1);
    r = before.cells == last.cells ? on_line(last, before, low.cells == 0 ? part - 1.0 : -part) : reading_of(last);
  } else {
    r = reading_of(part >= 0.5 ? high : low);
  }
  const auto flow = flow_through(s, axis, place);
  r.flow_rate = flow ? *flow : flow_of_cells(s, axis, index_of(low.cells > 0 ? below : below + 1));
  return r;
}

ForceReader::ForceReader(const cases::Simulation& s) {
  if (!s.state.air || s.description.output.forces.empty()) return;
  outwards_.assign(s.surface.patches.names.size(), Vec3::Zero());
  for (std::size_t t = 0; t < s.surface.mesh.triangles.size(); ++t)
    outwards_[s.surface.patches.of_triangle[t]] += 0.5 * s.surface.mesh.area_vector(static_cast<int>(t));
  if (!s.models.body_force) return;
  lbm::LinkGeometry surface;
  surface.mesh = &s.surface.mesh;
  surface.patch_of_triangle = s.surface.patches.of_triangle;
  excess_ = lbm::wall_excess(*s.state.air, surface);
}

Vec3 ForceReader::read(const cases::Simulation& s, const std::string& patch) const {
  const lbm::Air& air = *s.state.air;
  Vec3 sum = Vec3::Zero();
  double excess = 0.0;
  const int one = s.surface.patches.find(patch);
  for (int b = 0; b < static_cast<int>(air.boundaries.size()); ++b) {
    if (one >= 0 ? b != one : air.boundaries[b].kind != lbm::BoundaryKind::wall) continue;
    const auto f = lbm::force_on_patch(air, b);
    sum += s.state.scale.force() * Vec3(f[0], f[1], f[2]) + s.state.scale.base * outwards_.at(b);
    if (!excess_.empty()) excess += excess_[b];
  }
  if (excess != 0.0) sum -= excess * std::pow(s.state.scale.dx, 3) * s.models.body_force(s.state.time);
  return sum;
}

}  // namespace puffin::tools
