#include "coupling/wall_faces.hpp"

#include <Eigen/Core>
#include <cmath>

#include "lbm/scalars/run_faces.hpp"

namespace puffin::coupling {

namespace {

using Eigen::Vector3d;

/// The triangle that a face belongs to, -1: none. `found` is scratch.
int wall_of(const lbm::geometry::TriangleTree& tree, const Vector3d& centre, const Vector3d& towards, double dx,
            const std::vector<char>& opening, std::vector<lbm::geometry::Feature>& found) {
  found.clear();
  tree.near_features(centre, 2.0 * dx, &opening, found);
  double nearest = 2.0 * dx;
  for (const auto& wall : found) nearest = std::min(nearest, wall.distance);
  int best = -1;
  double looks = -2.0;
  for (const auto& wall : found) {
    if (wall.distance > nearest + 1e-3 * dx) continue;
    const double along = towards.dot(tree.mesh().area_vector(wall.triangle).normalized());
    if (along > looks || (along == looks && wall.triangle < best)) best = wall.triangle, looks = along;
  }
  return best;
}

}  // namespace

std::array<std::vector<lbm::ScalarWork::WallFace>, 3> find_wall_faces(
    const lbm::Rows& rows, const lbm::FaceFluxes& fluxes, const lbm::geometry::TriangleTree& tree,
    const std::vector<char>& opening, const std::vector<int>& patch_of, const std::vector<char>& wanted) {
  std::array<std::vector<lbm::ScalarWork::WallFace>, 3> faces;
  std::vector<lbm::geometry::Feature> found;
  for (const lbm::Run& run : rows.runs())
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
      for (int d = 0; d < 3; ++d)
        for (const double side : {-1.0, 1.0}) {
          if (fluxes.open[d][side < 0.0 ? s + lbm::offset_low(run, d) : s] != 0) continue;
          const Vector3d towards = side * Vector3d::Unit(d), centre = rows.centre(s) + 0.5 * rows.dx() * towards;
          const int triangle = wall_of(tree, centre, towards, rows.dx(), opening, found);
          const int patch = triangle < 0 ? -1 : patch_of[static_cast<std::size_t>(triangle)];
          if (patch >= 0 && wanted[static_cast<std::size_t>(patch)]) faces[d].push_back({s, patch});
        }
  return faces;
}

}  // namespace puffin::coupling
