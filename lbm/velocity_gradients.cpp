#include "lbm/velocity_gradients.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "lbm/vreman.hpp"

namespace puffin::lbm {

namespace {

using Side = EdgeAxis::Side;

/// What a link along an axis meets, where it is not the neighbouring cell.
struct Meets {
  Side side = Side::none;
  double distance = 1.0;  // in cells
  int patch = -1;
};
using Met = std::map<std::pair<std::ptrdiff_t, int>, Meets>;  // by slot and direction

/// Distance of the surface at which the wall scheme reflects, from its weight of the second population (links.hpp).
double distance_of(bool far, double partner) { return far ? 0.5 / (1.0 - partner) : 0.5 * (1.0 - partner); }

Met links_along_axes(const Rows& rows, const Links& links) {
  Met met;
  for (const WallRun& wall : links.walls) {
    int k = 0;
    for (int i = 1; i < d3q19::q; ++i) {
      if (!(wall.directions >> i & 1U)) continue;
      if (i <= 6)
        for (int n = 0; n < wall.count; ++n) {
          const std::size_t at = wall.coefficient + static_cast<std::size_t>(k) * wall.count + n;
          met[{wall.first + n, i}] = {Side::wall, distance_of((wall.far >> i & 1U) != 0, links.partner[at]),
                                      links.wall_patch[at]};
        }
      ++k;
    }
  }
  for (const SlipLink& link : links.slip)
    if (link.direction <= 6) met[{link.slot, link.direction}] = {Side::mirror, 1.0, link.patch};
  for (const auto& link : links.thin) {
    if (link.direction > 6) continue;
    met[{link.slot, link.direction}] = {Side::wall, 0.5, link.patch};
    const Run& run = rows.runs()[link.run];
    met[{link.slot + neighbour_offset(run, link.direction), d3q19::opposite(link.direction)}] = {Side::wall, 0.5,
                                                                                                 link.patch};
  }
  for (const auto* list : {&links.inlets, &links.outlets})
    for (const auto& link : *list)
      if (link.direction <= 6) met[{link.slot, link.direction}] = {Side::none, 1.0, link.patch};
  return met;
}

/// Weights of the velocities below, here and above at the distances h.
std::array<float, 3> difference(const std::array<Side, 2>& side, const std::array<double, 2>& h) {
  std::array<double, 3> w{0, 0, 0};
  if (side[0] == Side::none && side[1] == Side::none) return {0, 0, 0};
  if (side[0] == Side::none)
    w = {0.0, -1.0 / h[1], 1.0 / h[1]};
  else if (side[1] == Side::none)
    w = {-1.0 / h[0], 1.0 / h[0], 0.0};
  else if (std::min(h[0], h[1]) < 0.5)
    w = {-1.0 / (h[0] + h[1]), 0.0, 1.0 / (h[0] + h[1])};
  else
    w = {-h[1] / (h[0] * (h[0] + h[1])), (h[1] - h[0]) / (h[0] * h[1]), h[0] / (h[1] * (h[0] + h[1]))};
  return {static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2])};
}

}  // namespace

VelocityGradients make_velocity_gradients(const Rows& rows, const Links& links, const std::vector<Boundary>& boundaries,
                                          bool strain, std::vector<float> length2) {
  VelocityGradients g;
  g.strain_wanted = strain;
  g.viscosity_wanted = !length2.empty();
  if (!g.wanted()) return g;
  for (auto& m : g.moments) m.assign(rows.slots(), 0.0F);
  if (strain)
    for (auto& s : g.strain) s.assign(rows.slots(), 0.0F);
  g.length2 = std::move(length2);
  const Met met = links_along_axes(rows, links);
  constexpr int below[3] = {2, 4, 6}, above[3] = {1, 3, 5};  // directions of D3Q19 along the axes
  g.chunk_cells.push_back(0);
  for (const Chunk& chunk : rows.chunks()) {
    for (int r = chunk.first_run; r < chunk.last_run; ++r) {
      const Run& run = rows.runs()[r];
      for (int n = 0; n < run.count; ++n) {
        const std::ptrdiff_t slot = run.first + n;
        const std::size_t first = g.axes.size();
        for (int a = 0; a < 3; ++a) {
          EdgeAxis edge;
          edge.axis = static_cast<std::int8_t>(a);
          std::array<double, 2> h{1.0, 1.0};
          bool regular = true;
          for (int s = 0; s < 2; ++s) {
            const int i = s == 0 ? below[a] : above[a];
            const std::ptrdiff_t beside = slot + neighbour_offset(run, i);
            const auto m = met.find({slot, i});
            if (m == met.end() && rows.is_active(beside)) {
              edge.slot[s] = beside;
              continue;
            }
            regular = false;
            if (m == met.end()) {  // across a periodic face, or no link: the neighbour is its image, or unknown
              const auto c = rows.cell(beside);
              edge.slot[s] = rows.active_slot(c[0], c[1], c[2]);
              if (edge.slot[s] < 0) edge.side[s] = Side::none;
              continue;
            }
            edge.side[s] = m->second.side;
            h[s] = std::max(m->second.distance, 1e-3);
            const int patch = m->second.patch;
            if (edge.side[s] != Side::wall || patch < 0 || !boundaries[patch].profile) continue;
            const auto& c = d3q19::velocity[i];
            const geometry::Vec3 u =
                boundaries[patch].profile(rows.centre(slot) + h[s] * rows.dx() * geometry::Vec3(c[0], c[1], c[2]));
            edge.moving[s] = static_cast<std::int32_t>(g.surface_velocity.size());
            g.surface_velocity.push_back(
                {patch, {static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2])}});
          }
          if (regular) continue;
          edge.weight = difference(edge.side, h);
          g.axes.push_back(edge);
        }
        if (g.axes.size() > first) g.cells.push_back({slot, r, first});
      }
    }
    g.chunk_cells.push_back(g.cells.size());
  }
  return g;
}

