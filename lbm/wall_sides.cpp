#include "lbm/wall_sides.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <memory>

namespace puffin::lbm {

using geometry::Vec3;

WallSides::WallSides(const Rows& rows, const LinkGeometry& surface, double reach) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  mesh->vertices = surface.mesh->vertices;
  std::vector<int> original;
  for (int t = 0; t < static_cast<int>(surface.mesh->triangles.size()); ++t) {
    if (surface.boundaries[surface.patch_of_triangle[t]].kind != BoundaryKind::wall) continue;
    mesh->triangles.push_back(surface.mesh->triangles[t]);
    mesh->solid.push_back(0);
    original.push_back(t);
  }
  index_.assign(rows.slots(), -1);
  for (int d = 0; d < 3; ++d)
    if (rows.periodic()[d]) period_[d] = rows.dx() * rows.box()[d];
  if (mesh->triangles.empty()) return;
  const geometry::TriangleTree tree(mesh);
  std::vector<Vec3> shifts{Vec3::Zero()};
  for (int d = 0; d < 3; ++d) {
    if (period_[d] == 0.0) continue;
    const std::size_t n = shifts.size();
    for (std::size_t s = 0; s < n; ++s)
      for (const double sign : {-1.0, 1.0}) shifts.push_back(shifts[s] + sign * period_[d] * Vec3::Unit(d));
  }
  std::vector<WallPlace> found(rows.slots());
  oneapi::tbb::parallel_for(std::size_t{0}, rows.runs().size(), [&](std::size_t r) {
    for (int n = 0; n < rows.runs()[r].count; ++n) {
      const std::ptrdiff_t slot = rows.runs()[r].first + n;
      const Vec3 x = rows.centre(slot);
      WallPlace& place = found[slot];
      place.distance = reach * rows.dx();
      for (const Vec3& shift : shifts) {
        const auto near = tree.closest(x + shift, place.distance);
        if (near.triangle < 0 || !(near.distance < place.distance)) continue;
        place = {near.point - shift, mesh->area_vector(near.triangle).normalized(), near.distance,
                 original[near.triangle]};
      }
    }
  });
  for (std::size_t s = 0; s < found.size(); ++s) {
    if (found[s].triangle < 0) continue;
    index_[s] = static_cast<std::int32_t>(places_.size());
    places_.push_back(found[s]);
  }
}

Vec3 WallSides::apart(const WallPlace& a, const WallPlace& b) const {
  Vec3 apart = b.point - a.point;
  for (int d = 0; d < 3; ++d)
    if (period_[d] > 0.0) apart[d] -= period_[d] * std::round(apart[d] / period_[d]);
  return apart;
}

bool WallSides::parted(const WallPlace& a, const WallPlace& b) const {
  return a.normal.dot(b.normal) <= -0.3 && apart(a, b).dot(a.normal) > 0.0;
}

}  // namespace puffin::lbm
