#include "lbm/active_cells.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "lbm/geometry/solid_fraction.hpp"

namespace puffin::lbm {

using geometry::FluidRun;
using geometry::TriangleMesh;
using geometry::TriangleTree;
using geometry::Vec3;
using geometry::Voxels;

namespace {

bool is_opening(const Boundary& boundary) {
  return boundary.kind == BoundaryKind::velocity_inlet || boundary.kind == BoundaryKind::pressure_outlet;
}

/// The triangles of some kinds of boundary, and where each came from; null if there are none.
template <class Wanted>
std::unique_ptr<TriangleTree> tree_of(const LinkGeometry& surface, const Wanted& wanted) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = surface.mesh->vertices;
  mesh->solids = surface.mesh->solids;
  for (std::size_t t = 0; t < surface.mesh->triangles.size(); ++t) {
    if (!wanted(surface.boundaries[surface.patch_of_triangle[t]])) continue;
    mesh->triangles.push_back(surface.mesh->triangles[t]);
    mesh->solid.push_back(0);
  }
  return mesh->triangles.empty() ? nullptr : std::make_unique<TriangleTree>(mesh);
}

/// Outside of an opening that is near.
bool beyond(const TriangleTree* openings, const Vec3& x, double reach) {
  if (openings == nullptr) return false;
  const auto near = openings->closest(x, reach);
  return near.triangle >= 0 &&
         (x - near.point).dot(openings->mesh().area_vector(near.triangle).normalized()) > -1e-9 * reach;
}

}  // namespace

float ActiveCells::solid(std::int64_t cell) const {
  const auto at = std::partition_point(partial.begin(), partial.end(), [&](const Partial& p) { return p.cell < cell; });
  return at != partial.end() && at->cell == cell ? at->solid : 0.0F;
}

Voxels padded(const Voxels& voxels, int margin, const std::array<bool, 3>& periodic) {
  Voxels out;
  out.dx = voxels.dx;
  std::array<int, 3> low{0, 0, 0};
  for (int d = 0; d < 3; ++d) {
    low[d] = periodic[d] ? 0 : margin;
    out.size[d] = voxels.size[d] + 2 * low[d];
    out.origin[d] = voxels.origin[d] - low[d] * voxels.dx;
  }
  out.first.assign(1, 0);
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j) {
      for (const FluidRun& run : voxels.row(j - low[1], k - low[2]))
        out.runs.push_back({run.begin + low[0], run.end + low[0]});
      out.first.push_back(out.runs.size());
    }
  return out;
}

