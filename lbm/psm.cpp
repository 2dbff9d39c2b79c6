#include "lbm/psm.hpp"

#include <memory>

namespace puffin::lbm {

const double psm_least_tau = 0.51;

PartialCells find_partial_cells(const Rows& rows, const ActiveCells& cells, const LinkGeometry& surface,
                                bool double_precision) {
  PartialCells partial;
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  mesh->vertices = surface.mesh->vertices;
  std::vector<int> patch_of;
  bool moving = false;
  for (std::size_t t = 0; t < surface.mesh->triangles.size(); ++t) {
    const int patch = surface.patch_of_triangle[t];
    if (surface.boundaries[patch].kind != BoundaryKind::wall) continue;
    moving = moving || static_cast<bool>(surface.boundaries[patch].profile);
    mesh->triangles.push_back(surface.mesh->triangles[t]);
    mesh->solid.push_back(0);
    patch_of.push_back(patch);
  }
  const auto walls = mesh->triangles.empty() ? nullptr : std::make_unique<geometry::TriangleTree>(mesh);
  partial.chunks.push_back(0);
  std::size_t filled = 0;
  for (std::size_t r = 0; r < rows.runs().size(); ++r) {
    const Run& run = rows.runs()[r];
    bool joined = false;
    for (int n = 0; n < run.count; ++n) {
      const float eps = cells.solid(cells.computed.index(run.x + n, run.y, run.z));
      if (!(eps > 0.0F)) {
        joined = false;
        continue;
      }
      if (!joined) partial.segments.push_back({run.first + n, 0, static_cast<std::int32_t>(r), partial.solid.size()});
      joined = true;
      ++partial.segments.back().count;
      partial.solid.push_back(eps);
      const geometry::Vec3 x = rows.centre(run.first + n);
      const auto near = walls ? walls->closest(x) : geometry::Closest{};
      const int patch = near.triangle < 0 ? -1 : patch_of[near.triangle];
      partial.patch.push_back(static_cast<std::int16_t>(patch));
      if (!moving) continue;
      geometry::Vec3 u = geometry::Vec3::Zero();
      if (patch >= 0 && surface.boundaries[patch].profile) u = surface.boundaries[patch].profile(near.point);
      for (int d = 0; d < 3; ++d) partial.wall[d].push_back(static_cast<float>(u[d]));
    }
    filled += run.count;
    if (filled >= 4096 && partial.segments.size() > partial.chunks.back()) {
      partial.chunks.push_back(partial.segments.size());
      filled = 0;
    }
  }
  if (partial.segments.size() > partial.chunks.back()) partial.chunks.push_back(partial.segments.size());
  if (double_precision)
    partial.kept_double.assign(20 * partial.cells(), 0.0);
  else
    partial.kept_float.assign(20 * partial.cells(), 0.0F);
  for (auto& t : partial.taken) t.assign(partial.cells(), 0.0F);
  return partial;
}

}  // namespace puffin::lbm
