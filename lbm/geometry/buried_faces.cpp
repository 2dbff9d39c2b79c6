#include "lbm/geometry/buried_faces.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lbm/geometry/surface_check.hpp"

namespace puffin::lbm::geometry {

namespace {

constexpr int places = 20000;

/// Fractional part of a multiple; with powers of the plastic number pairs of them fill the square evenly (a Weyl
/// sequence).
double spread(std::size_t n, double step) { return std::fmod(static_cast<double>(n) * step, 1.0); }

/// The n-th place on a triangle.
Vec3 place_on(const TriangleMesh& mesh, int t, std::size_t n) {
  double u = spread(n + 1, 0.7548776662466927), v = spread(n + 1, 0.5698402909980532);
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  const Vec3& a = mesh.corner(t, 0);
  return a + u * (mesh.corner(t, 1) - a) + v * (mesh.corner(t, 2) - a);
}

bool is_buried(const TriangleTree& tree, const Vec3& x, const Vec3& normal, double s) {
  for (const double off : {1e-3, 0.5, 1e-5})
    if (!tree.inside(x + off * s * normal) || !tree.inside(x - off * s * normal)) return false;
  return true;
}

}  // namespace

BuriedPlaces buried_places(const TriangleTree& tree, const std::vector<char>& openings) {
  const TriangleMesh& mesh = tree.mesh();
  const auto closed = [&](int t) { return openings.empty() || !openings[t]; };
  double area = 0.0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    if (closed(t)) area += mesh.area(t);
  BuriedPlaces found;
  if (!(area > 0.0)) return found;
  // A place at every multiple of area/places of the running sum, from half of one on.
  std::vector<int> on;
  double sum = 0.0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (closed(t)) sum += mesh.area(t);
    while (static_cast<int>(on.size()) < places && (static_cast<double>(on.size()) + 0.5) * area < sum * places)
      on.push_back(t);
  }
  const double s = std::sqrt(area / places);
  std::vector<char> buried(on.size(), 0);
  oneapi::tbb::parallel_for(std::size_t{0}, on.size(), [&](std::size_t n) {
    const Vec3 normal = mesh.area_vector(on[n]).stableNormalized();
    buried[n] = is_buried(tree, place_on(mesh, on[n], n), normal, s) ? 1 : 0;
  });
  found.asked = on.size();
  for (std::size_t n = 0; n < on.size(); ++n)
    if (buried[n]) found.where.push_back(place_on(mesh, on[n], n));
  return found;
}

void refuse_buried(const BuriedPlaces& found) {
  if (found.where.size() < 2) return;  // one: a seam that crosses by micrometres, not a body
  throw GeometryError(
      "error: buried face: the surface has a face inside the fluid at " + place_text(found.where[0]) + " (and at " +
      std::to_string(found.where.size() - 1) + " other places of the " + std::to_string(found.asked) +
      " asked): bodies that overlap or share a face. Carriers would meet a wall there; export the union "
      "of the bodies, without faces inside, or give a baffle its thickness");
}

}  // namespace puffin::lbm::geometry
