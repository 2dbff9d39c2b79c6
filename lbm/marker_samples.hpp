#pragma once
// Where the markers of an immersed boundary stand on the surface, and how much of it each one holds.

#include <array>
#include <functional>
#include <vector>

#include "lbm/links.hpp"

namespace puffin::lbm {

struct SurfaceMarker {
  geometry::Vec3 surface = geometry::Vec3::Zero(), normal = geometry::Vec3::Zero();
  double area = 0.0;
  int triangle = -1;
};

using VisitSample = std::function<void(const geometry::Vec3& place, double area)>;

/// Visits points of a triangle that are at most about `apart` from their neighbours, with the part of `area` (that of
/// the triangle) that each stands for: m^2 equal parts, m = longest side / apart. A triangle longer than four times its
/// height has slices across its longest side, each divided for itself: so the number goes with the area, and with the
/// length of what is narrower than `apart`.
void sample_triangle(const std::array<geometry::Vec3, 3>& corners, double area, double apart, const VisitSample& visit);

/// Samples every wall triangle finely, then keeps samples no nearer to each other than 0.9 `spacing` and gives each
/// kept one the area of those that are nearest to it. Faces that meet at an edge have markers of their own. The order
/// of the triangles decides, so the result is always the same. Only what is kept is stored.
std::vector<SurfaceMarker> spread_markers(const LinkGeometry& surface, double spacing);

}  // namespace puffin::lbm
