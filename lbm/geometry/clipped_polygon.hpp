#pragma once
// A triangle cut down to a box, one plane at a time.

#include <algorithm>
#include <array>
#include <utility>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// A convex flat polygon; each of the six planes of a box adds at most one corner to the triangle's three.
struct ClippedPolygon {
  static constexpr int most = 12;  // nine, and room for rounding
  std::array<Vec3, most> corner;
  int corners = 0;

  ClippedPolygon() = default;
  ClippedPolygon(const Vec3& a, const Vec3& b, const Vec3& c) : corners(3) {
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
  }
  ClippedPolygon(const ClippedPolygon& other) : corners(other.corners) {
    std::copy_n(other.corner.begin(), corners, corner.begin());
  }
  ClippedPolygon& operator=(const ClippedPolygon&) = delete;

  bool empty() const { return corners < 3; }

  /// The part with axis coordinate >= level (above) or <= level.
  ClippedPolygon cut(int axis, double level, bool above) const {
    ClippedPolygon part(*this);
    part.keep([&](const Vec3& p) { return above ? p[axis] - level : level - p[axis]; },
              [&](Vec3& on) { on[axis] = level; });
    return part;
  }

  /// Keeps the part where `height`, linear in the point, is not negative; `settle` may mend the rounding of new
  /// corners.
  template <class Height, class Settle>
  void keep(Height&& height, Settle&& settle) {
    const ClippedPolygon whole(*this);
    corners = 0;
    for (int k = 0; k < whole.corners && corners + 2 <= most; ++k) {
      const Vec3 &p = whole.corner[k], &q = whole.corner[(k + 1) % whole.corners];
      const double hp = height(p), hq = height(q);
      if (hp >= 0.0) corner[corners++] = p;
      if ((hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0)) {
        corner[corners] = p + hp / (hp - hq) * (q - p);
        settle(corner[corners++]);
      }
    }
  }
  template <class Height>
  void keep(Height&& height) {
    keep(height, [](Vec3&) {});
  }

  /// The part with low <= axis coordinate <= high.
  ClippedPolygon slab(int axis, double low, double high) const { return cut(axis, low, true).cut(axis, high, false); }

  /// Lowest and highest coordinate along an axis.
  std::pair<double, double> range(int axis) const {
    std::pair<double, double> r{corner[0][axis], corner[0][axis]};
    for (int k = 1; k < corners; ++k) {
      r.first = std::min(r.first, corner[k][axis]);
      r.second = std::max(r.second, corner[k][axis]);
    }
    return r;
  }

  /// The shadow along an axis: its signed area (positive if the normal points along +axis), and the integral of the
  /// axis coordinate over it.
  std::pair<double, double> shadow(int axis) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double area = 0.0, moment = 0.0;
    for (int k = 1; k + 1 < corners; ++k) {
      const Vec3 &a = corner[0], &b = corner[k], &c = corner[k + 1];
      const double part = 0.5 * ((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
      area += part;
      moment += part * (a[axis] + b[axis] + c[axis]) / 3.0;
    }
    return {area, moment};
  }
};

}  // namespace puffin::lbm::geometry
