#include "lbm/geometry/voxelize.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lbm/geometry/closing_caps.hpp"
#include "lbm/geometry/row_crossings.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/triangle_distance.hpp"

namespace puffin::lbm::geometry {

namespace {

std::string millimetres(double metres) { return std::to_string(metres * 1e3) + " mm"; }

Voxels make_box(const TriangleTree& tree, double dx, const VoxelizeOptions& options) {
  if (!(dx > 0.0) || !std::isfinite(dx)) throw std::invalid_argument("error: dx must be a positive length");
  if (!options.openings.empty() && options.openings.size() != tree.mesh().triangles.size()) {
    throw std::invalid_argument("error: openings needs one entry a triangle");
  }
  Voxels box;
  box.dx = dx;
  box.origin = tree.min() + Vec3::Constant(0.5 * dx);
  double cells = 1.0;
  for (int d = 0; d < 3; ++d) {
    const double length = tree.max()[d] - tree.min()[d];
    const double exact = length / dx, nearest = std::max(1.0, std::round(exact));
    // A length that is a whole number of cells but for single precision coordinates needs no further cell.
    const bool whole = std::abs(exact - nearest) <= 1e-5 * nearest;
    if (options.periodic[d] && !whole) {
      throw std::invalid_argument(std::string("error: the box is ") + millimetres(length) + " long in the periodic " +
                                  "direction " + "xyz"[d] + ", which is " + std::to_string(exact) +
                                  " cells; a whole number is needed, the nearest dx is " +
                                  millimetres(length / nearest));
    }
    const double n = std::max(1.0, whole ? nearest : std::ceil(exact));
    cells *= n;
    if (cells > static_cast<double>(options.most_cells) || n > 1e6) {
      throw std::invalid_argument("error: a dx of " + millimetres(dx) + " needs more than " +
                                  std::to_string(options.most_cells) +
                                  " cells in the bounding box; take a larger dx, or check the unit of the file");
    }
    box.size[d] = static_cast<int>(n);
  }
  box.fluid.assign(static_cast<std::size_t>(cells), 0);
  return box;
}

void fill(const TriangleTree& tree, Voxels& box) {
  const double shift = on_surface(tree.min(), tree.max(), box.dx);
  const ClosingCaps caps(tree.mesh(), tree.adjacency());
  const RowCrossings rows = row_crossings(caps.closed(), box, shift);
  const int nx = box.size[0];
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows.first.size() - 1, 16), [&](const auto& r) {
    std::vector<int> step(nx + 1);
    for (std::size_t row = r.begin(); row < r.end(); ++row) {
      if (rows.first[row] == rows.first[row + 1] && caps.empty()) continue;
      std::fill(step.begin(), step.end(), 0);
      for (std::size_t c = rows.first[row]; c < rows.first[row + 1]; ++c) {
        step[rows.crossings[c].i] += rows.crossings[c].step;
      }
      const int j = static_cast<int>(row) % box.size[1], k = static_cast<int>(row) / box.size[1];
      int winding = 0;
      std::uint8_t* fluid = box.fluid.data() + row * nx;
      for (int i = 0; i < nx; ++i) {
        winding += step[i];
        fluid[i] = caps.empty() ? winding != 0 : caps.inside(winding, box.centre(i, j, k) + Vec3::Constant(shift));
      }
    }
  });
}

// Fluid cells that touch an opening: within one dx of a point of it, with nothing between. (Not: whose nearest triangle
// is one of an opening. In a slice one cell wide the periodic sides are as near as the opening, or nearer.)
std::vector<std::int64_t> cells_at_openings(const TriangleTree& tree, const std::vector<char>& openings,
                                            const Voxels& voxels) {
  const TriangleMesh& mesh = tree.mesh();
  std::vector<char> found(voxels.fluid.size(), 0);
  std::vector<std::int64_t> result;
  for (std::size_t t = 0; t < openings.size(); ++t) {
    if (!openings[t]) continue;
    const auto& tri = mesh.triangles[t];
    const Vec3 &a = mesh.vertices[tri[0]], &b = mesh.vertices[tri[1]], &c = mesh.vertices[tri[2]];
    std::array<int, 3> low, high;
    for (int d = 0; d < 3; ++d) {
      const double l = (std::min({a[d], b[d], c[d]}) - voxels.origin[d]) / voxels.dx - 1.0;
      const double h = (std::max({a[d], b[d], c[d]}) - voxels.origin[d]) / voxels.dx + 1.0;
      low[d] = std::max(0, static_cast<int>(std::ceil(l)));
      high[d] = std::min(voxels.size[d] - 1, static_cast<int>(std::floor(h)));
    }
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          const std::int64_t cell = voxels.index(i, j, k);
          if (!voxels.fluid[cell] || found[cell]) continue;
          const Vec3 centre = voxels.centre(i, j, k), way = nearest_on_triangle(centre, a, b, c).point - centre;
          if (way.norm() > voxels.dx || tree.first_hit(centre, way, 1.0 - 1e-6)) continue;
          found[cell] = 1;
          result.push_back(cell);
        }
      }
    }
  }
  return result;
}

