#include "coupling/mesh_walls.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace puffin::coupling {

namespace {

using Eigen::Vector3d;
using lbm::geometry::Feature;
using lbm::geometry::NearTriangle;
using lbm::geometry::TriangleMesh;
using lbm::geometry::TriangleTree;

// Nodes of the distance grid: at 8 bytes each it stays in a second-level cache's reach and is built in under a second.
constexpr double grid_nodes = 5e5;

float lower_bound(double distance) { return static_cast<float>(distance * (1.0 - 1e-6)); }

}  // namespace

MeshWalls::MeshWalls(std::shared_ptr<const TriangleTree> tree, const std::vector<int>& openings, double smooth_angle)
    : tree_(std::move(tree)), cos_smooth_(std::cos(smooth_angle)) {
  if (!tree_) throw std::invalid_argument("MeshWalls: no tree");
  opening_.assign(tree_->mesh().triangles.size(), 0);
  for (const int t : openings) {
    if (t < 0 || t >= static_cast<int>(opening_.size())) {
      throw std::invalid_argument("MeshWalls: opening triangle " + std::to_string(t) + " does not exist");
    }
    opening_[t] = 1;
  }
  measure_distances();
}

Vector3d MeshWalls::node_at(int i, int j, int k) const { return first_node_ + spacing_ * Vector3d(i, j, k); }

void MeshWalls::measure_distances() {
  const Vector3d extent = tree_->max() - tree_->min();
  // A flat box still gets a few nodes across.
  const Vector3d sides = extent.cwiseMax(1e-3 * extent.maxCoeff());
  spacing_ = std::max(std::cbrt(sides.prod() / grid_nodes), extent.maxCoeff() / 4000.0);
  for (int d = 0; d < 3; ++d) nodes_[d] = static_cast<int>(std::ceil(extent[d] / spacing_)) + 2;
  first_node_ = tree_->min() - 0.5 * Vector3d::Constant(spacing_);

  TriangleMesh wall_mesh;
  wall_mesh.vertices = tree_->mesh().vertices;
  for (std::size_t t = 0; t < opening_.size(); ++t) {
    if (!opening_[t]) wall_mesh.triangles.push_back(tree_->mesh().triangles[t]);
  }
  std::unique_ptr<TriangleTree> walls;
  const bool all_walls = wall_mesh.triangles.size() == opening_.size();
  if (!all_walls && !wall_mesh.triangles.empty()) walls = std::make_unique<TriangleTree>(std::move(wall_mesh));

  const std::size_t n = static_cast<std::size_t>(nodes_[0]) * nodes_[1] * nodes_[2];
  wall_distance_.assign(n, std::numeric_limits<float>::max());
  signed_clearance_.assign(n, 0.0f);
  tbb::parallel_for(0, nodes_[1] * nodes_[2], [&](int row) {
    const int j = row % nodes_[1], k = row / nodes_[1];
    double any = std::numeric_limits<double>::infinity(), wall = any;
    bool in = false;  // the first node of a row lies before the box of the mesh
    for (int i = 0; i < nodes_[0]; ++i) {
      const Vector3d p = node_at(i, j, k);
      const std::size_t at = i + static_cast<std::size_t>(nodes_[0]) * row;
      // On the same side as the node before unless the surface lies between: a short ray where a winding number would
      // sum over many triangles. Rays find an edge that they touch, so none slips through.
      if (i > 0 && any <= spacing_ && tree_->first_hit(node_at(i - 1, j, k), p - node_at(i - 1, j, k), 1.0))
        in = tree_->inside(p);
      // The distance changes by at most the way between the nodes: a limit that makes the search short.
      any = tree_->closest(p, any + 1.001 * spacing_).distance;
      signed_clearance_[at] = in ? lower_bound(any) : -lower_bound(any);
      if (walls) wall = walls->closest(p, wall + 1.001 * spacing_).distance;
      if (all_walls) wall = any;
      if (std::isfinite(wall)) wall_distance_[at] = lower_bound(wall);
    }
  });
}

MeshWalls::Node MeshWalls::nearest_node(const Vector3d& p) const {
  std::array<int, 3> n;
  for (int d = 0; d < 3; ++d) {
    const double x = std::clamp((p[d] - first_node_[d]) / spacing_ + 0.5, 0.0, nodes_[d] - 0.5);
    n[d] = static_cast<int>(x);
  }
  const Vector3d place = node_at(n[0], n[1], n[2]);
  return {n[0] + static_cast<std::size_t>(nodes_[0]) * (n[1] + static_cast<std::size_t>(nodes_[1]) * n[2]),
          (p - place).norm(), place};
}

