#include "lbm/cut_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lbm/geometry/row_crossings.hpp"
#include "lbm/populations.hpp"
#include "lbm/wall_sides.hpp"

namespace puffin::lbm {

using geometry::TriangleMesh;
using geometry::TriangleTree;
using geometry::Vec3;

CutFinder::CutFinder(const Rows& rows, const LinkGeometry& surface, const CellKinds& kinds, bool band)
    : rows_(rows), surface_(surface), kinds_(kinds), band_(band) {
  const TriangleMesh& mesh = *surface.mesh;
  auto kept = std::make_shared<TriangleMesh>();
  kept->vertices = mesh.vertices;
  kept->solids = mesh.solids;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (surface.boundaries[surface.patch_of_triangle[t]].kind == BoundaryKind::periodic) continue;
    kept->triangles.push_back(mesh.triangles[t]);
    kept->solid.push_back(mesh.solid[t]);
    original_.push_back(t);
  }
  if (!kept->triangles.empty()) tree_ = std::make_unique<TriangleTree>(kept);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      low = low.cwiseMin(mesh.corner(t, k));
      high = high.cwiseMax(mesh.corner(t, k));
    }
  aside_.setConstant(geometry::on_surface(low, high, rows.dx()));
  shifts_.push_back(Vec3::Zero());
  for (int d = 0; d < 3; ++d) {
    if (!rows.periodic()[d]) continue;
    const std::size_t n = shifts_.size();
    for (std::size_t k = 0; k < n; ++k)
      for (const double sign : {-1.0, 1.0})
        shifts_.push_back(shifts_[k] + sign * rows.dx() * rows.box()[d] * Vec3::Unit(d));
  }
}

std::vector<Cut> CutFinder::cuts(const Run& run, std::ptrdiff_t slot, std::size_t& missed) const {
  std::vector<Cut> found;
  const Vec3 centre = rows_.centre(slot);
  const bool in_fluid = is_fluid(slot);
  bool candidate = !in_fluid;
  for (int i = 1; i < d3q19::q && !candidate; ++i) candidate = is_solid(slot + neighbour_offset(run, i));
  const double reach = 1.4143 * rows_.dx() + 2.0 * aside_.norm();
  for (std::size_t k = 0; k < shifts_.size() && !candidate && tree_; ++k)
    candidate = tree_->closest(centre + shifts_[k], reach).triangle >= 0;
  if (!candidate) return found;
  for (int i = 1; i < d3q19::q; ++i) {
    const auto& c = d3q19::velocity[i];
    const std::ptrdiff_t beside = slot + neighbour_offset(run, i);
    const bool solid = is_solid(beside);
    if (!in_fluid || (!solid && !is_fluid(active(beside)))) {
      const std::int16_t outlet = solid ? outlet_across(slot, c) : std::int16_t{-1};
      if (solid || parted(slot, active(beside)))
        found.push_back({static_cast<std::int8_t>(i), !solid, outlet >= 0 ? outlet : patch_near(slot), 0.5F});
      continue;
    }
    const Vec3 link = rows_.dx() * Vec3(c[0], c[1], c[2]);
    double t = 2.0;  // of the link moved aside
    int triangle = -1;
    Vec3 from = centre;
    for (const Vec3& shift : shifts_) {
      if (!tree_) break;
      const auto hit = tree_->first_hit(centre + shift + aside_, link, 1.0);
      if (hit && hit->t < t) {
        t = hit->t;
        triangle = original_[hit->triangle];
        from = centre + shift;
      }
    }
    const auto patch = static_cast<std::int16_t>(triangle >= 0 ? surface_.patch_of_triangle[triangle] : -1);
    if (const std::int16_t outlet = solid ? outlet_across(slot, c) : std::int16_t{-1}; outlet >= 0) {
      found.push_back({static_cast<std::int8_t>(i), false, outlet, 0.5F});
    } else if (solid) {
      if (triangle < 0) ++missed;
      found.push_back({static_cast<std::int8_t>(i), false, patch, wall_distance(t, triangle, link)});
    } else if (triangle >= 0 && t < 1.0 - 1e-9 && !grazes(from, link, t, triangle)) {
      found.push_back({static_cast<std::int8_t>(i), true, patch, wall_distance(t, triangle, link)});
    } else if (i > 6 && closed_corner(run, slot, c)) {
      found.push_back({static_cast<std::int8_t>(i), true, -1, 0.5F});
    }
  }
  return found;
}

