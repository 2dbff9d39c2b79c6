#include "tools/output/picture/wall_shape.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace puffin::output {
namespace {

Vec3 corner(const WallFrame& walls, std::size_t triangle, int k) {
  return point_of(walls.vertices[walls.triangles[triangle][k]]);
}

Vec3 area_vector(const WallFrame& walls, std::size_t t) {
  return 0.5 * (corner(walls, t, 1) - corner(walls, t, 0)).cross(corner(walls, t, 2) - corner(walls, t, 0));
}

}  // namespace

Extent extent_of(const WallFrame& walls) {
  if (walls.vertices.empty()) return {};
  Extent extent{point_of(walls.vertices[0]), point_of(walls.vertices[0])};
  for (const auto& vertex : walls.vertices) {
    extent.low = extent.low.cwiseMin(point_of(vertex));
    extent.high = extent.high.cwiseMax(point_of(vertex));
  }
  return extent;
}

std::vector<SceneEdge> outline_of(const WallFrame& walls, const Colour& colour, float width, float opacity) {
  using Point = std::array<double, 3>;
  std::map<std::pair<Point, Point>, std::vector<std::size_t>> triangles_of;
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      Point a = walls.vertices[walls.triangles[t][k]], b = walls.vertices[walls.triangles[t][(k + 1) % 3]];
      if (b < a) std::swap(a, b);
      triangles_of[{a, b}].push_back(t);
    }
  }
  const double flat = std::cos(25.0 * std::numbers::pi / 180);
  std::vector<SceneEdge> edges;
  for (const auto& [ends, owners] : triangles_of) {
    bool drawn = owners.size() != 2;
    if (!drawn) {
      const Vec3 n0 = area_vector(walls, owners[0]).normalized(), n1 = area_vector(walls, owners[1]).normalized();
      drawn = walls.patch[owners[0]] != walls.patch[owners[1]] || n0.dot(n1) < flat;
    }
    if (drawn) edges.push_back({point_of(ends.first), point_of(ends.second), colour, width, opacity});
  }
  return edges;
}

std::vector<PatchMeasure> measures_of(const WallFrame& walls) {
  std::vector<PatchMeasure> out(walls.patches.size());
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    const double area = area_vector(walls, t).norm();
    out[walls.patch[t]].area += area;
    out[walls.patch[t]].middle += area / 3.0 * (corner(walls, t, 0) + corner(walls, t, 1) + corner(walls, t, 2));
  }
  for (auto& measure : out) {
    if (measure.area > 0) measure.middle /= measure.area;
  }
  return out;
}

double volume_of(const WallFrame& walls) {
  double sum = 0.0;
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) sum += corner(walls, t, 0).dot(area_vector(walls, t)) / 3.0;
  return std::abs(sum);
}

std::vector<std::array<Vec3, 2>> cut_of(const WallFrame& walls, int axis, double at) {
  std::vector<std::array<Vec3, 2>> segments;
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    std::vector<Vec3> points;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = corner(walls, t, k), b = corner(walls, t, (k + 1) % 3);
      const double da = a[axis] - at, db = b[axis] - at;
      if ((da < 0) != (db < 0)) points.push_back(a + da / (da - db) * (b - a));
    }
    if (points.size() == 2) segments.push_back({points[0], points[1]});
  }
  return segments;
}

}  // namespace puffin::output
