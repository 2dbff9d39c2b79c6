#include "lbm/links.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "lbm/cut_finder.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/inlet_gains.hpp"
#include "lbm/link_schedule.hpp"
#include "lbm/moving_walls.hpp"
#include "lbm/opening_flow.hpp"
#include "lbm/populations.hpp"
#include "lbm/slip.hpp"
#include "lbm/wall_sides.hpp"

namespace puffin::lbm {

using geometry::Vec3;

namespace {

/// How a wall at distance q interpolates: weight of f_out(x-c), or of f_own where q >= 1/2 (far); zero, so half-way
/// reflection, where the cell it comes from is cut off by a wall. Beyond an opening, f_out(x-c) is what comes back
/// there.
struct Interpolation {
  bool far = false;
  float weight = 0.0F;
};
Interpolation interpolation(double q, bool behind_open, bool own_valid) {
  if (q < 0.5) return {false, behind_open ? static_cast<float>(1.0 - 2.0 * q) : 0.0F};
  return {true, own_valid ? static_cast<float>(1.0 - 1.0 / (2.0 * q)) : 0.0F};
}

/// Sorted, and joined where ghost and active slot advance together: first and last of each stretch. Every image stands
/// for itself, so their order is free; slices one cell thick are all periodic faces, and copying them cell by cell,
/// direction after direction, took four fifths of their steps.
std::vector<Links::Image> in_stretches(std::vector<Links::Image> images) {
  std::sort(images.begin(), images.end(), [](const auto& a, const auto& b) {
    return std::tie(a.direction, a.ghost) < std::tie(b.direction, b.ghost);
  });
  std::vector<Links::Image> ends;
  for (const Links::Image& image : images) {
    const bool joins = !ends.empty() && ends.back().direction == image.direction &&
                       ends.back().ghost + 1 == image.ghost && ends.back().active + 1 == image.active;
    if (joins)
      ends.back() = image;
    else
      ends.insert(ends.end(), 2, image);
  }
  return ends;
}

std::int16_t part_at(const Boundary& boundary, const Vec3& x) {
  return boundary.parts ? static_cast<std::int16_t>(boundary.parts->nearest(x)) : std::int16_t{0};
}

}  // namespace

Links build_links(const Rows& rows, const LinkGeometry& surface, WallScheme scheme, const CellKinds& kinds) {
  const auto& runs = rows.runs();
  const bool half = scheme != WallScheme::bouzidi;
  const CutFinder finder(rows, surface, kinds, scheme == WallScheme::ibm);
  // Find the cuts of every run in parallel, then lay them out in order.
  std::vector<std::vector<std::vector<Cut>>> of_run(runs.size());
  std::vector<std::size_t> missed(runs.size(), 0);
  oneapi::tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t r) {
    of_run[r].resize(runs[r].count);
    for (int n = 0; n < runs[r].count; ++n) of_run[r][n] = finder.cuts(runs[r], runs[r].first + n, missed[r]);
  });

  Links links;
  for (const std::size_t m : missed) links.missed += m;
  int wall_patch = -1;  // patch of links without a triangle
  bool any_moving = false;
  for (std::size_t b = 0; b < surface.boundaries.size(); ++b)
    if (surface.boundaries[b].kind == BoundaryKind::wall) {
      if (wall_patch < 0) wall_patch = static_cast<int>(b);
      any_moving = any_moving || static_cast<bool>(surface.boundaries[b].profile);
    }
  const auto kind_of = [&](const Cut& cut) {
    return cut.patch < 0 ? BoundaryKind::wall : surface.boundaries[cut.patch].kind;
  };
  const auto is_opening = [](BoundaryKind k) {
    return k == BoundaryKind::velocity_inlet || k == BoundaryKind::pressure_outlet;
  };
  // Links through the edge between an opening and another patch, which rounding gives to either, and past the edge of
  // an outlet, to the air beside a wall that the outlet's cells alone would see. A slip wall: the air beyond it is the
  // mirror image of this side, so what comes back is what comes from the opening (as a wall it held the air beside the
  // edge). A wall: the link is the wall's, as those of the cells before it. Along a moving wall it gives to one side of
  // a cell what it takes from the other, and the cell in the corner of an outlet lost u/6 a step; flow between plates,
  // driven by pressures, was 1 to 2 % too fast.
  std::vector<InletEdge> edges;  // such links at an inlet, taken by a wall that slides
  const auto settle_edges = [&](std::ptrdiff_t slot, std::vector<Cut>& cuts) {
    const auto cut_along = [&](int axis, int sign) -> const Cut* {
      for (const Cut& cut : cuts)
        if (cut.direction <= 6 && d3q19::velocity[cut.direction][axis] == sign) return &cut;
      return nullptr;
    };
    for (Cut& cut : cuts) {
      if (cut.thin || cut.direction <= 6) continue;
      const BoundaryKind own = kind_of(cut);
      const auto& c = d3q19::velocity[cut.direction];
      for (int d = 0; d < 3; ++d) {
        const Cut* face = c[d] == 0 ? nullptr : cut_along(d, c[d]);
        if (face == nullptr) continue;
        const int other = c[(d + 1) % 3] != 0 ? (d + 1) % 3 : (d + 2) % 3;
        const Cut* beside = cut_along(other, c[other]);
        const BoundaryKind kind = kind_of(*face);
        const bool is_wall = kind == BoundaryKind::wall;
        const bool moves = is_wall && face->patch >= 0 && surface.boundaries[face->patch].profile;
        const bool ends_outlet =
            own == BoundaryKind::pressure_outlet && is_wall && beside != nullptr && kind_of(*beside) == own;
        if ((own == BoundaryKind::slip && is_opening(kind)) || (is_opening(own) && moves) || ends_outlet) {
          cut.patch = face->patch;
          if (is_wall) cut.q = face->q;
        }
        if (moves && surface.boundaries[face->patch].slides && cut.patch == face->patch && beside != nullptr &&
            kind_of(*beside) == BoundaryKind::velocity_inlet) {
          const Vec3 direction(c[0], c[1], c[2]), at = rows.centre(slot) + 0.5 * rows.dx() * direction;
          const auto brings = [&](int patch) { return gain_of(cut.direction, surface.boundaries[patch].profile(at)); };
          edges.push_back({slot, beside->direction, face->patch, beside->patch,
                           part_at(surface.boundaries[beside->patch], at), brings(beside->patch), brings(face->patch)});
        }
      }
    }
  };
  const double dx = rows.dx();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Run& run = runs[r];
    int previous_end = -1;
    for (int n = 0; n < run.count; ++n) {
      auto& cuts = of_run[r][n];
      if (cuts.empty()) continue;
      const std::ptrdiff_t slot = run.first + n;
      const Vec3 centre = rows.centre(slot);
      settle_edges(slot, cuts);
      std::uint32_t walls = 0, far = 0;
      for (const Cut& cut : cuts) {
        if (cut.thin) {
          const std::ptrdiff_t other = slot + neighbour_offset(run, cut.direction);
          const auto p = static_cast<std::int16_t>(cut.patch < 0 ? wall_patch : cut.patch);
          if (slot < other) links.thin.push_back({slot, static_cast<std::int32_t>(r), cut.direction, p});
        } else if (kind_of(cut) == BoundaryKind::wall) {
          walls |= 1U << cut.direction;
          if (half || cut.q >= 0.5F) far |= 1U << cut.direction;
        } else {
          const auto& boundary = surface.boundaries[cut.patch];
          const auto& c = d3q19::velocity[cut.direction];
          const Vec3 direction(c[0], c[1], c[2]);
          OpeningLink link{slot, static_cast<std::int32_t>(r), cut.direction, cut.patch, 0.0};
          if (boundary.kind == BoundaryKind::slip) {
            links.slip.push_back({slot, slot, link.run, link.run, cut.direction, cut.direction, cut.patch});
          } else if (boundary.kind == BoundaryKind::velocity_inlet) {
            const Vec3 at = centre + static_cast<double>(cut.q) * dx * direction, u = boundary.profile(at);
            link.gain = gain_of(cut.direction, u);
            link.cubic = cubic_gain_of(cut.direction, u);
            link.part = part_at(boundary, at);
            links.inlets.push_back(link);
          } else {
            links.outlets.push_back(link);
          }
        }
      }
      if (walls == 0) continue;
      if (previous_end == n && links.walls.back().directions == walls && links.walls.back().far == far) {
        ++links.walls.back().count;
      } else {
        links.walls.push_back({slot, 1, walls, far, static_cast<std::int32_t>(r)});
      }
      previous_end = n + 1;
    }
  }

  // Coefficients, direction by direction within a wall run.
  std::size_t total = 0;
  for (auto& w : links.walls) {
    w.coefficient = total;
    total += static_cast<std::size_t>(w.count) * std::popcount(w.directions);
  }
  links.partner.assign(total, 0.0F);
  links.wall_patch.assign(total, 0);
  if (any_moving) links.moving.assign(total, 0.0F);
  for (auto& w : links.walls) {
    const Run& run = runs[w.run];
    for (int n = 0; n < w.count; ++n) {
      const std::ptrdiff_t slot = w.first + n;
      const auto& cuts = of_run[w.run][slot - run.first];
      std::uint32_t closed = 0, thin = 0;  // an inlet or outlet behind gives what the air beyond it would have
      for (const Cut& cut : cuts) {
        if (cut.thin || !is_opening(kind_of(cut))) closed |= 1U << cut.direction;
        if (cut.thin) thin |= 1U << cut.direction;
      }
      int k = 0;
      for (int i = 1; i < d3q19::q; ++i) {
        if (!(w.directions >> i & 1U)) continue;
        const auto cut = std::find_if(cuts.begin(), cuts.end(), [&](const Cut& c) { return c.direction == i; });
        const std::size_t at = w.coefficient + static_cast<std::size_t>(k++) * w.count + n;
        const int o = d3q19::opposite(i);
        const double q = half ? 0.5 : cut->q;
        links.partner[at] = interpolation(q, !(closed >> o & 1U), !(thin >> o & 1U)).weight;
        const int patch = cut->patch < 0 ? wall_patch : cut->patch;
        links.wall_patch[at] = static_cast<std::int16_t>(patch);
        if (any_moving && surface.boundaries[patch].profile) {
          // Reflected at a moving surface: -6 w c.u_wall, over the weight of f_out (2 for q < 1/2 halves, Bouzidi eq.
          // 9).
          const auto& c = d3q19::velocity[i];
          const Vec3 direction(c[0], c[1], c[2]);
          const Vec3 u = surface.boundaries[patch].profile(rows.centre(slot) + q * dx * direction);
          const double share = q < 0.5 ? 1.0 : 1.0 / (2.0 * q);
          w.moving = w.moving || u.norm() > 0.0;
          links.moving[at] = static_cast<float>(-6.0 * d3q19::weight[i] * share * direction.dot(u));
        }
      }
    }
  }

  if (any_moving) carry_along_walls(rows, surface, links);

  set_inlet_flow(rows, surface, edges, links);

  join_slip_links(rows, links.slip);
  links.schedule = std::make_shared<const LinkSchedule>(schedule_links(rows, links, kinds.fluid));

  std::vector<Links::Image> images, corners;
  for (const auto& [ghost, active] : rows.periodic_images()) {
    const auto g = rows.cell(ghost);
    for (int i = 1; i < d3q19::q; ++i) {
      const auto& c = d3q19::velocity[i];
      const std::ptrdiff_t from = rows.slot(g[0] - c[0], g[1] - c[1], g[2] - c[2]);
      if (from < 0) continue;
      const bool mirrored = rows.active_slot(g[0] - c[0], g[1] - c[1], g[2] - c[2]) >= 0;
      if (rows.is_active(from))
        images.push_back({static_cast<std::int16_t>(i), ghost, active});
      else if (mirrored)
        corners.push_back({static_cast<std::int16_t>(i), ghost, active});
    }
  }
  links.images = in_stretches(std::move(images));
  links.corner_images = in_stretches(std::move(corners));
  return links;
}

}  // namespace puffin::lbm
