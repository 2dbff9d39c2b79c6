// Rays through a TriangleTree.

#include <algorithm>
#include <cmath>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

namespace {

// The ray seen so that it runs along +z from the origin: exact copies of equal vertices map to equal points, so the
// sign of an edge function is the same, negated, for both triangles of an edge, and rounding can only make it zero.
struct Shear {
  Vec3 from;
  int x, y, z;
  double sx, sy, sz;

  Shear(const Vec3& origin, const Vec3& direction) : from(origin) {
    direction.cwiseAbs().maxCoeff(&z);
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    sx = direction[x] / direction[z];
    sy = direction[y] / direction[z];
    sz = 1.0 / direction[z];
  }
  Vec3 operator()(const Vec3& p) const {
    const Vec3 r = p - from;
    return {r[x] - sx * r[z], r[y] - sy * r[z], sz * r[z]};
  }
};

// t of the crossing with a triangle given in sheared coordinates, NaN if there is none.
double crossing(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double u = c.x() * b.y() - c.y() * b.x();
  const double v = a.x() * c.y() - a.y() * c.x();
  const double w = b.x() * a.y() - b.y() * a.x();
  const double none = std::numeric_limits<double>::quiet_NaN();
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return none;
  const double sum = u + v + w;
  if (sum == 0.0) return none;  // seen edge-on: its neighbours are hit
  const double t = (u * a.z() + v * b.z() + w * c.z()) / sum;
  return std::clamp(t, std::min({a.z(), b.z(), c.z()}), std::max({a.z(), b.z(), c.z()}));
}

}  // namespace

std::optional<Hit> TriangleTree::first_hit(const Vec3& from, const Vec3& direction, double t_max) const {
  const double longest = direction.cwiseAbs().maxCoeff();
  if (!(longest > 0.0) || !(t_max >= 0.0)) return std::nullopt;

  // Cut the ray to the (widened) bounding box in double precision, so that single precision is enough in the nodes.
  const double widen = 2e-6 * (max_ - min_).maxCoeff() + 1e-30;
  double t_in = 0.0, t_out = t_max;
  for (int d = 0; d < 3; ++d) {
    const double low = min_[d] - widen - from[d], high = max_[d] + widen - from[d];
    if (direction[d] == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    const double t0 = low / direction[d], t1 = high / direction[d];
    t_in = std::max(t_in, std::min(t0, t1));
    t_out = std::min(t_out, std::max(t0, t1));
  }
  if (t_in > t_out) return std::nullopt;

  // Node coordinates: origin at the entry, length s = (t - t_in) * longest.
  const Vec3 entry = from + t_in * direction - centre_;
  std::array<float, 3> o, inverse;
  for (int d = 0; d < 3; ++d) {
    o[d] = static_cast<float>(entry[d]);
    const float f = static_cast<float>(direction[d] / longest);
    inverse[d] = 1.0f / (std::abs(f) < 1e-20f ? std::copysign(1e-20f, f) : f);
  }
  const Shear shear(from, direction);
  double best_t = t_max;
  Hit hit;

  struct Entry {
    std::int32_t child, count;
    float near;
  };
  std::array<Entry, 512> stack;
  int top = 0;
  stack[top++] = {0, 1, 0.0f};
  auto limit = [&] {
    return std::min(
        static_cast<float>((std::min(best_t, t_out) - t_in) * longest) * (1.0f + 1e-6f) + static_cast<float>(widen),
        std::numeric_limits<float>::max());
  };
  float far = limit();
  while (top > 0) {
    const Entry e = stack[--top];
    if (e.near > far) continue;
    if (e.child < 0) {
      const int begin = ~e.child * lanes;
      for (int i = begin; i < begin + e.count; ++i) {
        const auto& [a, b, c] = corners_[i];
        const double t = crossing(shear(a), shear(b), shear(c));
        if (t >= 0.0 && t <= best_t && (t < best_t || hit.triangle < 0 || order_[i] < hit.triangle)) {
          best_t = t;
          hit = {t, order_[i]};
        }
      }
      far = limit();
      continue;
    }
    const TreeNode& node = nodes_[e.child];
    std::array<float, lanes> near, leave;
    for (int c = 0; c < lanes; ++c) {
      float n = 0.0f, l = std::numeric_limits<float>::max();
      for (int d = 0; d < 3; ++d) {
        const float t0 = (node.low[d][c] - o[d]) * inverse[d], t1 = (node.high[d][c] - o[d]) * inverse[d];
        n = std::max(n, std::min(t0, t1));
        l = std::min(l, std::max(t0, t1));
      }
      near[c] = n * (1.0f - 1e-6f);
      leave[c] = l * (1.0f + 1e-6f);
    }
    const int first = top;
    for (int c = 0; c < lanes; ++c) {
      if (node.count[c] == 0 || near[c] > leave[c] || near[c] > far) continue;
      int at = top++;
      for (; at > first && stack[at - 1].near < near[c]; --at) stack[at] = stack[at - 1];
      stack[at] = {node.child[c], node.count[c], near[c]};
    }
  }
  if (hit.triangle < 0) return std::nullopt;
  return hit;
}

}  // namespace puffin::lbm::geometry
