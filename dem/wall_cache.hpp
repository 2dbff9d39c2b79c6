#pragma once
// What a carrier remembers of the walls around it, so that it need not ask at every step.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dem/walls.hpp"

namespace puffin::dem {

/// A place of the wall near a carrier, as the plane through `point` with `normal`. Exact on faces; on edges and corners
/// right to second order in the carrier's travel, so the place is asked for again after a short way.
struct WallPlane {
  Eigen::Vector3d point, normal;  // [m], unit, towards the carrier
  std::int32_t triangle = -1;
  double gap(const Eigen::Vector3d& centre, double radius) const { return normal.dot(centre - point) - radius; }
};

/// So far a plane may be trusted at most, in radii: on a longer way another place of the wall may come up.
constexpr double largest_trust = 0.2;

struct WallCache {
  Eigen::Vector3d asked_at = Eigen::Vector3d::Zero();  // centre at the last question [m]
  double clear = -1.0;  // no wall nearer to asked_at than this, but for those in `planes` [m]; < 0: never asked
  double trust = 0.0;   // the planes hold while the centre is within this distance of asked_at [m]
  std::vector<WallPlane> planes;
};

/// True if a carrier of `radius` at `centre` is where what the cache knows of the walls ends.
inline bool beyond_trust(const WallCache& cache, const Eigen::Vector3d& centre, double radius) {
  double trusted = cache.clear - radius;
  if (!cache.planes.empty()) trusted = std::min(trusted, cache.trust);
  return (centre - cache.asked_at).squaredNorm() > trusted * std::abs(trusted);
}

/// Makes `cache` valid for a carrier of `radius` at `centre` that will move at most `travel`: afterwards every wall it
/// may touch on that way is among cache.planes, which may be empty. Asks `walls` only when the old answer will not do.
/// `touches` is scratch.
void look_at_walls(const Walls& walls, const Eigen::Vector3d& centre, double radius, double travel,
                   std::vector<WallTouch>& touches, WallCache& cache);

}  // namespace puffin::dem
