#pragma once
// A bounding-volume hierarchy over a triangle mesh: nearest point, first hit of a ray, winding number, contact places.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "lbm/geometry/adjacency.hpp"
#include "lbm/geometry/tree_search.hpp"
#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Nearest point of the surface. triangle = -1 and distance = infinity if nothing lies within the limit.
struct Closest {
  Vec3 point = Vec3::Zero();
  double distance = std::numeric_limits<double>::infinity();
  int triangle = -1;
  Vec3 outward = Vec3::Zero();  // the triangle's area_vector
};

/// A crossing of a ray: from + t * direction lies on `triangle`.
struct Hit {
  double t = 0.0;
  int triangle = -1;
};

/// A contact place of a sphere: a local minimum of the distance from its centre to the surface.
struct Feature {
  Vec3 point = Vec3::Zero();
  double distance = 0.0;  // [m] >= 0
  int triangle = -1;      // a triangle that holds the point
};

/// A triangle within reach of a sphere's centre.
struct NearTriangle {
  Vec3 point = Vec3::Zero();  // of it, nearest to the centre
  double distance = 0.0;      // [m] >= 0
  int triangle = -1;
};

/// Which side of the surface counts in near_features.
enum class Side {
  both,
  inner  // only features whose enclosed side faces the centre: a wall's far side is not felt through the wall
};

/// Immutable after construction and safe to query from any thread. Built in parallel; the tree and every answer are the
/// same for any number of threads.
class TriangleTree {
 public:
  /// Throws std::invalid_argument if the mesh has no triangles, an index out of range, or a non-finite vertex.
  explicit TriangleTree(TriangleMesh mesh);
  explicit TriangleTree(std::shared_ptr<const TriangleMesh> mesh);

  const TriangleMesh& mesh() const { return *mesh_; }
  const Adjacency& adjacency() const { return adjacency_; }
  const Vec3& min() const { return min_; }  // bounding box [m]
  const Vec3& max() const { return max_; }

  /// Nearest point of the surface to p within `limit` [m]; of triangles equally near, that of the lowest index.
  Closest closest(const Vec3& p, double limit = std::numeric_limits<double>::infinity()) const;

  /// Smallest t in [0, t_max] at which from + t * direction meets a triangle; either side counts. Watertight after
  /// Woop, Benthin & Wald, J. Comput. Graph. Tech. 2(1), 65 (2013): no ray passes between triangles that share
  /// vertices.
  std::optional<Hit> first_hit(const Vec3& from, const Vec3& direction, double t_max) const;

  /// Generalised winding number (Jacobson et al., ACM TOG 32(4), 33 (2013)): 1 inside, 0 outside a closed surface whose
  /// triangles point outwards, -1 inside one that is inside out; in between near holes. Near triangles by their exact
  /// solid angle (van Oosterom & Strackee 1983), far clusters by their dipole (Barill et al., ACM TOG 37(4), 43
  /// (2018)). Error below 2e-3.
  double winding_number(const Vec3& p) const;

  /// |winding number| > 1/2.
  bool inside(const Vec3& p) const;

  /// Appends every contact place within `reach` [m] of `centre`, each once: faces, and those edges and vertices (given
  /// as the lowest of their triangles) that are a local minimum of the distance over all triangles that share them (so
  /// never an edge between coplanar triangles or in a concave corner). Triangles t with (*skip_triangle)[t] != 0 do not
  /// exist for this query. The mesh must be welded. `triangles`: gets every triangle within reach, of either side.
  void near_features(const Vec3& centre, double reach, const std::vector<char>* skip_triangle,
                     std::vector<Feature>& out, Side side = Side::both,
                     std::vector<NearTriangle>* triangles = nullptr) const;

  /// Triangles whose bounding boxes overlap the box [low, high], in no special order; appended to `out`.
  void overlapping(const Vec3& low, const Vec3& high, std::vector<int>& out) const;

 private:
  // Far field of one child, expanded around its area-weighted centre: sum of the area vectors A_t and, of sum A_t
  // (c_t - centre)^T with the triangles' centres c_t, the trace and the symmetric part (xx, yy, zz, xy, yz, zx).
  struct Dipole {
    Vec3 centre = Vec3::Zero(), area = Vec3::Zero();
    std::array<double, 6> moment{};
    double radius = 0.0, weight = 0.0;  // of the corners around the centre; sum of the areas
  };
  struct Corners {
    Vec3 a, b, c;
  };
  class Builder;
  void set_leaves();
  void set_dipoles();
  TreeSearch search(const Vec3& p, double limit) const;
  static float squared_limit(double distance, float tolerance);

  std::shared_ptr<const TriangleMesh> mesh_;
  Adjacency adjacency_;
  Vec3 min_ = Vec3::Zero(), max_ = Vec3::Zero(), centre_ = Vec3::Zero();
  std::vector<TreeNode> nodes_;
  std::vector<LeafTriangles> leaves_;
  std::vector<std::array<Dipole, lanes>> dipoles_;
  // By slot: leaf * lanes + lane. Slots without a triangle have order_ -1.
  std::vector<Corners> corners_;
  std::vector<std::int32_t> order_;  // slot -> triangle
};

}  // namespace puffin::lbm::geometry
