#include "lbm/geometry/voxel_errors.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lbm/geometry/row_crossings.hpp"
#include "lbm/geometry/surface_check.hpp"

namespace puffin::lbm::geometry {

namespace {

// What one layer of cells adds; layers are summed in order, so that the result does not depend on threads.
struct LayerSum {
  double distance = 0.0, largest = 0.0;
  std::size_t faces = 0;
};

// Calls visit(run, j, number of the run) for the runs of a layer.
template <class Visit>
void for_layer(const Voxels& voxels, int k, Visit&& visit) {
  for (int j = 0; j < voxels.size[1]; ++j)
    for (const FluidRun& run : voxels.row(j, k)) visit(run, j, static_cast<std::size_t>(&run - voxels.runs.data()));
}

// How many fluid cells come before each run.
std::vector<std::size_t> cells_before(const Voxels& voxels) {
  std::vector<std::size_t> before(voxels.runs.size());
  std::size_t sum = 0;
  for (std::size_t r = 0; r < before.size(); ++r) {
    before[r] = sum;
    sum += static_cast<std::size_t>(voxels.runs[r].end - voxels.runs[r].begin);
  }
  return before;
}

// Fluid cells whose centre lies within half a diagonal of some triangle's box: only these can have the surface beside
// them. By number of the fluid cell.
std::vector<char> near_surface(const TriangleMesh& mesh, const Voxels& voxels, const std::vector<std::size_t>& before) {
  std::vector<char> near(voxels.cells(), 0);
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
        for (const FluidRun& run : voxels.row(j, k)) {
          const std::size_t number = before[static_cast<std::size_t>(&run - voxels.runs.data())];
          for (int i = std::max(low[0], run.begin); i < std::min(high[0] + 1, run.end); ++i)
            near[number + static_cast<std::size_t>(i - run.begin)] = 1;
        }
  }
  return near;
}

// Calls visit(i) for the cells of a run that have no fluid cell at the same i in `beside`.
template <class Visit>
void for_uncovered(const FluidRun& run, std::span<const FluidRun> beside, Visit&& visit) {
  int i = run.begin;
  for (const FluidRun& other : beside) {
    for (; i < std::min(other.begin, run.end); ++i) visit(i);
    i = std::max(i, other.end);
    if (i >= run.end) return;
  }
  for (; i < run.end; ++i) visit(i);
}

// Does the way from a hit onwards leave the solid again at once, through a facet that is not parallel: the tip of a
// wedge? (Two faces that lie on one another, as those of bodies that touch, are parallel.)
bool passes_a_tip(const TriangleTree& tree, const Hit& hit, const Vec3& from, const Vec3& along, double within) {
  const double begin = hit.t + 1e-9;
  const auto exit = tree.first_hit(from + begin * along, along, within);
  if (!exit || exit->triangle == hit.triangle) return false;
  const Vec3 in = tree.mesh().area_vector(hit.triangle).stableNormalized(),
             out = tree.mesh().area_vector(exit->triangle).stableNormalized();
  return in.dot(out) > -0.9999 && !tree.inside(from + (begin + 0.5 * exit->t) * along);
}

}  // namespace

SurfaceError surface_error(const TriangleTree& tree, const Voxels& voxels) {
  std::vector<LayerSum> layers(static_cast<std::size_t>(voxels.size[2]));
  tbb::parallel_for(0, voxels.size[2], [&](int k) {
    LayerSum& sum = layers[static_cast<std::size_t>(k)];
    for_layer(voxels, k, [&](const FluidRun& run, int j, std::size_t) {
      const auto measure = [&](int i, const Vec3& towards) {
        const double away = tree.closest(voxels.centre(i, j, k) + 0.5 * voxels.dx * towards).distance;
        sum.distance += away;
        sum.largest = std::max(sum.largest, away);
        ++sum.faces;
      };
      measure(run.begin, -Vec3::UnitX());
      measure(run.end - 1, Vec3::UnitX());
      for (const int step : {-1, 1}) {
        for_uncovered(run, voxels.row(j + step, k), [&](int i) { measure(i, step * Vec3::UnitY()); });
        for_uncovered(run, voxels.row(j, k + step), [&](int i) { measure(i, step * Vec3::UnitZ()); });
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
  // Where voxelize asked: a row of centres in the plane of a wall runs beside it, not in it.
  const Vec3 shift = Vec3::Constant(on_surface(tree.min(), tree.max(), voxels.dx));
  const std::vector<std::size_t> before = cells_before(voxels);
  const std::vector<char> near = near_surface(tree.mesh(), voxels, before);
  struct Found {
    Vec3 where;
    bool buried;
  };
  std::vector<std::vector<Found>> layers(static_cast<std::size_t>(voxels.size[2]));
  tbb::parallel_for(0, voxels.size[2], [&](int k) {
    const auto look_at = [&](int i, int j) {
      for (int d = 0; d < 3; ++d) {
        if (!voxels.is_fluid(i + (d == 0), j + (d == 1), k + (d == 2))) continue;
        const Vec3 from = voxels.centre(i, j, k) + shift, along = voxels.dx * Vec3::Unit(d);
        const auto hit = tree.first_hit(from, along, 1.0);
        if (!hit || hit->t < off || hit->t > 1.0 - off || (!openings.empty() && openings[hit->triangle])) continue;
        const bool buried = tree.inside(from + (hit->t - off) * along) && tree.inside(from + (hit->t + off) * along) &&
                            !passes_a_tip(tree, *hit, from, along, off);
        layers[static_cast<std::size_t>(k)].push_back({from + hit->t * along, buried});
      }
    };
    for_layer(voxels, k, [&](const FluidRun& run, int j, std::size_t r) {
      for (int i = run.begin; i < run.end; ++i)
        if (near[before[r] + static_cast<std::size_t>(i - run.begin)]) look_at(i, j);
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
    const auto cells = static_cast<double>(voxels.cells());
    c.dx.push_back(dx);
    c.volume_error.push_back(std::abs(cells * dx * dx * dx / exact - 1.0));
    c.surface_error.push_back(surface_error(tree, voxels).mean);
    volume_floor.push_back(1e-6);
    surface_floor.push_back(1e-5 * dx);
  }
  if (c.volume_error[0] > volume_floor[0]) c.volume_order = order_of(c.dx, c.volume_error, volume_floor);
  if (c.surface_error[0] > surface_floor[0]) c.surface_order = order_of(c.dx, c.surface_error, surface_floor);
  return c;
}

}  // namespace puffin::lbm::geometry
