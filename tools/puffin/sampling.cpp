#include "tools/puffin/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puffin::tools {

namespace {

using coupling::Vec3;

PointReading read_cell(const cases::Simulation& s, std::ptrdiff_t slot) {
  const auto m = lbm::moments_at(*s.state.air, slot);
  PointReading reading;
  reading.velocity = s.state.scale.speed() * Vec3(m.ux, m.uy, m.uz);
  reading.pressure = s.state.scale.pressure(m.density_excess);
  return reading;
}

double total_pressure(const cases::Simulation& s, const PointReading& r) {
  return r.pressure + 0.5 * s.models.air.density * r.velocity.squaredNorm();
}

}  // namespace

std::optional<PointReading> read_point(const cases::Simulation& s, const Vec3& x) {
  if (!s.state.air) return std::nullopt;
  const auto& rows = s.state.air->rows;
  const Vec3 at = (x - rows.origin()) / rows.dx();
  const int base[3] = {static_cast<int>(std::floor(at[0])), static_cast<int>(std::floor(at[1])),
                       static_cast<int>(std::floor(at[2]))};
  PointReading sum;
  double weight = 0.0;
  for (int n = 0; n < 8; ++n) {
    double w = 1.0;
    int c[3];
    for (int d = 0; d < 3; ++d) {
      const int high = n >> d & 1;
      const double part = at[d] - base[d];
      c[d] = base[d] + high;
      w *= high ? part : 1.0 - part;
    }
    const std::ptrdiff_t slot = rows.active_slot(c[0], c[1], c[2]);
    if (slot < 0 || w <= 0.0) continue;
    const PointReading r = read_cell(s, slot);
    sum.velocity += w * r.velocity;
    sum.pressure += w * r.pressure;
    weight += w;
  }
  if (weight < 1e-6) return std::nullopt;
  sum.velocity /= weight;
  sum.pressure /= weight;
  return sum;
}

DropReader::DropReader(const cases::Simulation& s) {
  if (!s.state.air) return;
  const auto& air = *s.state.air;
  // One cell inside the boundary cells: the reading is not that of the condition itself.
  const auto collect = [&](const std::vector<lbm::OpeningLink>& links, std::vector<Cell>& cells) {
    for (const auto& link : links) {
      if (link.direction > 6) continue;  // axis links only: each face cell once
      const std::ptrdiff_t inner =
          link.slot + lbm::neighbour_offset(air.rows.runs()[link.run], lbm::d3q19::opposite(link.direction));
      cells.push_back({air.rows.is_active(inner) ? inner : link.slot, link.patch});
    }
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.slot < b.slot; });
    cells.erase(std::unique(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.slot == b.slot; }),
                cells.end());
  };
  collect(air.links.inlets, inlet_);
  collect(air.links.outlets, outlet_);
}

DropReading DropReader::read(const cases::Simulation& s) const {
  DropReading reading;
  for (const auto& patch : s.models.patches)
    if (patch.is_inlet) reading.flow_rate += patch.speed(s.state.time) * patch.area;
  if (!has_both()) return reading;
  double p_in = 0.0, p_out = 0.0, flux = 0.0, carried = 0.0;
  for (const Cell& c : inlet_) {
    const PointReading r = read_cell(s, c.slot);
    const double inward = std::max(0.0, -r.velocity.dot(s.state.air->normal[c.patch]));
    p_in += r.pressure;
    flux += inward;
    carried += inward * total_pressure(s, r);
  }
  for (const Cell& c : outlet_) p_out += read_cell(s, c.slot).pressure;
  p_in /= static_cast<double>(inlet_.size());
  p_out /= static_cast<double>(outlet_.size());
  reading.static_drop = p_in - p_out;
  reading.total_to_static_drop = (flux > 0.0 ? carried / flux : p_in) - p_out;
  return reading;
}

PlaneReading read_plane(const cases::Simulation& s, int axis, double at) {
  const auto& rows = s.state.air->rows;
  const int layer = static_cast<int>(std::lround((at - rows.origin()[axis]) / rows.dx()));
  PlaneReading reading;
  double flux = 0.0, carried = 0.0;
  std::size_t cells = 0;
  for (const auto& run : rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const int c[3] = {run.x + n, run.y, run.z};
      if (c[axis] != layer) {
        if (axis != 0) break;
        continue;
      }
      const PointReading r = read_cell(s, run.first + n);
      const double u = r.velocity[axis];
      reading.flow_rate += u * rows.dx() * rows.dx();
      reading.static_pressure += r.pressure;
      flux += u;
      carried += u * total_pressure(s, r);
      ++cells;
    }
  if (cells == 0) throw std::invalid_argument("the plane at " + std::to_string(at) + " m lies outside the fluid");
  reading.static_pressure /= static_cast<double>(cells);
  reading.total_pressure = flux != 0.0 ? carried / flux : reading.static_pressure;
  return reading;
}

}  // namespace puffin::tools
