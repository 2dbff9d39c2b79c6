#pragma once
// Nearest point of one triangle.

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Where on a triangle a point lies: 0-2 corner, 3-5 edge from corner k-3 to the next, 6 inside the face.
enum class Region { corner_a, corner_b, corner_c, edge_ab, edge_bc, edge_ca, face };

struct NearestOnTriangle {
  Vec3 point;
  Region region;
};

/// Nearest point to p of the triangle (a, b, c) and its Voronoi region. Source: C. Ericson, Real-Time Collision
/// Detection (2005), section 5.1.5. Degenerate triangles (a segment, a point) are allowed.
inline NearestOnTriangle nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, Region::corner_a};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, Region::corner_b};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 - d3 > 0.0) return {a + d1 / (d1 - d3) * ab, Region::edge_ab};
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, Region::corner_c};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 - d6 > 0.0) return {a + d2 / (d2 - d6) * ac, Region::edge_ca};
  const double va = d3 * d6 - d5 * d4;
  const double e1 = d4 - d3, e2 = d5 - d6;
  if (va <= 0.0 && e1 >= 0.0 && e2 >= 0.0 && e1 + e2 > 0.0) return {b + e1 / (e1 + e2) * (c - b), Region::edge_bc};
  const double sum = va + vb + vc;
  if (!(sum > 0.0)) return {a, Region::corner_a};  // a triangle collapsed by rounding
  return {a + (vb / sum) * ab + (vc / sum) * ac, Region::face};
}

}  // namespace puffin::lbm::geometry
