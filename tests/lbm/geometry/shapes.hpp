#pragma once
// Surfaces with known volumes for the tests; all closed and pointing outwards.

#include <cmath>
#include <numbers>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"
#include "lbm/geometry/weld.hpp"

namespace puffin::lbm::geometry::shapes {

/// A box with n x n quadrilaterals a side, two triangles each; solids x-min, x-max, ... z-max. Outward.
inline TriangleMesh box(const Vec3& low, const Vec3& high, int n = 1) {
  TriangleMesh mesh;
  mesh.solids = {"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"};
  for (int side = 0; side < 6; ++side) {
    const int d = side / 2, u = (d + 1) % 3, v = (d + 2) % 3;
    const bool at_high = side % 2 == 1;
    const int first = static_cast<int>(mesh.vertices.size());
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        Vec3 p;
        p[d] = at_high ? high[d] : low[d];
        p[u] = low[u] + (high[u] - low[u]) * i / n;
        p[v] = low[v] + (high[v] - low[v]) * j / n;
        mesh.vertices.push_back(p);
      }
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int a = first + i + (n + 1) * j, b = a + 1, c = a + n + 2, e = a + n + 1;
        if (at_high) {
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, e});
        } else {
          mesh.triangles.push_back({a, c, b});
          mesh.triangles.push_back({a, e, c});
        }
        mesh.solid.insert(mesh.solid.end(), 2, side);
      }
    }
  }
  weld(mesh, 1e-9 * (high - low).norm());
  return mesh;
}

/// A torus around z with n x m facets, its corners on the torus. Radii: R of the ring, r of the tube.
inline TriangleMesh torus(double ring, double tube, int n, int m) {
  TriangleMesh mesh;
  mesh.solids = {"torus"};
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n;
    for (int j = 0; j < m; ++j) {
      const double b = 2.0 * std::numbers::pi * j / m, r = ring + tube * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
    }
  }
  auto at = [&](int i, int j) { return (i % n) * m + j % m; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  mesh.solid.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// A sphere of `rings` latitudes and twice as many longitudes, its corners on the sphere.
inline TriangleMesh sphere(double radius, int rings, const Vec3& centre = Vec3::Zero()) {
  TriangleMesh mesh;
  mesh.solids = {"sphere"};
  const int m = 2 * rings;
  mesh.vertices.push_back(centre + Vec3(0, 0, radius));
  for (int i = 1; i < rings; ++i) {
    const double a = std::numbers::pi * i / rings;
    for (int j = 0; j < m; ++j) {
      const double b = 2.0 * std::numbers::pi * j / m;
      mesh.vertices.push_back(centre +
                              radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  mesh.vertices.push_back(centre - Vec3(0, 0, radius));
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  auto at = [&](int i, int j) { return i == 0 ? 0 : (i == rings ? last : 1 + (i - 1) * m + j % m); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < m; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i < rings - 1) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  }
  mesh.solid.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// A duct along x with a forward step: the section [0,w] x [0,h1] until x = l1, then [0,w] x [0,h2], h2 < h1, until l2:
/// the lip at (l1, *, h2) is a convex edge seen from the air, the foot ... a concave one.
inline TriangleMesh step_duct(double l1, double l2, double w, double h1, double h2) {
  TriangleMesh mesh;
  mesh.solids = {"inlet", "outlet", "wall"};
  // Section in (x, z), counter-clockwise seen from -y; extruded along y.
  const std::vector<std::array<double, 2>> outline{{0, 0}, {l2, 0}, {l2, h2}, {l1, h2}, {l1, h1}, {0, h1}};
  const int n = static_cast<int>(outline.size());
  for (const double y : {0.0, w}) {
    for (const auto& p : outline) mesh.vertices.emplace_back(p[0], y, p[1]);
  }
  auto add = [&](int a, int b, int c, int solid) {
    mesh.triangles.push_back({a, b, c});
    mesh.solid.push_back(solid);
  };
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n, solid = k == 5 ? 0 : (k == 1 ? 1 : 2);
    add(k, next + n, next, solid);
    add(k, k + n, next + n, solid);
  }
  for (const auto& t : std::vector<std::array<int, 3>>{{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    add(t[0], t[1], t[2], 2);              // y = 0, normal -y
    add(t[0] + n, t[2] + n, t[1] + n, 2);  // y = w
  }
  return mesh;
}

inline TriangleMesh transformed(TriangleMesh mesh, const Eigen::Matrix3d& m, const Vec3& shift = Vec3::Zero()) {
  for (auto& v : mesh.vertices) v = m * v + shift;
  if (m.determinant() < 0.0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const int shift = static_cast<int>(a.vertices.size()), solids = static_cast<int>(a.solids.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  a.solids.insert(a.solids.end(), b.solids.begin(), b.solids.end());
  for (std::size_t t = 0; t < b.triangles.size(); ++t) {
    a.triangles.push_back({b.triangles[t][0] + shift, b.triangles[t][1] + shift, b.triangles[t][2] + shift});
    a.solid.push_back(b.solid[t] + solids);
  }
  return a;
}

inline TriangleMesh turned(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline void remove_triangle(TriangleMesh& mesh, int t) {
  mesh.triangles.erase(mesh.triangles.begin() + t);
  mesh.solid.erase(mesh.solid.begin() + t);
}

/// Angles that line up with nothing.
inline Eigen::Matrix3d rotation() {
  return (Eigen::AngleAxisd(0.7, Vec3::UnitZ()) * Eigen::AngleAxisd(0.4, Vec3::UnitY()) *
          Eigen::AngleAxisd(1.1, Vec3::UnitX()))
      .toRotationMatrix();
}

}  // namespace puffin::lbm::geometry::shapes
