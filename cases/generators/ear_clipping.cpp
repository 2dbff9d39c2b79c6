#include "cases/generators/ear_clipping.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace puffin::cases::generators {
namespace {

using Vec2 = Eigen::Vector2d;
using Ring = std::vector<int>;

/// Twice the signed area of a, b, c.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Areas below this are rounding: a square 1e-6 of the size of the face.
double smallest_area(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = points.front();
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return 1e-12 * (high - low).squaredNorm();
}

/// Whether p, a corner of the face, lies on the segment a-b between its ends.
bool on_segment(const Vec2& p, const Vec2& a, const Vec2& b, double eps) {
  const double along = (p - a).dot(b - a);
  return std::abs(turn(a, b, p)) <= eps && along > eps && along < (b - a).squaredNorm() - eps;
}

bool crosses(const std::vector<Vec2>& points, int a, int b, int c, int d, double eps) {
  const Vec2 &pa = points[a], &pb = points[b], &pc = points[c], &pd = points[d];
  const double c_side = turn(pa, pb, pc), d_side = turn(pa, pb, pd);
  const double a_side = turn(pc, pd, pa), b_side = turn(pc, pd, pb);
  const bool proper = ((c_side > eps && d_side < -eps) || (c_side < -eps && d_side > eps)) &&
                      ((a_side > eps && b_side < -eps) || (a_side < -eps && b_side > eps));
  return proper || on_segment(pc, pa, pb, eps) || on_segment(pd, pa, pb, eps);
}

bool visible(const std::vector<Vec2>& points, const std::vector<Ring>& obstacles, int a, int b, double eps) {
  for (const Ring& ring : obstacles)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int c = ring[k], d = ring[(k + 1) % ring.size()];
      if (c != a && c != b && d != a && d != b && crosses(points, a, b, c, d, eps)) return false;
    }
  return true;
}

/// Joins ring `hole` to ring `outer` by a bridge between the nearest corners that see each other.
void bridge(const std::vector<Vec2>& points, std::vector<Ring>& rings, double eps) {
  struct Candidate {
    double distance;
    std::size_t hole, at_outer, at_hole;
  };
  std::vector<Candidate> candidates;
  for (std::size_t h = 1; h < rings.size(); ++h)
    for (std::size_t o = 0; o < rings[0].size(); ++o)
      for (std::size_t k = 0; k < rings[h].size(); ++k)
        candidates.push_back({(points[rings[0][o]] - points[rings[h][k]]).squaredNorm(), h, o, k});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  for (const Candidate& c : candidates) {
    if (!visible(points, rings, rings[0][c.at_outer], rings[c.hole][c.at_hole], eps)) continue;
    Ring hole = rings[c.hole];
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(c.at_hole), hole.end());
    hole.push_back(hole.front());
    hole.push_back(rings[0][c.at_outer]);
    rings[0].insert(rings[0].begin() + static_cast<std::ptrdiff_t>(c.at_outer) + 1, hole.begin(), hole.end());
    rings.erase(rings.begin() + static_cast<std::ptrdiff_t>(c.hole));
    return;
  }
  throw std::logic_error("a hole of a face cannot be joined to its outline");
}

/// Whether corner k can be cut off: strictly convex, and no other corner in the closed triangle.
bool is_ear(const std::vector<Vec2>& points, const Ring& ring, std::size_t k, double eps) {
  const std::size_t n = ring.size();
  const int a = ring[(k + n - 1) % n], b = ring[k], c = ring[(k + 1) % n];
  if (turn(points[a], points[b], points[c]) <= eps) return false;
  for (const int p : ring) {
    if (p == a || p == b || p == c) continue;
    if (turn(points[a], points[b], points[p]) >= -eps && turn(points[b], points[c], points[p]) >= -eps &&
        turn(points[c], points[a], points[p]) >= -eps)
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate(const std::vector<Vec2>& points, const std::vector<Ring>& loops) {
  std::vector<std::array<int, 3>> triangles;
  if (loops.size() == 1 && loops[0].size() == 3) return {{loops[0][0], loops[0][1], loops[0][2]}};
  const double eps = smallest_area(points);
  std::vector<Ring> rings = loops;
  while (rings.size() > 1) bridge(points, rings, eps);
  Ring ring = rings.front();
  std::size_t k = 0, failures = 0;
  while (ring.size() > 3) {
    k %= ring.size();
    if (is_ear(points, ring, k, eps)) {
      const std::size_t n = ring.size();
      triangles.push_back({ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
      failures = 0;
    } else if (++failures > ring.size()) {
      throw std::logic_error("a face cannot be triangulated: its outline crosses itself");
    }
    ++k;  // the next ear two corners on: no fan of slivers
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace puffin::cases::generators
