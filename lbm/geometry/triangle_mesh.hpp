#pragma once
// A triangle surface: shared vertices, triangles that index them, and the named solid each triangle came from.
// Lengths carry no unit here: they are whatever the caller uses (Puffin uses metres).

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

namespace puffin::lbm::geometry {

using Vec3 = Eigen::Vector3d;

struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;  // vertex indices, counter-clockwise seen from outside the fluid
  std::vector<int> solid;                     // per triangle: index into solids
  std::vector<std::string> solids;            // names of the solids of the file, in order

  const Vec3& corner(int triangle, int k) const { return vertices[triangles[triangle][k]]; }
  /// Twice the area times the unit normal, pointing out of the enclosed volume.
  Vec3 area_vector(int triangle) const {
    const Vec3& a = corner(triangle, 0);
    return (corner(triangle, 1) - a).cross(corner(triangle, 2) - a);
  }
  double area(int triangle) const { return 0.5 * area_vector(triangle).norm(); }
};

}  // namespace puffin::lbm::geometry
