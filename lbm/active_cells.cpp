#include "lbm/active_cells.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

#include "lbm/geometry/solid_fraction.hpp"

namespace puffin::lbm {

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

Voxels padded(const Voxels& voxels, int margin, const std::array<bool, 3>& periodic) {
  Voxels out;
  out.dx = voxels.dx;
  std::array<int, 3> low{0, 0, 0};
  for (int d = 0; d < 3; ++d) {
    low[d] = periodic[d] ? 0 : margin;
    out.size[d] = voxels.size[d] + 2 * low[d];
    out.origin[d] = voxels.origin[d] - low[d] * voxels.dx;
  }
  out.fluid.assign(static_cast<std::size_t>(out.size[0]) * out.size[1] * out.size[2], 0);
  for (int k = 0; k < voxels.size[2]; ++k)
    for (int j = 0; j < voxels.size[1]; ++j)
      for (int i = 0; i < voxels.size[0]; ++i)
        out.fluid[out.index(i + low[0], j + low[1], k + low[2])] = voxels.fluid[voxels.index(i, j, k)];
  return out;
}

ActiveCells with_band(const Voxels& voxels, const LinkGeometry& surface, double depth,
                      const std::array<bool, 3>& periodic) {
  ActiveCells cells;
  cells.computed = padded(voxels, static_cast<int>(std::ceil(depth)) + 1, periodic);
  Voxels& v = cells.computed;
  cells.centre_inside = v.fluid;
  const auto walls = tree_of(surface, [](const Boundary& b) { return b.kind == BoundaryKind::wall; });
  const auto openings = tree_of(surface, is_opening);
  if (!walls) return cells;
  const double reach = depth * v.dx;
  std::vector<Vec3> shifts{Vec3::Zero()};  // a wall is near across a periodic face too
  for (int d = 0; d < 3; ++d) {
    if (!periodic[d]) continue;
    const std::size_t n = shifts.size();
    for (std::size_t s = 0; s < n; ++s)
      for (const double sign : {-1.0, 1.0}) shifts.push_back(shifts[s] + sign * v.dx * v.size[d] * Vec3::Unit(d));
  }
  oneapi::tbb::parallel_for(0, v.size[2], [&](int k) {
    for (int j = 0; j < v.size[1]; ++j)
      for (int i = 0; i < v.size[0]; ++i) {
        const auto at = v.index(i, j, k);
        if (cells.centre_inside[at]) continue;
        const Vec3 x = v.centre(i, j, k);
        if (beyond(openings.get(), x, 2.0 * reach)) continue;
        for (const Vec3& shift : shifts) {
          if (walls->closest(x + shift, reach).triangle < 0) continue;
          v.fluid[at] = 1;
          break;
        }
      }
  });
  return cells;
}

ActiveCells with_cut_cells(const Voxels& voxels, const LinkGeometry& surface, double least) {
  ActiveCells cells;
  cells.computed = voxels;
  cells.centre_inside = voxels.fluid;
  cells.solid.assign(voxels.fluid.size(), 1.0F);
  for (std::size_t n = 0; n < voxels.fluid.size(); ++n)
    if (voxels.fluid[n]) cells.solid[n] = 0.0F;
  std::vector<char> openings(surface.mesh->triangles.size(), 0);
  for (std::size_t t = 0; t < openings.size(); ++t)
    openings[t] = is_opening(surface.boundaries[surface.patch_of_triangle[t]]) ? 1 : 0;
  const TriangleTree tree(std::make_shared<TriangleMesh>(*surface.mesh));
  const auto opening_tree = tree_of(surface, is_opening);
  for (const auto& cut : geometry::cut_cells(tree, voxels, openings)) {
    // Of the part on this side of an opening, how much is solid.
    const double here = 1.0 - cut.beyond;
    const double share = here > 1e-6 ? std::clamp(cut.solid() / here, 0.0, 1.0) : 1.0;
    const bool inside = cells.centre_inside[cut.cell] != 0;
    if (!inside) {
      const auto i = static_cast<int>(cut.cell % voxels.size[0]);
      const auto j = static_cast<int>((cut.cell / voxels.size[0]) % voxels.size[1]);
      const auto k = static_cast<int>(cut.cell / (static_cast<std::int64_t>(voxels.size[0]) * voxels.size[1]));
      if (share > 1.0 - least || beyond(opening_tree.get(), voxels.centre(i, j, k), 2.0 * voxels.dx)) continue;
    }
    cells.solid[cut.cell] = static_cast<float>(share);
    cells.computed.fluid[cut.cell] = 1;
  }
  return cells;
}

}  // namespace puffin::lbm