namespace {

/// Velocity beyond one end of an edge axis.
float velocity_beyond(const VelocityGradients& g, const EdgeAxis& edge, int s, std::ptrdiff_t here, int b,
                      const std::vector<double>& wall_speed) {
  switch (edge.side[s]) {
    case Side::cell:
      return g.moments[1 + b][edge.slot[s]];
    case Side::mirror:
      return edge.axis == b ? -g.moments[1 + b][here] : g.moments[1 + b][here];
    case Side::wall:
      if (edge.moving[s] < 0) return 0.0F;
      return static_cast<float>(wall_speed[g.surface_velocity[edge.moving[s]].boundary]) *
             g.surface_velocity[edge.moving[s]].u[b];
    case Side::none:
      break;
  }
  return 0.0F;
}

/// The cells at edges, over what the central differences made of them.
void mend_edges(const Rows& rows, const std::vector<double>& wall_speed, double tau0, int chunk, VelocityGradients& g,
                std::vector<float>& les) {
  for (std::size_t k = g.chunk_cells[chunk]; k < g.chunk_cells[chunk + 1]; ++k) {
    const EdgeCell& cell = g.cells[k];
    const std::size_t end = k + 1 < g.cells.size() ? g.cells[k + 1].first_axis : g.axes.size();
    const Run& run = rows.runs()[cell.run];
    const std::ptrdiff_t up[3] = {1, run.shift[2][1], run.shift[1][2]},
                         down[3] = {-1, run.shift[0][1], run.shift[1][0]};
    float du[3][3];
    std::size_t e = cell.first_axis;
    for (int a = 0; a < 3; ++a) {
      const bool edge = e < end && g.axes[e].axis == a;
      for (int b = 0; b < 3; ++b) {
        const auto& u = g.moments[1 + b];
        if (!edge) {
          du[a][b] = 0.5F * (u[cell.slot + up[a]] - u[cell.slot + down[a]]);
          continue;
        }
        const EdgeAxis& x = g.axes[e];
        du[a][b] = x.weight[0] * velocity_beyond(g, x, 0, cell.slot, b, wall_speed) + x.weight[1] * u[cell.slot] +
                   x.weight[2] * velocity_beyond(g, x, 1, cell.slot, b, wall_speed);
      }
      if (edge) ++e;
    }
    if (g.strain_wanted) {
      float s[6];
      deviatoric_strain(du, s);
      for (int n = 0; n < 6; ++n) g.strain[n][cell.slot] = s[n];
    }
    if (g.viscosity_wanted)
      les[cell.slot] =
          (1.0F + g.moments[0][cell.slot]) * prescribed_les(vreman_viscosity(du, g.length2[cell.slot]), tau0);
  }
}

}  // namespace

template <class T>
void find_velocity_gradients(const Rows& rows, const Populations<T>& populations, const std::vector<double>& wall_speed,
                             double tau0, Isa isa, VelocityGradients& g, std::vector<float>& les) {
  VelocityInput<T> velocity;
  velocity.f = populations.f.data();
  velocity.stride = populations.stride;
  velocity.runs = rows.runs().data();
  velocity.next = populations.next;
  GradientInput gradient;
  gradient.runs = rows.runs().data();
  for (int d = 0; d < 4; ++d) gradient.moments[d] = velocity.moments[d] = g.moments[d].data();
  if (g.strain_wanted)
    for (int n = 0; n < 6; ++n) gradient.strain[n] = g.strain[n].data();
  if (g.viscosity_wanted) {
    gradient.length2 = g.length2.data();
    gradient.les = les.data();
  }
  gradient.tau0 = tau0;
  const auto find_velocity = select_velocity_kernel<T>(isa);
  const auto find_gradient = select_gradient_kernel(isa);
  const auto& chunks = rows.chunks();
  const auto each_chunk = [&](const auto& body) {
    oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), body, oneapi::tbb::static_partitioner());
  };
  each_chunk([&](std::size_t c) {
    VelocityInput<T> mine = velocity;
    mine.first_run = chunks[c].first_run;
    mine.last_run = chunks[c].last_run;
    find_velocity(mine);
  });
  each_chunk([&](std::size_t c) {
    GradientInput mine = gradient;
    mine.first_run = chunks[c].first_run;
    mine.last_run = chunks[c].last_run;
    find_gradient(mine);
    mend_edges(rows, wall_speed, tau0, static_cast<int>(c), g, les);
  });
}

template void find_velocity_gradients<float>(const Rows&, const Populations<float>&, const std::vector<double>&, double,
                                             Isa, VelocityGradients&, std::vector<float>&);
template void find_velocity_gradients<double>(const Rows&, const Populations<double>&, const std::vector<double>&,
                                              double, Isa, VelocityGradients&, std::vector<float>&);

}  // namespace puffin::lbm