// Marks with `mark` all cells of value `from` connected to the open list; returns how many.
std::size_t flood(const std::array<bool, 3>& periodic, std::vector<std::int64_t> open, std::uint8_t from,
                  std::uint8_t mark, Voxels& voxels) {
  std::size_t marked = 0;
  std::size_t kept = 0;
  for (const std::int64_t cell : open) {
    if (voxels.fluid[cell] != from) continue;
    voxels.fluid[cell] = mark;
    open[kept++] = cell;
  }
  open.resize(kept);
  const std::int64_t nx = voxels.size[0], ny = voxels.size[1];
  while (!open.empty()) {
    const std::int64_t cell = open.back();
    open.pop_back();
    ++marked;
    const std::array<int, 3> at{static_cast<int>(cell % nx), static_cast<int>((cell / nx) % ny),
                                static_cast<int>(cell / (nx * ny))};
    for (int d = 0; d < 3; ++d) {
      for (const int step : {-1, 1}) {
        auto to = at;
        to[d] += step;
        if (to[d] < 0 || to[d] >= voxels.size[d]) {
          if (!periodic[d]) continue;
          to[d] = to[d] < 0 ? voxels.size[d] - 1 : 0;
        }
        const std::int64_t next = voxels.index(to[0], to[1], to[2]);
        if (voxels.fluid[next] != from) continue;
        voxels.fluid[next] = mark;
        open.push_back(next);
      }
    }
  }
  return marked;
}

}  // namespace

Pockets drop_pockets(const TriangleTree& tree, const VoxelizeOptions& options, Voxels& voxels) {
  constexpr std::uint8_t solid = 0, unreached = 1, reached = 2;
  const auto start = cells_at_openings(tree, options.openings, voxels);
  if (start.empty()) {
    throw GeometryError(
        "error: no fluid cell lies at any opening; take a smaller dx, or check which patches are openings");
  }
  flood(options.periodic, start, unreached, reached, voxels);
  struct Pocket {
    std::size_t cells;
    Vec3 where;
  };
  std::vector<Pocket> pockets;
  for (int k = 0; k < voxels.size[2]; ++k) {
    for (int j = 0; j < voxels.size[1]; ++j) {
      for (int i = 0; i < voxels.size[0]; ++i) {
        const std::int64_t cell = voxels.index(i, j, k);
        if (voxels.fluid[cell] != unreached) continue;
        pockets.push_back({flood(options.periodic, {cell}, unreached, solid, voxels), voxels.centre(i, j, k)});
      }
    }
  }
  for (auto& f : voxels.fluid) f = f == reached;
  std::stable_sort(pockets.begin(), pockets.end(), [](const Pocket& a, const Pocket& b) { return a.cells > b.cells; });
  Pockets dropped;
  dropped.count = pockets.size();
  for (const Pocket& p : pockets) {
    dropped.cells += p.cells;
    if (dropped.where.size() < 1000) dropped.where.push_back(p.where);
  }
  return dropped;
}

Voxels voxelize(const TriangleTree& tree, double dx, const VoxelizeOptions& options, Pockets* dropped) {
  Voxels voxels = make_box(tree, dx, options);
  fill(tree, voxels);
  if (std::none_of(voxels.fluid.begin(), voxels.fluid.end(), [](std::uint8_t f) { return f != 0; })) {
    throw GeometryError("error: no cell centre lies inside the surface at a dx of " + millimetres(dx) +
                        "; take a smaller dx, or check that the surface is closed");
  }
  Pockets pockets;
  if (!options.openings.empty()) pockets = drop_pockets(tree, options, voxels);
  if (dropped) *dropped = std::move(pockets);
  return voxels;
}

}  // namespace puffin::lbm::geometry