dem::RestOfWall MeshWalls::near(const Vector3d& centre, double reach, std::vector<dem::WallTouch>& touches) const {
  touches.clear();
  static thread_local std::vector<Feature> features;
  static thread_local std::vector<NearTriangle> triangles;
  features.clear(), triangles.clear();
  tree_->near_features(centre, reach, &opening_, features, lbm::geometry::Side::inner, &triangles);
  std::sort(features.begin(), features.end(), [](const Feature& a, const Feature& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
  });
  for (const Feature& f : features) {
    const Vector3d away = centre - f.point;
    const bool same = std::any_of(touches.begin(), touches.end(), [&](const dem::WallTouch& t) {
      return away.dot(centre - t.point) >= cos_smooth_ * f.distance * t.distance;
    });
    if (!same) touches.push_back({f.point, f.distance, f.triangle});
  }
  dem::RestOfWall rest;
  for (const NearTriangle& t : triangles) {
    if (lies_on_a_plane(t, centre, reach, touches)) continue;
    rest.distance = std::min(rest.distance, t.distance);
    double lead = 0.0;  // as it stays where the triangle is nearer than every touch
    bool behind = false;
    for (const dem::WallTouch& touch : touches) {
      const double here = t.distance - touch.distance;
      if (here < -1e-6 * touch.distance) continue;  // at the edge or corner that is touched it is rounding
      lead = behind ? std::min(lead, std::max(0.0, here)) : std::max(0.0, here);
      behind = true;
    }
    rest.lead = std::min(rest.lead, lead);
  }
  return rest;
}

bool MeshWalls::lies_on_a_plane(const NearTriangle& t, const Vector3d& centre, double reach,
                                const std::vector<dem::WallTouch>& touches) const {
  constexpr double same_plane = 1e-4;  // angle [rad], and of the reach: an overlap of a micrometre is known to 1 %
  const Vector3d outward = tree_->mesh().area_vector(t.triangle).stableNormalized();
  return std::any_of(touches.begin(), touches.end(), [&](const dem::WallTouch& touch) {
    const Vector3d away = centre - touch.point;
    return away.cross(outward).squaredNorm() <= same_plane * same_plane * touch.distance * touch.distance &&
           std::abs(outward.dot(t.point - touch.point)) <= same_plane * reach;
  });
}

double MeshWalls::clearance(const Vector3d& centre, double limit) const {
  const Node node = nearest_node(centre);
  return std::clamp(wall_distance_[node.index] - node.away, 0.0, std::max(limit, 0.0));
}

bool MeshWalls::encloses(const Vector3d& point) const {
  const Node node = nearest_node(point);
  const float s = signed_clearance_[node.index];
  if (std::abs(s) > node.away) return s > 0.0f;
  // Same side as the node if no triangle lies between: far cheaper than a winding number so near the surface.
  if (!tree_->first_hit(point, node.place - point, 1.0)) return std::signbit(s) == 0;
  return tree_->inside(point);
}

std::optional<int> MeshWalls::left_through(const Vector3d& before, const Vector3d& now) const {
  if (encloses(now)) return std::nullopt;
  if (const auto hit = tree_->first_hit(before, now - before, 1.0))
    return opening_[hit->triangle] ? std::optional(hit->triangle) : std::nullopt;
  if (!encloses(before)) return std::nullopt;  // it has been outside since it went through a wall
  return beyond_opening(now);                  // within rounding of the surface
}

std::optional<int> MeshWalls::beyond_opening(const Vector3d& point) const {
  if (encloses(point)) return std::nullopt;
  const lbm::geometry::Closest nearest = tree_->closest(point);
  if (nearest.triangle < 0) return std::nullopt;
  if (opening_[nearest.triangle]) return nearest.triangle;
  // Beyond an edge both its triangles are equally near, but for the rounding of coordinates as large as the mesh.
  const double reach = (1.0 + 1e-9) * nearest.distance + 1e-12 * (tree_->max() - tree_->min()).maxCoeff();
  std::vector<Feature> features;
  std::vector<NearTriangle> triangles;
  tree_->near_features(point, reach, nullptr, features, lbm::geometry::Side::both, &triangles);
  std::optional<int> lowest;
  for (const NearTriangle& t : triangles)
    if (opening_[t.triangle] && (!lowest || t.triangle < *lowest)) lowest = t.triangle;
  return lowest;
}

bool MeshWalls::inside(const Vector3d& point) const { return encloses(point) || beyond_opening(point).has_value(); }

}  // namespace puffin::coupling
