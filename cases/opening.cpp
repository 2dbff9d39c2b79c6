#include "cases/opening.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace puffin::cases {

namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vec2> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t floor = hull.size() + 1;
    for (const Vec2& p : points) {
      while (hull.size() > floor && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

struct Rectangle {
  Vec2 low, high;  // extent along `axis` and across
  Vec2 axis;
};

/// The smallest rectangle has a side on an edge of the hull.
Rectangle smallest_rectangle(const std::vector<Vec2>& hull) {
  Rectangle best{{0, 0}, {0, 0}, {1, 0}};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2 edge = hull[(k + 1) % hull.size()] - hull[k];
    if (!(edge.norm() > 0.0)) continue;
    const Vec2 axis = edge.normalized(), across(-axis.y(), axis.x());
    Vec2 low(1e300, 1e300), high(-1e300, -1e300);
    for (const Vec2& p : hull) {
      const Vec2 at(p.dot(axis), p.dot(across));
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    const double area = (high - low).prod();
    if (area < least * (1.0 - 1e-9)) {
      least = area;
      best = {low, high, axis};
    }
  }
  return best;
}

/// Longer side first; of equal ones the second is the one nearer to z, then to y.
bool in_order(const Vec3& first, double half_first, const Vec3& second, double half_second) {
  if (std::abs(half_first - half_second) > 1e-6 * (half_first + half_second)) return half_first > half_second;
  for (const int d : {2, 1})
    if (std::abs(std::abs(first[d]) - std::abs(second[d])) > 1e-6) return std::abs(first[d]) < std::abs(second[d]);
  return true;
}

void fit_rectangle(const Surface& surface, Opening& o) {
  int axis = 0;
  o.normal.cwiseAbs().minCoeff(&axis);
  const Vec3 e1 = o.normal.cross(Vec3::Unit(axis)).normalized(), e2 = o.normal.cross(e1);
  std::vector<Vec2> points;
  for (const int t : o.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = surface.mesh.corner(t, k) - o.centroid;
      points.emplace_back(p.dot(e1), p.dot(e2));
      o.radius = std::max(o.radius, points.back().norm());
    }
  const Rectangle r = smallest_rectangle(hull_of(std::move(points)));
  const Vec2 middle = 0.5 * (r.low + r.high), half = 0.5 * (r.high - r.low);
  o.along = {r.axis.x() * e1 + r.axis.y() * e2, -r.axis.y() * e1 + r.axis.x() * e2};
  o.half = {half.x(), half.y()};
  o.centre = o.centroid + middle.x() * o.along[0] + middle.y() * o.along[1];
  if (!in_order(o.along[0], o.half[0], o.along[1], o.half[1])) {
    std::swap(o.along[0], o.along[1]);
    std::swap(o.half[0], o.half[1]);
  }
}

bool sticks(const Case& c, const std::string& patch) {
  if (is_periodic(c.air, patch)) return false;
  const Boundary* b = boundary_of(c.air, patch);
  return b == nullptr || b->type == BoundaryType::wall || b->type == BoundaryType::moving_wall;
}

void find_walls(const Case& c, const Surface& surface, Opening& o) {
  const auto& mesh = surface.mesh;
  std::set<std::pair<int, int>> border;  // directed edges of the opening
  for (const int t : o.triangles)
    for (int k = 0; k < 3; ++k) border.insert({mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]});
  const auto each_edge = [&](auto&& body) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        body(surface.patches.of_triangle[t], mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
  };
  const int patch = surface.patches.of_triangle[o.triangles.front()];
  double length[2][2][2] = {};  // [side pair][end][sticks]
  each_edge([&](int p, int a, int b) {
    if (p == patch || border.count({b, a}) == 0) return;
    const auto at = o.coordinates(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    // The side this piece of the border is nearest to.
    int pair = 0, end = 0;
    double nearest = 1e300;
    for (int d = 0; d < 2; ++d)
      for (int e = 0; e < 2; ++e) {
        const double gap = std::abs(at[d] - (e == 0 ? -o.half[d] : o.half[d]));
        if (gap < nearest) nearest = gap, pair = d, end = e;
      }
    length[pair][end][sticks(c, surface.patches.names[p]) ? 1 : 0] += (mesh.vertices[a] - mesh.vertices[b]).norm();
  });
  for (int d = 0; d < 2; ++d)
    for (int e = 0; e < 2; ++e) o.wall[d][e] = length[d][e][1] > length[d][e][0];
}

using Triangle = std::array<Vec3, 3>;

/// Degree 5, seven points (Radon 1948).
double integrate(const Triangle& t, const std::function<double(const Vec3&)>& f) {
  const double root = std::sqrt(15.0);
  const double a[2] = {(6.0 - root) / 21.0, (6.0 + root) / 21.0};
  const double w[2] = {(155.0 - root) / 1200.0, (155.0 + root) / 1200.0};
  double sum = 9.0 / 40.0 * f((t[0] + t[1] + t[2]) / 3.0);
  for (int n = 0; n < 2; ++n)
    for (int k = 0; k < 3; ++k) sum += w[n] * f((1.0 - 2.0 * a[n]) * t[k] + a[n] * (t[(k + 1) % 3] + t[(k + 2) % 3]));
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm() * sum;
}

double integrate_finely(const Triangle& t, double finest, int depth, const std::function<double(const Vec3&)>& f) {
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if ((t[(k + 1) % 3] - t[k]).norm() > (t[(longest + 1) % 3] - t[longest]).norm()) longest = k;
  const Vec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3], middle = 0.5 * (a + b);
  if (depth == 0 || (b - a).norm() <= finest) return integrate(t, f);
  return integrate_finely({a, middle, c}, finest, depth - 1, f) +
         integrate_finely({middle, b, c}, finest, depth - 1, f);
}

}  // namespace

