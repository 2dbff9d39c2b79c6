#pragma once
// Boxes of cells with flows that are given face by face, for the tests of the scalars.

#include <functional>
#include <vector>

#include "lbm/rows.hpp"
#include "lbm/scalars/advance_scalars.hpp"

namespace puffin::lbm {

/// Mass through the high face, in direction d, of cell (i,j,k).
using FluxOf = std::function<double(int d, int i, int j, int k)>;
/// Is cell (i,j,k) of the box air?
using IsAir = std::function<bool(int i, int j, int k)>;

struct Scene {
  Rows rows;
  FaceFluxes fluxes;
  std::vector<int> opening_patch;

  ScalarFields fields(int scalars = 1) const { return ScalarFields(rows, scalars, opening_patch); }
  ScalarBudget budget(int scalars = 1) const { return ScalarBudget(rows, scalars, 2); }
  std::ptrdiff_t at(int i, int j = 0, int k = 0) const { return rows.active_slot(i, j, k); }
};

/// size: cells; periodic directions wrap; with `duct` the two ends in x are openings, patch 0 (low) and 1 (high). All
/// other outer faces are walls. Density 1, no flow.
inline Scene make_scene(std::array<int, 3> size, std::array<bool, 3> periodic, bool duct = false,
                        const IsAir& is_air = {}) {
  geometry::Voxels voxels;
  voxels.dx = 1.0;
  voxels.size = size;
  voxels.fill([&](int i, int j, int k) { return !is_air || is_air(i, j, k); });
  Scene s{Rows(voxels, periodic), {}, {}};
  s.opening_patch.assign(s.rows.slots(), -1);
  s.fluxes.density.assign(s.rows.slots(), 1.0);
  for (int d = 0; d < 3; ++d) {
    s.fluxes.mass[d].assign(s.rows.slots(), 0.0);
    s.fluxes.open[d].assign(s.rows.slots(), 0);
  }
  for (std::size_t slot = 0; slot < s.rows.slots(); ++slot) {
    if (!s.rows.is_active(slot) && !s.rows.is_ghost(slot)) continue;
    const auto c = s.rows.cell(slot);
    if (duct && (c[0] == -1 || c[0] == size[0])) s.opening_patch[slot] = c[0] == -1 ? 0 : 1;
    for (int d = 0; d < 3; ++d) {
      auto next = c;
      ++next[d];
      const bool here = s.rows.active_slot(c[0], c[1], c[2]) >= 0,
                 there = s.rows.active_slot(next[0], next[1], next[2]) >= 0;
      if (here && there) s.fluxes.open[d][slot] = 1;
      if (d == 0 && duct && here != there && (c[0] == -1 || next[0] == size[0])) s.fluxes.open[d][slot] = 2;
    }
  }
  return s;
}

/// Sets the fluxes through all faces that are not closed.
inline void set_flow(Scene& s, const FluxOf& flux) {
  for (std::size_t slot = 0; slot < s.rows.slots(); ++slot)
    for (int d = 0; d < 3; ++d) {
      if (s.fluxes.open[d][slot] == 0) continue;
      auto c = s.rows.cell(slot);
      if (s.rows.periodic()[d] && c[d] < 0) c[d] += s.rows.box()[d];
      s.fluxes.mass[d][slot] = flux(d, c[0], c[1], c[2]);
    }
}

/// A flow without divergence: the curl of a vector potential held on the edges. potential(d, i, j, k): along the edge
/// in direction d that starts at the corner above cell (i,j,k), at (i+1/2, j+1/2, k+1/2) in the other two directions;
/// index -1 is the low border. It is cut to 0 on edges of closed faces, so nothing passes the walls.
inline void set_curl(Scene& s, const FluxOf& potential) {
  const auto n = s.rows.box();
  const auto wrap = [&](int d, int i) { return s.rows.periodic()[d] ? (i % n[d] + n[d]) % n[d] : i; };
  const auto edge = [&](int d, std::array<int, 3> c) {
    for (int e = 0; e < 3; ++e) c[e] = wrap(e, c[e]);
    const int a = (d + 1) % 3, b = (d + 2) % 3;
    for (int da = 0; da < 2; ++da)
      for (int db = 0; db < 2; ++db) {
        auto cell = c;
        cell[a] += da;
        cell[b] += db;
        if (s.rows.active_slot(cell[0], cell[1], cell[2]) < 0) return 0.0;
      }
    return potential(d, c[0], c[1], c[2]);
  };
  set_flow(s, [&](int d, int i, int j, int k) {
    const int a = (d + 1) % 3, b = (d + 2) % 3;  // circulation around the face: +b edge, -a edge
    std::array<int, 3> c{i, j, k}, low_a = c, low_b = c;
    --low_a[a];
    --low_b[b];
    return (edge(b, c) - edge(b, low_a)) - (edge(a, c) - edge(a, low_b));
  });
}

/// A jet that arrives at the cell (1,1,1) of a closed box in z, 0.2 through each face, and leaves in x and y, 0.1
/// through each of four.
inline Scene make_jet() {
  Scene s = make_scene({3, 3, 3}, {false, false, false});
  s.fluxes.mass[0][s.at(1, 1, 1)] = 0.1;
  s.fluxes.mass[0][s.at(0, 1, 1)] = -0.1;
  s.fluxes.mass[1][s.at(1, 1, 1)] = 0.1;
  s.fluxes.mass[1][s.at(1, 0, 1)] = -0.1;
  s.fluxes.mass[2][s.at(1, 1, 0)] = 0.2;
  s.fluxes.mass[2][s.at(1, 1, 1)] = -0.2;
  return s;
}

/// density -> density - steps * (net outflow), as a lattice would report it for the next update.
inline void carry_density(Scene& s, double steps) {
  auto density = s.fluxes.density;
  for (const Run& run : s.rows.runs())
    for (std::ptrdiff_t slot = run.first; slot < run.first + run.count; ++slot)
      for (int d = 0; d < 3; ++d) {
        const std::ptrdiff_t low = d == 0 ? -1 : d == 1 ? run.shift[0][1] : run.shift[1][0];
        density[slot] -= steps * (s.fluxes.mass[d][slot] - s.fluxes.mass[d][slot + low]);
      }
  s.fluxes.density = density;
}

/// Numbers in [-1, 1) from a seed and indices, the same on every machine.
inline double noise(std::uint64_t seed, int a, int b, int c, int d) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15ull;
  for (const int v : {a, b, c, d}) {
    x ^= static_cast<std::uint64_t>(v + 1000003);
    x *= 0xBF58476D1CE4E5B9ull;
    x ^= x >> 29;
  }
  x *= 0x94D049BB133111EBull;
  x ^= x >> 32;
  return static_cast<double>(x >> 11) * 0x1p-52 - 1.0;
}

}  // namespace puffin::lbm