bool CutFinder::grazes(const Vec3& from, const Vec3& link, double t, int triangle) const {
  const auto exit = tree_->first_hit(from + link + aside_, -link, 1.0);
  if (!exit || (1.0 - exit->t - t) * link.norm() > 8.0 * aside_.norm()) return false;
  const Vec3 in = surface_.mesh->area_vector(triangle).normalized(),
             out = surface_.mesh->area_vector(original_[exit->triangle]).normalized();
  return in.dot(out) > -0.9;
}

float CutFinder::wall_distance(double t, int triangle, const Vec3& link) const {
  if (triangle >= 0) {
    const Vec3 normal = surface_.mesh->area_vector(triangle);
    const double along = normal.dot(link);
    if (std::abs(along) > 0.1 * normal.norm() * link.norm()) t += normal.dot(aside_) / along;
  }
  return static_cast<float>(std::clamp(t, 0.0, 1.0));
}

bool CutFinder::is_solid(std::ptrdiff_t slot) const {
  if (rows_.is_active(slot)) return false;
  const auto c = rows_.cell(slot);
  return rows_.active_slot(c[0], c[1], c[2]) < 0;
}

std::ptrdiff_t CutFinder::active(std::ptrdiff_t slot) const {
  const auto c = rows_.cell(slot);
  return rows_.active_slot(c[0], c[1], c[2]);
}

bool CutFinder::parted(std::ptrdiff_t a, std::ptrdiff_t b) const {
  const WallPlace *at_a = kinds_.sides->of(a), *at_b = kinds_.sides->of(b);
  if (at_a == nullptr || at_b == nullptr) return false;
  // Projection on one wall brings neighbours no further apart; behind outer edges normals alone would not tell.
  const bool both_behind = !is_fluid(a) && !is_fluid(b);
  if (both_behind && kinds_.sides->apart(*at_a, *at_b).norm() > 1.5 * rows_.dx()) return true;
  return kinds_.sides->parted(*at_a, *at_b);
}

std::int16_t CutFinder::patch_near(std::ptrdiff_t slot) const {
  const WallPlace* place = kinds_.sides->of(slot);
  return static_cast<std::int16_t>(place != nullptr ? surface_.patch_of_triangle[place->triangle] : -1);
}

std::int16_t CutFinder::outlet_across(std::ptrdiff_t slot, const std::array<int, 3>& c) const {
  if (!band_ || !tree_) return -1;
  const auto cell = rows_.cell(slot);
  for (int d = 0; d < 3; ++d) {
    std::array<int, 3> beside = c, ahead{0, 0, 0};
    beside[d] = 0;
    ahead[d] = c[d];
    if (c[d] == 0 || beside == std::array<int, 3>{0, 0, 0}) continue;
    const std::ptrdiff_t other = rows_.active_slot(cell[0] + beside[0], cell[1] + beside[1], cell[2] + beside[2]);
    if (other < 0 || is_fluid(slot) == is_fluid(other) || parted(slot, other)) continue;
    if (rows_.active_slot(cell[0] + ahead[0], cell[1] + ahead[1], cell[2] + ahead[2]) >= 0) continue;
    Vec3 end = rows_.centre(slot);  // of the fluid cell
    if (!is_fluid(slot)) end += rows_.dx() * Vec3(beside[0], beside[1], beside[2]);
    for (const Vec3& shift : shifts_) {
      const auto hit = tree_->first_hit(end + shift + aside_, rows_.dx() * Vec3(ahead[0], ahead[1], ahead[2]), 1.0);
      if (!hit) continue;
      const int patch = surface_.patch_of_triangle[original_[hit->triangle]];
      if (surface_.boundaries[patch].kind == BoundaryKind::pressure_outlet) return static_cast<std::int16_t>(patch);
    }
  }
  return -1;
}

bool CutFinder::closed_corner(const Run& run, std::ptrdiff_t slot, const std::array<int, 3>& c) const {
  int solid = 0;
  for (int i = 1; i <= 6; ++i) {
    const auto& a = d3q19::velocity[i];
    if (a[0] * c[0] + a[1] * c[1] + a[2] * c[2] == 1) solid += is_solid(slot + neighbour_offset(run, i));
  }
  return solid == 2;
}

}  // namespace puffin::lbm
