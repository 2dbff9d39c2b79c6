#include "lbm/marker_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace puffin::lbm {

using geometry::Vec3;

namespace {

/// Buckets of an edge length, to find what is near.
class Buckets {
 public:
  explicit Buckets(double edge) : edge_(edge) {}
  void add(const Vec3& x, int n) { held_[key(cell(x))].push_back(n); }
  template <class Visit>
  void near(const Vec3& x, const Visit& visit) const {
    const auto c = cell(x);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const auto found = held_.find(key({c[0] + dx, c[1] + dy, c[2] + dz}));
          if (found == held_.end()) continue;
          for (const int n : found->second) visit(n);
        }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell(const Vec3& x) const {
    Cell c;
    for (int d = 0; d < 3; ++d) c[d] = static_cast<std::int64_t>(std::floor(x[d] / edge_));
    return c;
  }
  static std::int64_t key(const Cell& c) {
    return (c[0] & 0x1fffff) | (c[1] & 0x1fffff) << 21 | (c[2] & 0x1fffff) << 42;
  }
  double edge_;
  std::unordered_map<std::int64_t, std::vector<int>> held_;
};

using VisitMarker = std::function<void(const SurfaceMarker&)>;

void visit_samples(const LinkGeometry& surface, double apart, const VisitMarker& visit) {
  const auto& mesh = *surface.mesh;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (surface.boundaries[surface.patch_of_triangle[t]].kind != BoundaryKind::wall) continue;
    const Vec3 vector = mesh.area_vector(t);
    if (!(vector.norm() > 0.0)) continue;
    const Vec3 normal = vector.normalized();
    sample_triangle({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, 0.5 * vector.norm(), apart,
                    [&](const Vec3& x, double area) {
                      visit({x, normal, area, t});
                    });
  }
}

int parts_of(double length, double most) { return std::max(1, static_cast<int>(std::ceil(length / most))); }

/// Slices across the longer side, each in rows: `tip` is the sharp corner, `foot` the one of the right angle.
void sample_right_triangle(const Vec3& tip, const Vec3& foot, const Vec3& apex, double height, double apart,
                           const VisitSample& visit) {
  const double length = (foot - tip).norm();
  if (!(length > 0.0)) return;
  const int slices = parts_of(length, apart);
  for (int i = 0; i < slices; ++i) {
    const double at = (i + 0.5) / slices;
    const int rows = parts_of(height * (i + 1) / slices, apart);
    for (int j = 0; j < rows; ++j)
      visit(tip + at * (foot - tip) + (j + 0.5) / rows * at * (apex - foot), length / slices * height * at / rows);
  }
}

}  // namespace

void sample_triangle(const std::array<Vec3, 3>& corners, double area, double apart, const VisitSample& visit) {
  constexpr double slender = 4.0;  // longest side over height
  std::array<double, 3> side;
  for (int k = 0; k < 3; ++k) side[k] = (corners[(k + 1) % 3] - corners[k]).norm();
  const auto k = static_cast<int>(std::max_element(side.begin(), side.end()) - side.begin());
  const double longest = side[k];
  if (longest > apart && longest * longest > slender * 2.0 * area) {
    const Vec3 &p = corners[k], &q = corners[(k + 1) % 3], &apex = corners[(k + 2) % 3], along = (q - p) / longest;
    const Vec3 foot = p + std::clamp(along.dot(apex - p), 0.0, longest) * along;
    const double height = 2.0 * area / longest;
    sample_right_triangle(p, foot, apex, height, apart, visit);
    sample_right_triangle(q, foot, apex, height, apart, visit);
    return;
  }
  const int m = parts_of(longest, apart);
  const Vec3 &a = corners[0], u = (corners[1] - a) / m, v = (corners[2] - a) / m;
  for (int i = 0; i < m; ++i)
    for (int j = 0; i + j < m; ++j)
      for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
        if (third > 0.5 && i + j + 1 >= m) continue;
        visit(a + (i + third) * u + (j + third) * v, area / (static_cast<double>(m) * m));
      }
}

std::vector<SurfaceMarker> spread_markers(const LinkGeometry& surface, double spacing) {
  std::vector<SurfaceMarker> kept;
  std::vector<std::size_t> number_of_kept;  // in the order of the samples
  Buckets buckets(1.2 * spacing);
  const auto nearest = [&](const SurfaceMarker& m, double reach) {
    int best = -1;
    double least = reach;
    buckets.near(m.surface, [&](int n) {
      const double d = (kept[n].surface - m.surface).norm();
      if (d < least && kept[n].normal.dot(m.normal) > 0.7) least = d, best = n;
    });
    return best;
  };
  std::size_t number = 0;
  visit_samples(surface, 0.4 * spacing, [&](const SurfaceMarker& sample) {
    if (nearest(sample, 0.9 * spacing) < 0) {
      buckets.add(sample.surface, static_cast<int>(kept.size()));
      kept.push_back(sample);
      number_of_kept.push_back(number);
    }
    ++number;
  });
  // The same samples again: what was not kept gives its area.
  number = 0;
  auto next = number_of_kept.begin();
  visit_samples(surface, 0.4 * spacing, [&](const SurfaceMarker& sample) {
    if (next != number_of_kept.end() && *next == number)
      ++next;
    else
      kept[nearest(sample, 1.2 * spacing)].area += sample.area;
    ++number;
  });
  return kept;
}

}  // namespace puffin::lbm
