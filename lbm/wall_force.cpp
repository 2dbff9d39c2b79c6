// Force of the air on a patch, and what a body force on whole cells adds to it.

#include "lbm/wall_force.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lbm/wall_schemes.hpp"

namespace puffin::lbm {

namespace {

/// The direction along axis d that a direction contains; 0 if its component is zero.
int axis_of(int direction, int d) {
  const int c = d3q19::velocity[direction][d];
  return c == 0 ? 0 : 2 * d + (c > 0 ? 1 : 2);
}

/// What lies beyond the faces of the cells at openings and slip walls: the patch, or none (an opening).
class Faces {
 public:
  static constexpr int none = -1;

  explicit Faces(const Air& air) {
    const auto add = [&](std::ptrdiff_t slot, int direction, int patch) {
      if (direction <= 6) faces_.push_back({key(slot, direction), patch});
      cells_.push_back(slot);
    };
    for (const auto* list : {&air.links.inlets, &air.links.outlets})
      for (const OpeningLink& link : *list) add(link.slot, link.direction, none);
    for (const SlipLink& link : air.links.slip) add(link.slot, link.direction, link.patch);
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    if (cells_.empty()) return;
    for (const WallRun& wall : air.links.walls)
      for (int n = 0; n < wall.count; ++n) {
        if (!std::binary_search(cells_.begin(), cells_.end(), wall.first + n)) continue;
        for (int i = 1; i <= 6; ++i)
          if (wall.directions >> i & 1U) faces_.push_back({key(wall.first + n, i), patch_of(air, wall, i, n)});
      }
    std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  }

  /// Beyond the face in an axis direction; `otherwise` if nothing cuts that link.
  int patch(std::ptrdiff_t slot, int direction, int otherwise) const {
    const std::int64_t wanted = key(slot, direction);
    const auto at = std::lower_bound(faces_.begin(), faces_.end(), wanted,
                                     [](const Face& face, std::int64_t value) { return face.key < value; });
    return at != faces_.end() && at->key == wanted ? at->patch : otherwise;
  }

  static int patch_of(const Air& air, const WallRun& wall, int i, int n) {
    const auto k = static_cast<std::size_t>(std::popcount(wall.directions & ((1U << i) - 1U)));
    return air.links.wall_patch[wall.coefficient + k * static_cast<std::size_t>(wall.count) + n];
  }

