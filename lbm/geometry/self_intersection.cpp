#include "lbm/geometry/self_intersection.hpp"

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "lbm/geometry/adjacency.hpp"
#include "lbm/geometry/clipped_polygon.hpp"

namespace puffin::lbm::geometry {

namespace {

// Six times the volume of the tetrahedron (a, b, c, d), or 0 if it is within rounding of that.
double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double volume = w.dot(u.cross(v));
  // Corners of STL files carry single precision: anything flatter than that is touching, not crossing.
  const double rounding = 4e-7 * std::max({u.norm(), v.norm(), w.norm()}) * u.cross(v).norm();
  return std::abs(volume) <= rounding ? 0.0 : volume;
}

bool opposite(double a, double b) { return (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0); }

// Where the segment (p, q) passes through a triangle: its interior, or one of its edges.
struct Piercing {
  Vec3 where = Vec3::Zero();
  int edge = -1;  // from corner `edge` to the next; -1: the interior
};

std::optional<Piercing> pierce(const TriangleMesh& m, int t, const Vec3& p, const Vec3& q) {
  const Vec3 &a = m.corner(t, 0), &b = m.corner(t, 1), &c = m.corner(t, 2);
  const double sp = volume6(a, b, c, p), sq = volume6(a, b, c, q);
  if (!opposite(sp, sq)) return std::nullopt;
  const std::array<double, 3> side{volume6(p, q, a, b), volume6(p, q, b, c), volume6(p, q, c, a)};
  int edge = -1, on_edges = 0;
  for (int k = 0; k < 3; ++k) {
    if (opposite(side[k], side[(k + 1) % 3])) return std::nullopt;
    if (side[k] == 0.0) edge = k, ++on_edges;
  }
  if (on_edges > 1) return std::nullopt;
  return Piercing{p + sp / (sp - sq) * (q - p), edge};
}

// A pair of which an edge of one passes through an edge of the other: it may pass through the surface there, as through
// the diagonal of a square, or only touch it. Its neighbour across that edge decides.
struct ThroughEdge {
  Intersection pair;
  int p = -1, q = -1;            // the ends of the edge that passes
  int triangle = -1, edge = -1;  // what it passes through
};

std::optional<Vec3> cross(const TriangleMesh& m, int s, int t, std::vector<ThroughEdge>& doubtful) {
  for (const auto& [edges_of, through] : {std::pair(s, t), std::pair(t, s)}) {
    const auto& corners = m.triangles[through];
    for (int k = 0; k < 3; ++k) {
      const int p = m.triangles[edges_of][k], q = m.triangles[edges_of][(k + 1) % 3];
      if (std::find(corners.begin(), corners.end(), p) != corners.end()) continue;
      if (std::find(corners.begin(), corners.end(), q) != corners.end()) continue;
      const auto found = pierce(m, through, m.vertices[p], m.vertices[q]);
      if (found && found->edge < 0) return found->where;
      if (found) doubtful.push_back({{s, t, found->where}, p, q, through, found->edge});
    }
  }
  return std::nullopt;
}

// True if the ends of what passes lie on the same sides of both triangles at the edge: at a ridge that is only touched
// each end is before one of them and behind the other.
bool passes(const TriangleMesh& m, const Adjacency& adjacency, const ThroughEdge& d) {
  const std::int32_t e = adjacency.edge(d.triangle, d.edge);
  if (e < 0) return false;
  const auto side = [&](int t, int v) {
    return volume6(m.corner(t, 0), m.corner(t, 1), m.corner(t, 2), m.vertices[v]);
  };
  const auto uses = adjacency.uses(static_cast<std::size_t>(e));
  const auto own = std::find_if(uses.begin(), uses.end(), [&](const auto& u) { return u.triangle == d.triangle; });
  return std::any_of(uses.begin(), uses.end(), [&](const auto& u) {
    if (u.triangle == d.triangle) return false;
    const double turn = u.forward == own->forward ? -1.0 : 1.0;  // the two face different sides of the surface
    return opposite(side(d.triangle, d.p), turn * side(u.triangle, d.q)) &&
           opposite(side(d.triangle, d.q), turn * side(u.triangle, d.p));
  });
}

// A point of the common part of two triangles in one plane that face the same way.
std::optional<Vec3> overlap(const TriangleMesh& m, int s, int t) {
  const Vec3 n = m.area_vector(s), o = m.area_vector(t);
  const double smaller = std::min(n.norm(), o.norm());
  if (!(n.dot(o) > 0.99 * n.norm() * o.norm()) || !(smaller > 0.0)) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    if (volume6(m.corner(s, 0), m.corner(s, 1), m.corner(s, 2), m.corner(t, k)) != 0.0) return std::nullopt;
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double turn = n[axis] > 0.0 ? 1.0 : -1.0;
  ClippedPolygon common(m.corner(t, 0), m.corner(t, 1), m.corner(t, 2));
  for (int k = 0; k < 3 && !common.empty(); ++k) {
    const Vec3 &a = m.corner(s, k), &b = m.corner(s, (k + 1) % 3);
    // In coordinates with the edge along one of them, the inner side is where the other is positive.
    common.keep([&](const Vec3& p) { return turn * ((b[u] - a[u]) * (p[v] - a[v]) - (b[v] - a[v]) * (p[u] - a[u])); });
  }
  if (common.empty() || std::abs(common.shadow(axis).first) * n.norm() < 0.5e-6 * smaller * std::abs(n[axis]))
    return std::nullopt;
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < common.corners; ++k) middle += common.corner[k] / common.corners;
  return middle;
}

}  // namespace

