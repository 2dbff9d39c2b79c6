#pragma once
// What the carriers need to know of the walls: where does a sphere come near them?

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace puffin::dem {

/// One physical contact place of a sphere with the walls: a local minimum of the distance from the sphere's centre.
struct WallTouch {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // nearest point of the wall [m]
  double distance = 0.0;                            // from the centre [m], >= 0
  int triangle = -1;                                // a triangle that holds the point
};

/// The wall around a sphere's centre apart from the planes of the touches that were listed: through each touch's point,
/// square to the way from there to the centre.
struct RestOfWall {
  double distance = std::numeric_limits<double>::infinity();  // from the centre, of its nearest place [m]
  double lead = std::numeric_limits<double>::infinity();      // smallest way by which a listed touch is nearer [m]
};

class Walls {
 public:
  virtual ~Walls() = default;
  /// All contact places within `reach` [m] of `centre` [m]; each face, edge or vertex contact once, also across the
  /// shared edges of triangles. Cleared first. Thread-safe. Returns what else there is within reach; nothing if the
  /// wall is made of planes that do not end.
  virtual RestOfWall near(const Eigen::Vector3d& centre, double reach, std::vector<WallTouch>& touches) const = 0;
  /// A lower bound of the distance from `centre` to the nearest wall, not above `limit`; cheap.
  virtual double clearance(const Eigen::Vector3d& centre, double limit) const = 0;
  /// True if the point lies inside the walls, or beyond an opening.
  virtual bool inside(const Eigen::Vector3d& point) const = 0;
};

}  // namespace puffin::dem
