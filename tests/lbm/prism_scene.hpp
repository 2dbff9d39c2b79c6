#pragma once
// A prism of cells over a polygon, with a chosen boundary on each side: passages that turn, and holes in walls.

#include <vector>

#include "tests/lbm/box_scene.hpp"

namespace puffin::lbm::test {

/// A prism `depth` cells high, periodic along z, over a convex polygon, counter-clockwise, whose corners may lie on its
/// sides, but not on the line through the first and the next. Side n goes from corner n to the next. Cells of size 1.
inline BoxScene make_prism(const std::vector<Eigen::Vector2d>& corners, const std::vector<Boundary>& sides, int depth) {
  using geometry::Vec3;
  BoxScene scene;
  const int n = static_cast<int>(corners.size());
  for (const double z : {0.0, static_cast<double>(depth)})
    for (const auto& c : corners) scene.mesh.vertices.push_back(Vec3(c.x(), c.y(), z));
  const auto add = [&](int a, int b, int c, int patch) {
    scene.mesh.triangles.push_back({a, b, c});
    scene.mesh.solid.push_back(patch);
    scene.surface.patch_of_triangle.push_back(patch);
  };
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    add(k, next, next + n, k);
    add(k, next + n, k + n, k);
  }
  for (int k = 1; k + 1 < n; ++k) {
    add(0, k + 1, k, n);
    add(n, n + k, n + k + 1, n + 1);
  }
  scene.surface.boundaries = sides;
  scene.surface.boundaries.insert(scene.surface.boundaries.end(), {periodic(), periodic()});
  for (std::size_t b = 0; b < scene.surface.boundaries.size(); ++b) {
    scene.surface.boundaries[b].patch = "side-" + std::to_string(b);
    scene.mesh.solids.push_back(scene.surface.boundaries[b].patch);
  }
  Eigen::Vector2d low = corners[0], high = corners[0];
  for (const auto& c : corners) low = low.cwiseMin(c), high = high.cwiseMax(c);
  auto& v = scene.voxels;
  v.dx = 1.0;
  for (int d = 0; d < 2; ++d) {
    v.size[d] = static_cast<int>(std::ceil(high[d] - low[d])) + 2;
    v.origin[d] = std::floor(low[d]) - 0.5;
  }
  v.size[2] = depth, v.origin[2] = 0.5;
  v.fill([&](int i, int j, int k) {
    const Vec3 x = v.centre(i, j, k);
    for (int m = 0; m < n; ++m) {
      const Eigen::Vector2d along = corners[(m + 1) % n] - corners[m], to = x.head<2>() - corners[m];
      if (along.x() * to.y() - along.y() * to.x() <= 0.0) return false;
    }
    return true;
  });
  return scene;
}

}  // namespace puffin::lbm::test