const Boundary* boundary_of(const Air& air, const std::string& patch) {
  for (const Boundary& b : air.boundaries)
    if (b.patch == patch) return &b;
  return nullptr;
}

bool is_resting_wall(const Air& air, const std::string& patch) {
  const Boundary* b = boundary_of(air, patch);
  return !is_periodic(air, patch) && (b == nullptr || b->type == BoundaryType::wall);
}

bool is_periodic(const Air& air, const std::string& patch) {
  return std::any_of(air.boundaries.begin(), air.boundaries.end(), [&](const Boundary& b) {
    return b.type == BoundaryType::periodic && (b.patch == patch || b.with == patch);
  });
}

std::string no_direction(const std::string& name) {
  return name +
         " has no direction: its triangles, which hang together, look against each other; give each face a patch of "
         "its "
         "own ([[geometry.patch]] select = \"near:[x, y, z]\")";
}

Opening opening_of(const Case& c, const Surface& surface, const lbm::geometry::PatchPart& part,
                   const std::string& name) {
  if (!(part.surface > 0.0)) throw lbm::geometry::GeometryError(name + " has no area");
  if (part.normal.isZero()) throw lbm::geometry::GeometryError(no_direction(name));
  Opening o;
  o.name = name;
  o.triangles = part.triangles;
  o.normal = part.normal;
  o.centroid = part.centroid;
  o.area = part.area;
  fit_rectangle(surface, o);
  find_walls(c, surface, o);
  return o;
}

Opening opening_of(const Case& c, const Surface& surface, int patch) {
  std::vector<int> triangles;
  for (int t = 0; t < static_cast<int>(surface.mesh.triangles.size()); ++t)
    if (surface.patches.of_triangle[t] == patch) triangles.push_back(t);
  return opening_of(c, surface, lbm::geometry::part_of(surface.mesh, std::move(triangles)),
                    "the patch '" + surface.patches.names[patch] + "'");
}

double integral_over(const Surface& surface, const Opening& opening, double finest,
                     const std::function<double(const Vec3&)>& f) {
  constexpr int most_halvings = 14;
  double sum = 0.0;
  for (const int t : opening.triangles)
    sum += integrate_finely({surface.mesh.corner(t, 0), surface.mesh.corner(t, 1), surface.mesh.corner(t, 2)}, finest,
                            most_halvings, f);
  return sum;
}

}  // namespace puffin::cases