 private:
  struct Face {
    std::int64_t key = 0;
    int patch = none;
  };
  static std::int64_t key(std::ptrdiff_t slot, int direction) {
    return static_cast<std::int64_t>(slot) * 8 + direction;
  }
  std::vector<Face> faces_;
  std::vector<std::ptrdiff_t> cells_;
};

/// The link ends on its wall nearer than half-way, so before it would leave through another face: its cell then has its
/// mirror image on the same wall.
bool before_edge(const Air& air, const WallRun& wall, int i, int n) {
  const auto k = static_cast<std::size_t>(std::popcount(wall.directions & ((1U << i) - 1U)));
  const float partner = air.links.partner[wall.coefficient + k * static_cast<std::size_t>(wall.count) + n];
  return !(wall.far >> i & 1U) && partner > 2e-3F;  // 1 - 2q
}

/// Adds what a cut link exchanged to the force on `boundary`. A link along a face diagonal leaves through two faces of
/// its cell. Where these belong to two patches and it ends at the edge, the pressure in the momentum along an axis acts
/// on the patch beyond that axis's face, over all of whose area it acts so; the rest of it, friction, on the other
/// patch. `beyond`: the patch beyond the face in an axis direction.
template <class Beyond>
void add_link(const Air& air, std::ptrdiff_t slot, int i, double exchanged, int boundary, const Beyond& beyond,
              std::array<double, 3>& force) {
  int axis[2] = {0, 0}, patch[2] = {0, 0}, parts = 0;
  for (int d = 0; d < 3; ++d)
    if (d3q19::velocity[i][d] != 0) {
      axis[parts] = d;
      patch[parts++] = beyond(axis_of(i, d));
    }
  if (parts == 1 || patch[0] == patch[1]) {
    if (patch[0] != boundary) return;
    for (int d = 0; d < 3; ++d) force[d] += exchanged * d3q19::velocity[i][d];
    return;
  }
  if (patch[0] != boundary && patch[1] != boundary) return;
  const double pressure = 2.0 * d3q19::weight[i] * moments_at(air, slot).density_excess;
  for (int n = 0; n < 2; ++n) {
    const double c = d3q19::velocity[i][axis[n]];
    if (patch[n] == boundary) force[axis[n]] += c * pressure;
    if (patch[1 - n] == boundary) force[axis[n]] += c * (exchanged - pressure);
  }
}

}  // namespace

std::array<double, 3> force_on_patch(const Air& air, int boundary) {
  std::array<double, 3> force = force_on_cells(air, boundary);
  const Faces faces(air);
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        const Parity last = p.next == Parity::even ? Parity::odd : Parity::even;
        const auto exchanged = [&](const Run& run, std::ptrdiff_t slot, int i) -> double {
          return p.departed(run, slot, i, last) + p.arrived(run, slot, d3q19::opposite(i));
        };
        for (const WallRun& wall : air.links.walls)
          for (int i = 1; i < d3q19::q; ++i) {
            if (!(wall.directions >> i & 1U)) continue;
            for (int n = 0; n < wall.count; ++n) {
              const int own = Faces::patch_of(air, wall, i, n);
              const std::ptrdiff_t slot = wall.first + n;
              const auto beyond = [&](int axis) {
                if (before_edge(air, wall, i, n)) return own;
                if (wall.directions >> axis & 1U) return Faces::patch_of(air, wall, axis, n);
                return faces.patch(slot, axis, own);
              };
              add_link(air, slot, i, exchanged(air.rows.runs()[wall.run], slot, i), boundary, beyond, force);
            }
          }
        // Both sides of a thin wall got back what they had sent; the wall took twice the difference.
        for (const Links::ThinLink& link : air.links.thin) {
          if (link.patch != boundary) continue;
          const Run& run = air.rows.runs()[link.run];
          const auto c = air.rows.cell(link.slot + neighbour_offset(run, link.direction));
          const std::ptrdiff_t beside = air.rows.active_slot(c[0], c[1], c[2]);
          const double sent = p.arrived(run, link.slot, d3q19::opposite(link.direction)),
                       met = p.arrived(air.rows.runs()[air.run_of_slot[beside]], beside, link.direction);
          for (int d = 0; d < 3; ++d) force[d] += 2.0 * (sent - met) * d3q19::velocity[link.direction][d];
        }
        for (const auto* list : {&air.links.inlets, &air.links.outlets})
          for (const OpeningLink& link : *list) {
            const auto beyond = [&](int axis) { return faces.patch(link.slot, axis, Faces::none); };
            const double all = exchanged(air.rows.runs()[link.run], link.slot, link.direction);
            add_link(air, link.slot, link.direction, all, boundary, beyond, force);
          }
        for (const SlipLink& link : air.links.slip)
          for (int d = 0; d < 3; ++d) {
            const int axis = axis_of(link.direction, d);
            if (axis == 0 || faces.patch(link.slot, axis, link.patch) != boundary) continue;
            const double f = p.departed(air.rows.runs()[link.source_run], link.source, link.source_direction, last);
            const auto &in = d3q19::velocity[link.source_direction], &out = d3q19::velocity[link.direction];
            force[d] += f * (in[d] + out[d]);  // what comes back moves against `direction`
          }
      },
      air.populations);
  return force;
}

std::vector<double> wall_excess(const Air& air, const LinkGeometry& surface) {
  std::vector<double> excess(air.boundaries.size(), 0.0);
  const geometry::TriangleTree tree(*surface.mesh);
  const Rows& rows = air.rows;
  std::vector<char> image(rows.slots(), 0);
  for (const auto& [ghost, active] : rows.periodic_images()) image[ghost] = 1;
  const double dx = rows.dx(), band = 4.0 * dx;
  for (std::ptrdiff_t slot = 0; slot < static_cast<std::ptrdiff_t>(rows.slots()); ++slot) {
    const bool active = rows.is_active(slot);
    if (!active && (!rows.is_ghost(slot) || image[slot])) continue;
    const bool in_fluid = active && air.is_fluid(slot);
    const auto wall = tree.closest(rows.centre(slot), active && !in_fluid ? band : 0.5 * dx);
    if (wall.triangle < 0) continue;
    const int patch = surface.patch_of_triangle[wall.triangle];
    if (patch < 0 || air.boundaries[patch].kind != BoundaryKind::wall) continue;
    const double share = std::clamp(0.5 + (in_fluid ? 1.0 : -1.0) * wall.distance / dx, 0.0, 1.0);  // of fluid
    excess[patch] += (active ? 1.0 : 0.0) - share;
  }
  return excess;
}

}  // namespace puffin::lbm
