#include "dem/wall_cache.hpp"

#include <algorithm>
#include <cmath>

namespace puffin::dem {
namespace {

// Around an edge or a corner the plane's direction is off by s/R after the way s, and so is that of a push: with s =
// 0.01 R by half a degree. On a face it is exact, so the trusted way grows while the planes prove exact.
constexpr double first_trust = 0.001, growth = 4.0;  // in radii
// Beside an edge between flat faces another face takes over where the two are equally far. After the way s past that
// place the overlap is off by s times the sine of the angle between them, less than 0.26 where one contact serves both.
constexpr double least_trust = 1e-4;  // in radii
constexpr double exact = 1e-9;        // in radii

/// True if every new touch lies on a plane that was known already.
bool planes_were_exact(const std::vector<WallTouch>& touches, const WallCache& cache, const Eigen::Vector3d& centre,
                       double radius) {
  for (const WallTouch& touch : touches) {
    bool known = false;
    for (const WallPlane& plane : cache.planes)
      known = known || std::abs(plane.gap(centre, 0.0) - touch.distance) <= exact * radius;
    if (!known) return false;
  }
  return !cache.planes.empty();
}

}  // namespace

void look_at_walls(const Walls& walls, const Eigen::Vector3d& centre, double radius, double travel,
                   std::vector<WallTouch>& touches, WallCache& cache) {
  if (cache.clear >= 0.0) {
    const double moved = (centre - cache.asked_at).norm();
    // Planes beyond their trust are looked at again by the caller on the way, so only the present place counts.
    if (moved + travel + radius < cache.clear && (cache.planes.empty() || moved <= cache.trust)) return;
  }
  // Cheap first: is there anything at all?
  const double need = radius + travel;
  const double far = need + 8.0 * std::max(radius, travel);
  const double clearance = walls.clearance(centre, far);
  if (clearance > need) {
    cache.asked_at = centre;
    cache.clear = clearance;
    cache.trust = 0.0;
    cache.planes.clear();
    return;
  }
  const double reach = need + std::max(0.5 * radius, travel);
  const RestOfWall rest = walls.near(centre, reach, touches);
  const bool were_exact = cache.clear >= 0.0 && planes_were_exact(touches, cache, centre, radius);
  cache.trust = were_exact ? std::min(growth * cache.trust, largest_trust * radius) : first_trust * radius;
  // On a way s a place that is not listed comes nearer by at most s, and a listed one goes away by at most s.
  const double unchanged = std::max(0.5 * rest.lead, rest.distance - radius);
  cache.trust = std::min(cache.trust, std::max(unchanged, least_trust * radius));
  cache.asked_at = centre;
  cache.clear = reach;
  cache.planes.clear();
  for (const WallTouch& touch : touches) {
    if (touch.distance <= 0.0) continue;  // the centre lies on the wall: no direction; inside() tells the caller
    cache.planes.push_back({touch.point, (centre - touch.point) / touch.distance, touch.triangle});
  }
}

}  // namespace puffin::dem
