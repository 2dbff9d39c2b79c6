// Winding numbers from a TriangleTree.

#include <cmath>
#include <numbers>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

namespace {

// A cluster of triangles seen from farther than this many of its radii is taken by its expansion.
constexpr double far_radii = 3.0;

// Adds the symmetric part of a b^T.
void add_outer(const Vec3& a, const Vec3& b, std::array<double, 6>& m) {
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3;
    m[d] += a[d] * b[d];
    m[3 + d] += 0.5 * (a[d] * b[e] + a[e] * b[d]);
  }
}

// r^T M r
double quadratic(const std::array<double, 6>& m, const Vec3& r) {
  return m[0] * r.x() * r.x() + m[1] * r.y() * r.y() + m[2] * r.z() * r.z() +
         2.0 * (m[3] * r.x() * r.y() + m[4] * r.y() * r.z() + m[5] * r.z() * r.x());
}

// A sum of signed solid angles of triangles seen from the origin, each positive if its normal points away from it:
// Omega = 2 arg(z), with z of van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30, 125 (1983). Angles add as their z
// multiply, so one arc tangent does for all; each time the sum of two angles of equal sign passes pi or -pi the
// product's imaginary part turns its sign.
class SolidAngles {
 public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double y = a.dot(b.cross(c));
    const double x = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    const double re = re_ * x - im_ * y, im = re_ * y + im_ * x;
    if (im_ >= 0.0 && y >= 0.0 && im < 0.0) ++turns_;
    if (im_ < 0.0 && y < 0.0 && im >= 0.0) --turns_;
    const double size = std::abs(re) + std::abs(im);
    if (!(size > 0.0)) return;  // seen from a corner: no angle
    re_ = re / size;
    im_ = im / size;
  }
  double sum() const { return 2.0 * std::atan2(im_, re_) + 4.0 * std::numbers::pi * turns_; }

 private:
  double re_ = 1.0, im_ = 0.0;
  int turns_ = 0;
};

}  // namespace

void TriangleTree::set_dipoles() {
  dipoles_.resize(nodes_.size());
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parent
    const TreeNode& node = nodes_[n];
    for (int c = 0; c < lanes; ++c) {
      if (node.count[c] == 0) continue;
      Dipole& dipole = dipoles_[n][c];
      Vec3 weighted = Vec3::Zero();
      auto for_parts = [&](auto&& visit) {  // visit(area vector, centre, area, moment)
        if (node.child[c] < 0) {
          for (int i = ~node.child[c] * lanes; i < ~node.child[c] * lanes + node.count[c]; ++i) {
            const auto& [p, q, r] = corners_[i];
            const Vec3 area = 0.5 * (q - p).cross(r - p);
            visit(area, Vec3((p + q + r) / 3.0), area.norm(), std::array<double, 6>{});
          }
          return;
        }
        for (int k = 0; k < lanes; ++k) {
          const Dipole& part = dipoles_[node.child[c]][k];
          if (nodes_[node.child[c]].count[k] > 0) visit(part.area, part.centre, part.weight, part.moment);
        }
      };
      for_parts([&](const Vec3& area, const Vec3& centre, double weight, const std::array<double, 6>&) {
        dipole.area += area;
        weighted += weight * centre;
        dipole.weight += weight;
      });
      Vec3 low, high;
      for (int d = 0; d < 3; ++d) {
        low[d] = node.low[d][c] + centre_[d];
        high[d] = node.high[d][c] + centre_[d];
      }
      dipole.centre = dipole.weight > 0.0 ? Vec3(weighted / dipole.weight) : Vec3(0.5 * (low + high));
      dipole.radius = (dipole.centre - low).cwiseMax(high - dipole.centre).norm();
      for_parts([&](const Vec3& area, const Vec3& centre, double, const std::array<double, 6>& moment) {
        for (int m = 0; m < 6; ++m) dipole.moment[m] += moment[m];
        add_outer(area, centre - dipole.centre, dipole.moment);
      });
    }
  }
}

double TriangleTree::winding_number(const Vec3& p) const {
  double angle = 0.0;
  SolidAngles near;
  std::array<std::int32_t, 512> stack;
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::int32_t n = stack[--top];
    const TreeNode& node = nodes_[n];
    for (int c = 0; c < lanes; ++c) {
      if (node.count[c] == 0) continue;
      const Dipole& dipole = dipoles_[n][c];
      const Vec3 r = dipole.centre - p;
      const double d2 = r.squaredNorm();
      if (d2 > far_radii * far_radii * dipole.radius * dipole.radius) {
        // sum A_t . g(r + s_t) with g(r) = r / r^3, s_t the offset of triangle t, and dg/dr = I / r^3 - 3 r r^T / r^5.
        const double inverse3 = 1.0 / (d2 * std::sqrt(d2));
        const double trace = dipole.moment[0] + dipole.moment[1] + dipole.moment[2];
        angle += inverse3 * (dipole.area.dot(r) + trace - 3.0 * quadratic(dipole.moment, r) / d2);
      } else if (node.child[c] >= 0) {
        stack[top++] = node.child[c];
      } else {
        for (int i = ~node.child[c] * lanes; i < ~node.child[c] * lanes + node.count[c]; ++i) {
          near.add(corners_[i].a - p, corners_[i].b - p, corners_[i].c - p);
        }
      }
    }
  }
  return (angle + near.sum()) / (4.0 * std::numbers::pi);
}

bool TriangleTree::inside(const Vec3& p) const { return std::abs(winding_number(p)) > 0.5; }

}  // namespace puffin::lbm::geometry
