#include "lbm/geometry/union_fraction.hpp"

#include <algorithm>
#include <cmath>

namespace puffin::lbm::geometry {

namespace {

constexpr int lines = 4096;
constexpr double plastic = 1.3247179572447460;  // x^3 = x + 1

struct WallCrossing {
  double at = 0.0;  // share of the segment
  int step = 0;     // of the winding number
};

// The triangles that reach into the cube, and what segments within it cross.
class Local {
 public:
  Local(const TriangleTree& tree, const Vec3& low, const Vec3& high) {
    std::vector<int> near;
    tree.overlapping(low, high, near);
    for (const int t : near)
      triangles_.push_back({tree.mesh().corner(t, 0), tree.mesh().corner(t, 1), tree.mesh().corner(t, 2)});
  }

  // Moeller & Trumbore, J. Graph. Tools 2(1), 21 (1997).
  void cross(const Vec3& from, const Vec3& along, std::vector<WallCrossing>& out) const {
    out.clear();
    for (const auto& [a, b, c] : triangles_) {
      const Vec3 u = b - a, v = c - a, s = from - a, pv = along.cross(v), q = s.cross(u);
      const double determinant = u.dot(pv);  // > 0: against the outward normal, an entry
      if (determinant == 0.0) continue;
      const double x = s.dot(pv) / determinant, y = along.dot(q) / determinant, t = v.dot(q) / determinant;
      if (x < 0.0 || y < 0.0 || x + y > 1.0 || t < 0.0 || t > 1.0) continue;
      out.push_back({t, determinant > 0.0 ? 1 : -1});
    }
  }

 private:
  std::vector<std::array<Vec3, 3>> triangles_;
};

int turns(const TriangleTree& tree, const Vec3& p) { return static_cast<int>(std::lround(tree.winding_number(p))); }

}  // namespace

double union_fraction(const TriangleTree& tree, const Vec3& centre, double dx, double mean_winding) {
  const int middle = turns(tree, centre);
  int least = middle, most = middle;
  for (int corner = 0; corner < 8; ++corner) {
    // A little inside the cube, so that a face of the surface in a face of the cube is no question.
    const Vec3 p = centre + 0.4999 * dx * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    least = std::min(least, turns(tree, p));
    most = std::max(most, turns(tree, p));
  }
  if (least >= 0 && most <= 1) return mean_winding;
  if (least >= 1 || most <= -1) return 1.0;

  const Vec3 low = centre - Vec3::Constant(0.5 * dx);
  const Local local(tree, low, low + Vec3::Constant(dx));
  std::vector<WallCrossing> crossings;
  double inside = 0.0;
  for (int n = 0; n < lines; ++n) {
    const double y = std::fmod(0.5 + (n + 1) / plastic, 1.0), z = std::fmod(0.5 + (n + 1) / (plastic * plastic), 1.0);
    const Vec3 from = low + dx * Vec3(0.0, y, z);
    int winding = middle;
    local.cross(centre, from - centre, crossings);
    for (const WallCrossing& c : crossings) winding += c.step;
    local.cross(from, Vec3(dx, 0.0, 0.0), crossings);
    std::sort(crossings.begin(), crossings.end(),
              [](const WallCrossing& a, const WallCrossing& b) { return a.at < b.at; });
    double last = 0.0;
    for (const WallCrossing& c : crossings) {
      if (winding != 0) inside += c.at - last;
      last = c.at;
      winding += c.step;
    }
    if (winding != 0) inside += 1.0 - last;
  }
  return inside / lines;
}

}  // namespace puffin::lbm::geometry
