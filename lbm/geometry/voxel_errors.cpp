#include "lbm/geometry/voxel_errors.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lbm/geometry/surface_check.hpp"

namespace puffin::lbm::geometry {

namespace {

// What one layer of cells adds; layers are summed in order, so that the result does not depend on threads.
struct LayerSum {
  double distance = 0.0, largest = 0.0;
  std::size_t faces = 0;
};

template <class Visit>
void for_layer(const Voxels& voxels, int k, Visit&& visit) {
  const int nx = voxels.size[0], ny = voxels.size[1];
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      if (voxels.fluid[static_cast<std::size_t>(voxels.index(i, j, k))]) visit(i, j);
}

// Cells whose centre lies within half a diagonal of some triangle's box: only these can have the surface beside them.
std::vector<char> near_surface(const TriangleMesh& mesh, const Voxels& voxels) {
  std::vector<char> near(voxels.fluid.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& tri = mesh.triangles[t];
    const Vec3 &a = mesh.vertices[tri[0]], &b = mesh.vertices[tri[1]], &c = mesh.vertices[tri[2]];
    std::array<int, 3> low, high;
    for (int d = 0; d < 3; ++d) {
      const double l = (std::min({a[d], b[d], c[d]}) - voxels.origin[d]) / voxels.dx;
      const double h = (std::max({a[d], b[d], c[d]}) - voxels.origin[d]) / voxels.dx;
      low[d] = std::max(0, static_cast<int>(std::floor(l)));
      high[d] = std::min(voxels.size[d] - 1, static_cast<int>(std::ceil(h)));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i) near[static_cast<std::size_t>(voxels.index(i, j, k))] = 1;
  }
  return near;
}

}  // namespace

SurfaceError surface_error(const TriangleTree& tree, const Voxels& voxels) {
  std::vector<LayerSum> layers(static_cast<std::size_t>(voxels.size[2]));
  tbb::parallel_for(0, voxels.size[2], [&](int k) {
    LayerSum& sum = layers[static_cast<std::size_t>(k)];
    for_layer(voxels, k, [&](int i, int j) {
      for (int d = 0; d < 3; ++d)
        for (const int step : {-1, 1}) {
          const std::array<int, 3> to{i + (d == 0) * step, j + (d == 1) * step, k + (d == 2) * step};
          if (voxels.is_fluid(to[0], to[1], to[2])) continue;
          const double away = tree.closest(voxels.centre(i, j, k) + 0.5 * step * voxels.dx * Vec3::Unit(d)).distance;
          sum.distance += away;
          sum.largest = std::max(sum.largest, away);
          ++sum.faces;
        }
    });
  });
  SurfaceError error;
  for (const LayerSum& l : layers) {
    error.mean += l.distance;
    error.largest = std::max(error.largest, l.largest);
    error.faces += l.faces;
  }
  if (error.faces > 0) error.mean /= static_cast<double>(error.faces);
  return error;
}

HiddenFaces hidden_faces(const TriangleTree& tree, const Voxels& voxels, const std::vector<char>& openings) {
  constexpr double off = 1e-3;  // of a cell: a centre that near to the surface lies on it
  const std::vector<char> near = near_surface(tree.mesh(), voxels);
  struct Found {
    Vec3 where;
    bool buried;
  };
  std::vector<std::vector<Found>> layers(static_cast<std::size_t>(voxels.size[2]));
  tbb::parallel_for(0, voxels.size[2], [&](int k) {
    for_layer(voxels, k, [&](int i, int j) {
      if (!near[static_cast<std::size_t>(voxels.index(i, j, k))]) return;
      for (int d = 0; d < 3; ++d) {
        if (!voxels.is_fluid(i + (d == 0), j + (d == 1), k + (d == 2))) continue;
        const Vec3 from = voxels.centre(i, j, k), along = voxels.dx * Vec3::Unit(d);
        const auto hit = tree.first_hit(from, along, 1.0);
        if (!hit || hit->t < off || hit->t > 1.0 - off || (!openings.empty() && openings[hit->triangle])) continue;
        const bool buried = tree.inside(from + (hit->t - off) * along) && tree.inside(from + (hit->t + off) * along);
        layers[static_cast<std::size_t>(k)].push_back({from + hit->t * along, buried});
      }
    });
  });
  HiddenFaces faces;
  for (const auto& places : layers)
    for (const Found& f : places) {
      auto& where = f.buried ? faces.buried_where : faces.thin_where;
      ++(f.buried ? faces.buried : faces.thin);
      if (where.size() < Defect::places) where.push_back(f.where);
    }
  return faces;
}

void refuse_buried(const HiddenFaces& faces) {
  if (faces.buried == 0) return;
  throw GeometryError("error: buried face: the surface has a face inside the fluid at " +
                      place_text(faces.buried_where[0]) + " (and between " + std::to_string(faces.buried - 1) +
                      " other pairs of cells): bodies that overlap or share a face. The flow would meet a wall there; "
                      "export the union of the bodies, without faces inside, or give a baffle its thickness");
}

std::optional<double> order_of(const std::vector<double>& dx, const std::vector<double>& error,
                               const std::vector<double>& floor) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < dx.size(); ++i) {
    if (!(error[i] > floor[i])) continue;
    const double u = std::log(dx[i]), v = std::log(error[i]);
    n += 1.0;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  if (n < 3.0) return std::nullopt;
  return (n * xy - x * y) / (n * xx - x * x);
}

Convergence convergence(const TriangleTree& tree, const Voxels& finest) {
  Convergence c;
  const double exact = std::abs(enclosed_volume(tree.mesh()));
  std::vector<double> volume_floor, surface_floor;
  for (int n = 0; n < 5; ++n) {
    const double dx = finest.dx * std::pow(std::numbers::sqrt2, n);
    Voxels coarse;
    if (n > 0) try {
        coarse = voxelize(tree, dx);
      } catch (const GeometryError&) {
        break;  // no centre inside any more
      }
    const Voxels& voxels = n == 0 ? finest : coarse;
    const auto cells = static_cast<double>(std::count(voxels.fluid.begin(), voxels.fluid.end(), 1));
    c.dx.push_back(dx);
    c.volume_error.push_back(std::abs(cells * dx * dx * dx / exact - 1.0));
    c.surface_error.push_back(surface_error(tree, voxels).mean);
    volume_floor.push_back(1e-6);
    surface_floor.push_back(1e-5 * dx);
  }
  c.volume_order = order_of(c.dx, c.volume_error, volume_floor);
  c.surface_order = order_of(c.dx, c.surface_error, surface_floor);
  return c;
}

}  // namespace puffin::lbm::geometry
