#include "lbm/plane_flux.hpp"

#include <set>
#include <utility>

namespace puffin::lbm {

namespace {

/// Half of what the links of both layers exchange with sliding walls: each lies in the plane with one of its ends.
/// Walls that only let go of a plug carry nothing from cell to cell: each cell gives back what it gains there.
double moved_by_walls(const Air& air, int axis, int index, int next) {
  double moved = 0.0;
  for (const WallRun& wall : air.links.walls) {
    if (!wall.moving) continue;
    for (int n = 0; n < wall.count; ++n) {
      const int layer = air.rows.cell(wall.first + n)[axis];
      int k = -1;
      for (int i = 1; i < d3q19::q; ++i) {
        if (!(wall.directions >> i & 1U)) continue;
        ++k;
        const int sign = d3q19::velocity[i][axis];  // towards the plane
        const std::size_t at = wall.coefficient + static_cast<std::size_t>(k) * wall.count + n;
        if (sign == 0 || layer != (sign > 0 ? index : next)) continue;
        if (!air.boundaries[air.links.wall_patch[at]].slides) continue;
        moved -= 0.5 * sign * air.links.moving[at];
      }
    }
  }
  return moved;
}

}  // namespace

PlaneFlux plane_flux(const Air& air, double wall_speed, int axis, int index) {
  const Rows& rows = air.rows;
  const int layers = rows.box()[axis];
  if (index < -1 || index >= layers) return {};
  const int next = (index + 1) % layers;  // across a periodic face: the first layer
  if (index < 0) index = layers - 1;
  std::set<std::pair<std::ptrdiff_t, int>> cut;  // cell, direction towards a thin wall
  for (const auto& link : air.links.thin) {
    cut.insert({link.slot, link.direction});
    cut.insert({link.slot + neighbour_offset(rows.runs()[link.run], link.direction), d3q19::opposite(link.direction)});
  }
  PlaneFlux flux;
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        const auto arrived = [&](const Run& run, std::ptrdiff_t slot, int i) {
          if (p.next == Parity::even) return static_cast<double>(p.f[i * p.stride + slot]);
          const int o = d3q19::opposite(i);
          return static_cast<double>(p.f[o * p.stride + slot + neighbour_offset(run, o)]);
        };
        for (const Run& run : rows.runs())
          for (int n = 0; n < run.count; ++n) {
            const int here[3] = {run.x + n, run.y, run.z};
            if (here[axis] != index && here[axis] != next) {
              if (axis != 0) break;  // the whole run lies in another layer
              continue;
            }
            const std::ptrdiff_t slot = run.first + n;
            for (int i = 1; i < d3q19::q; ++i) {
              const auto& c = d3q19::velocity[i];
              const int sign = c[axis];
              if (sign == 0 || here[axis] != (sign > 0 ? next : index)) continue;
              if (rows.active_slot(here[0] - c[0], here[1] - c[1], here[2] - c[2]) < 0) continue;
              if (!cut.empty() && cut.count({slot, d3q19::opposite(i)}) > 0) continue;
              flux.mass += sign * arrived(run, slot, i);
              ++flux.links;
            }
          }
        for (const SlipLink& s : air.links.slip) {  // what slides along a slip wall into the other layer
          const int from = rows.cell(s.source)[axis], to = rows.cell(s.slot)[axis];
          const int sign = -d3q19::velocity[s.direction][axis];
          if (sign == 0 || from != (sign > 0 ? index : next) || to != (sign > 0 ? next : index)) continue;
          flux.mass += sign * arrived(rows.runs()[s.run], s.slot, d3q19::opposite(s.direction));
        }
      },
      air.populations);
  if (wall_speed != 0.0 && flux.links > 0) flux.mass += wall_speed * moved_by_walls(air, axis, index, next);
  return flux;
}

}  // namespace puffin::lbm