ActiveCells with_band(const Voxels& voxels, const LinkGeometry& surface, double depth,
                      const std::array<bool, 3>& periodic) {
  ActiveCells cells;
  cells.computed = cells.inside = padded(voxels, static_cast<int>(std::ceil(depth)) + 1, periodic);
  const Voxels& v = cells.inside;
  const auto walls = tree_of(surface, [](const Boundary& b) { return b.kind == BoundaryKind::wall; });
  const auto openings = tree_of(surface, is_opening);
  const auto slips = tree_of(surface, [](const Boundary& b) { return b.kind == BoundaryKind::slip; });
  if (!walls) return cells;
  const double reach = depth * v.dx;
  std::vector<Vec3> shifts{Vec3::Zero()};  // a wall is near across a periodic face too
  for (int d = 0; d < 3; ++d) {
    if (!periodic[d]) continue;
    const std::size_t n = shifts.size();
    for (std::size_t s = 0; s < n; ++s)
      for (const double sign : {-1.0, 1.0}) shifts.push_back(shifts[s] + sign * v.dx * v.size[d] * Vec3::Unit(d));
  }
  struct Layer {
    std::vector<FluidRun> runs;
    std::vector<std::size_t> ends;  // of the rows
  };
  std::vector<Layer> layers(static_cast<std::size_t>(v.size[2]));
  oneapi::tbb::parallel_for(0, v.size[2], [&](int k) {
    Layer& layer = layers[static_cast<std::size_t>(k)];
    std::vector<char> computed(static_cast<std::size_t>(v.size[0]));
    for (int j = 0; j < v.size[1]; ++j) {
      std::fill(computed.begin(), computed.end(), 0);
      for (const FluidRun& run : v.row(j, k)) std::fill(computed.begin() + run.begin, computed.begin() + run.end, 1);
      for (int i = 0; i < v.size[0]; ++i) {
        if (computed[i]) continue;
        const Vec3 x = v.centre(i, j, k);
        if (beyond(openings.get(), x, 2.0 * reach)) continue;
        for (const Vec3& shift : shifts) {
          const auto near = walls->closest(x + shift, reach);
          if (near.triangle < 0) continue;
          // Beyond a slip wall a band would rub on the air before it; what lies straight behind another wall is that
          // one's.
          const bool at_edge = slips && slips->closest(near.point, 1e-6 * v.dx).triangle >= 0;
          if (at_edge && beyond(slips.get(), x + shift, 2.0 * reach)) continue;
          computed[i] = 1;
          break;
        }
      }
      Voxels::add_row(
          v.size[0], [&](int i) { return computed[i] != 0; }, layer.runs);
      layer.ends.push_back(layer.runs.size());
    }
  });
  cells.computed.first.assign(1, 0);
  cells.computed.runs.clear();
  for (const Layer& layer : layers) {
    const std::size_t before = cells.computed.runs.size();
    for (const std::size_t end : layer.ends) cells.computed.first.push_back(before + end);
    cells.computed.runs.insert(cells.computed.runs.end(), layer.runs.begin(), layer.runs.end());
  }
  return cells;
}

ActiveCells with_cut_cells(const Voxels& voxels, const LinkGeometry& surface, double least) {
  ActiveCells cells;
  cells.inside = voxels;
  std::vector<char> openings(surface.mesh->triangles.size(), 0);
  for (std::size_t t = 0; t < openings.size(); ++t)
    openings[t] = is_opening(surface.boundaries[surface.patch_of_triangle[t]]) ? 1 : 0;
  const TriangleTree tree(std::make_shared<TriangleMesh>(*surface.mesh));
  const auto opening_tree = tree_of(surface, is_opening);
  for (const auto& cut : geometry::cut_cells(tree, voxels, openings)) {
    // Of the part on this side of an opening, how much is solid.
    const double here = 1.0 - cut.beyond;
    const double share = here > 1e-6 ? std::clamp(cut.solid() / here, 0.0, 1.0) : 1.0;
    const auto [i, j, k] = voxels.place(cut.cell);
    if (!voxels.is_fluid(i, j, k)) {
      if (share > 1.0 - least || beyond(opening_tree.get(), voxels.centre(i, j, k), 2.0 * voxels.dx)) continue;
    }
    cells.partial.push_back({cut.cell, static_cast<float>(share)});
  }
  // The computed cells: runs of fluid cells and single partial ones, joined.
  Voxels& computed = cells.computed = voxels;
  computed.runs.clear();
  auto next = cells.partial.begin();
  for (std::size_t row = 0; row < voxels.rows(); ++row) {
    const std::size_t begin = computed.runs.size();
    const auto add = [&](const FluidRun& run) {
      if (computed.runs.size() > begin && computed.runs.back().end >= run.begin)
        computed.runs.back().end = std::max(computed.runs.back().end, run.end);
      else
        computed.runs.push_back(run);
    };
    const auto row_end = static_cast<std::int64_t>(row + 1) * voxels.size[0];
    const auto add_partial = [&](int before) {
      for (; next != cells.partial.end() && next->cell < row_end; ++next) {
        const int i = static_cast<int>(next->cell % voxels.size[0]);
        if (i >= before) return;
        add({i, i + 1});
      }
    };
    for (const FluidRun& run : voxels.row(row)) {
      add_partial(run.begin);
      add(run);
    }
    add_partial(voxels.size[0]);
    computed.first[row + 1] = computed.runs.size();
  }
  return cells;
}

}  // namespace puffin::lbm
