#pragma once
// The walls that carriers meet: the triangles of the device, less its openings.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "dem/walls.hpp"
#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::coupling {

/// dem::Walls over a closed triangle mesh that points outwards. Immutable, thread-safe.
class MeshWalls : public dem::Walls {
 public:
  /// `openings`: triangles that carriers pass through. `smooth_angle` [rad]: of touches whose directions differ by less
  /// only the nearest is kept, so that a curved wall made of facets pushes once, not once a facet.
  /// Throws std::invalid_argument if tree is null or an opening is out of range.
  explicit MeshWalls(std::shared_ptr<const lbm::geometry::TriangleTree> tree, const std::vector<int>& openings = {},
                     double smooth_angle = 0.26);

  /// Walls are felt from the enclosed side only: never through a thin wall, and not by a centre in the solid.
  dem::RestOfWall near(const Eigen::Vector3d& centre, double reach,
                       std::vector<dem::WallTouch>& touches) const override;
  /// From a grid of distances d_i at nodes x_i: d >= d_i - |centre - x_i|, at the nearest node. Openings do not count.
  double clearance(const Eigen::Vector3d& centre, double limit) const override;
  /// In the enclosed volume, or beyond_opening().
  bool inside(const Eigen::Vector3d& point) const override;
  /// In the enclosed volume.
  bool encloses(const Eigen::Vector3d& point) const;
  /// The opening triangle through which the straight way from `before` to `now` leaves the enclosed volume; nothing if
  /// `now` lies in it, if the way meets a wall first, or if all of it lies outside.
  std::optional<int> left_through(const Eigen::Vector3d& before, const Eigen::Vector3d& now) const;
  /// The opening triangle that is the nearest surface of a point outside the enclosed volume, of one at an edge of wall
  /// and opening the latter. Obliquely behind a hole in a plate the plate is nearer: where the way is known,
  /// left_through() knows better.
  std::optional<int> beyond_opening(const Eigen::Vector3d& point) const;

 private:
  std::shared_ptr<const lbm::geometry::TriangleTree> tree_;
  std::vector<char> opening_;  // per triangle of tree_
  double cos_smooth_ = 1.0;

  // Distances to the walls and to any surface, on nodes of a coarse grid around the mesh.
  Eigen::Vector3d first_node_ = Eigen::Vector3d::Zero();
  double spacing_ = 0.0;  // [m]
  std::array<int, 3> nodes_{0, 0, 0};
  std::vector<float> wall_distance_;     // [m] a lower bound
  std::vector<float> signed_clearance_;  // [m] > 0 inside, < 0 outside; magnitude: a lower bound of the distance to any
                                         // triangle
  struct Node {
    std::size_t index = 0;
    double away = 0.0;                                // [m] from the point asked for
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // [m]
  };
  Node nearest_node(const Eigen::Vector3d& p) const;
  Eigen::Vector3d node_at(int i, int j, int k) const;
  /// The triangle, where it is nearest to the centre, lies on the plane of one of the touches.
  bool lies_on_a_plane(const lbm::geometry::NearTriangle& t, const Eigen::Vector3d& centre, double reach,
                       const std::vector<dem::WallTouch>& touches) const;
  void measure_distances();
};

}  // namespace puffin::coupling