std::vector<Intersection> find_self_intersections(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  return find_self_intersections(TriangleTree(std::shared_ptr<const TriangleMesh>(std::shared_ptr<void>(), &mesh)));
}

std::vector<Intersection> find_self_intersections(const TriangleTree& tree) {
  const TriangleMesh& mesh = tree.mesh();
  tbb::combinable<std::vector<Intersection>> found;
  tbb::combinable<std::vector<ThroughEdge>> at_edges;
  const int n = static_cast<int>(mesh.triangles.size());
  tbb::parallel_for(tbb::blocked_range<int>(0, n, 1024), [&](const tbb::blocked_range<int>& r) {
    auto& mine = found.local();
    auto& doubtful = at_edges.local();
    std::vector<int> candidates;
    for (int s = r.begin(); s < r.end(); ++s) {
      const Vec3 &a = mesh.corner(s, 0), &b = mesh.corner(s, 1), &c = mesh.corner(s, 2);
      candidates.clear();
      tree.overlapping(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), candidates);
      for (const int t : candidates) {
        if (t <= s) continue;
        int shared = 0;
        for (const int v : mesh.triangles[s]) {
          shared += std::count(mesh.triangles[t].begin(), mesh.triangles[t].end(), v) > 0;
        }
        if (shared > 2) continue;
        auto where = shared < 2 ? cross(mesh, s, t, doubtful) : std::nullopt;
        if (!where) where = overlap(mesh, s, t);
        if (where) mine.push_back({s, t, *where});
      }
    }
  });
  std::vector<Intersection> all;
  found.combine_each([&](const std::vector<Intersection>& part) { all.insert(all.end(), part.begin(), part.end()); });
  std::optional<Adjacency> adjacency;
  at_edges.combine_each([&](const std::vector<ThroughEdge>& part) {
    for (const ThroughEdge& d : part) {
      if (!adjacency) adjacency.emplace(mesh);
      if (passes(mesh, *adjacency, d)) all.push_back(d.pair);
    }
  });
  const auto order = [](const Intersection& i) { return std::tuple(i.a, i.b, i.where.x(), i.where.y(), i.where.z()); };
  std::sort(all.begin(), all.end(), [&](const auto& x, const auto& y) { return order(x) < order(y); });
  const auto same_pair = [](const Intersection& x, const Intersection& y) { return x.a == y.a && x.b == y.b; };
  all.erase(std::unique(all.begin(), all.end(), same_pair), all.end());
  return all;
}

}  // namespace puffin::lbm::geometry
