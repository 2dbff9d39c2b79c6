#include "lbm/eddy_length.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace puffin::lbm {

using geometry::Vec3;

std::vector<float> eddy_lengths(const Rows& rows, const LinkGeometry& surface, const AirOptions& options) {
  std::vector<float> les(rows.slots(), 0.0F);
  if (options.smagorinsky <= 0.0) return les;
  const bool vreman = options.eddy == Eddy::vreman;
  // Where a wall model gives the wall its stress, the cell beside it need not: kappa d.
  const double slope = options.wall_model ? 0.41 : 1.0 / 14.0;
  auto walls = std::make_shared<geometry::TriangleMesh>(), outlets = std::make_shared<geometry::TriangleMesh>();
  walls->vertices = outlets->vertices = surface.mesh->vertices;
  for (std::size_t t = 0; t < surface.mesh->triangles.size(); ++t) {
    const BoundaryKind kind = surface.boundaries[surface.patch_of_triangle[t]].kind;
    if (kind == BoundaryKind::wall || kind == BoundaryKind::pressure_outlet) {
      auto& mesh = kind == BoundaryKind::wall ? walls : outlets;
      mesh->triangles.push_back(surface.mesh->triangles[t]);
      mesh->solid.push_back(0);
    }
  }
  using geometry::TriangleTree;
  const auto tree_of = [](const std::shared_ptr<geometry::TriangleMesh>& mesh) {
    return mesh->triangles.empty() ? nullptr : std::make_unique<TriangleTree>(mesh);
  };
  const auto wall_tree = tree_of(walls), outlet_tree = tree_of(outlets);
  const double dx = rows.dx(), reach = options.smagorinsky / slope * dx;
  for_each_chunk(rows, [&](int, const Chunk& chunk) {
    for (int r = chunk.first_run; r < chunk.last_run; ++r)
      for (int n = 0; n < rows.runs()[r].count; ++n) {
        const std::ptrdiff_t slot = rows.runs()[r].first + n;
        const Vec3 x = rows.centre(slot);
        double length = options.smagorinsky;
        if (outlet_tree && options.sponge_length > 0.0) {
          const double d = outlet_tree->closest(x, options.sponge_length).distance;
          if (d < options.sponge_length) length *= 3.0 - 2.0 * d / options.sponge_length;
        }
        if (wall_tree && !vreman)
          length = std::min(length, slope * std::max(0.5, wall_tree->closest(x, 3.0 * reach).distance / dx));
        les[slot] = static_cast<float>((vreman ? 2.5 : 18.0 * std::sqrt(2.0)) * length * length);
      }
  });
  return les;
}

}  // namespace puffin::lbm
