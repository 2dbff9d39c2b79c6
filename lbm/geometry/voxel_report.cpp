#include "lbm/geometry/voxel_report.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lbm/geometry/surface_check.hpp"

namespace puffin::lbm::geometry {

namespace {

constexpr double facing = -0.8;  // cosine between the normals of the two sides of a gap
constexpr std::size_t most_samples = 200'000;

struct Narrowest {
  double width = std::numeric_limits<double>::infinity();
  Vec3 middle = Vec3::Zero();
  void take(double w, const Vec3& m) {
    if (w < width) *this = {w, m};
  }
};

struct Widths {
  Narrowest gap, wall;  // across the enclosed volume, across what is outside it
};

// Points spread over a triangle: barycentric lattice with `n` points a side, none on an edge.
template <class Visit>
void for_points(const TriangleMesh& mesh, int t, int n, Visit&& visit) {
  const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
  const double inset = n == 1 ? 1.0 / 3.0 : 0.01;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const double u = n == 1 ? inset : inset + (1.0 - 3.0 * inset) * i / (n - 1);
      const double v = n == 1 ? inset : inset + (1.0 - 3.0 * inset) * j / (n - 1);
      visit(a + u * (b - a) + v * (c - a));
    }
  }
}

Widths measure(const TriangleTree& tree, const std::vector<char>& opening) {
  const TriangleMesh& mesh = tree.mesh();
  const int n = static_cast<int>(mesh.triangles.size());
  const double diagonal = (tree.max() - tree.min()).norm();
  double wall_area = 0.0;
  for (int t = 0; t < n; ++t) wall_area += opening[t] ? 0.0 : mesh.area(t);
  const double area_each = wall_area / most_samples;

  auto one_triangle = [&](int t, Widths& widths) {
    const Vec3 normal = mesh.area_vector(t).stableNormalized();
    if (opening[t] || !(normal.squaredNorm() > 0.5)) return;
    // n (n + 1) / 2 points a triangle; at least the centre if there are many triangles, else three by the corners.
    const int at_least = static_cast<std::size_t>(n) * 3 > most_samples ? 1 : 2;
    const int side = std::max(at_least, static_cast<int>(std::sqrt(2.0 * mesh.area(t) / area_each)) - 1);
    const double off = 1e-7 * diagonal;
    for_points(mesh, t, side, [&](const Vec3& p) {
      for (const bool inward : {true, false}) {
        const Vec3 direction = inward ? Vec3(-normal) : normal;
        Narrowest& best = inward ? widths.gap : widths.wall;
        const auto hit = tree.first_hit(p + off * direction, direction, std::min(best.width, diagonal));
        if (!hit || opening[hit->triangle]) continue;
        const Vec3 other = mesh.area_vector(hit->triangle).stableNormalized();
        if (other.dot(normal) < facing) best.take(hit->t + off, p + 0.5 * (hit->t + off) * direction);
      }
    });
  };
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<int>(0, n, 512), Widths(),
      [&](const tbb::blocked_range<int>& r, Widths widths) {
        for (int t = r.begin(); t < r.end(); ++t) one_triangle(t, widths);
        return widths;
      },
      [](Widths a, const Widths& b) {
        a.gap.take(b.gap.width, b.gap.middle);
        a.wall.take(b.wall.width, b.wall.middle);
        return a;
      });
}

}  // namespace

VoxelReport voxel_report(const TriangleTree& tree, const Voxels& voxels, const Patches& patches,
                         const std::vector<std::string>& openings, const Pockets& dropped) {
  const TriangleMesh& mesh = tree.mesh();
  VoxelReport report;
  report.cells_fluid = voxels.cells();
  report.volume_stl = std::abs(enclosed_volume(mesh));
  report.volume_voxels = static_cast<double>(report.cells_fluid) * voxels.dx * voxels.dx * voxels.dx;
  report.area_stl = surface_area(mesh);
  report.pockets = dropped;
  for (const auto& name : patches.names) {
    report.patches.push_back({name, 0.0, 0, std::find(openings.begin(), openings.end(), name) != openings.end()});
  }
  std::vector<char> opening(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    PatchReport& patch = report.patches[patches.of_triangle[t]];
    patch.area += mesh.area(static_cast<int>(t));
    ++patch.triangles;
    opening[t] = patch.opening;
    if (patch.opening) report.area_openings += mesh.area(static_cast<int>(t));
  }
  report.hidden = hidden_faces(tree, voxels, opening);
  const Widths widths = measure(tree, opening);
  report.narrowest_gap = widths.gap.width;
  report.narrowest_gap_at = widths.gap.middle;
  report.narrowest_gap_cells = widths.gap.width / voxels.dx;
  report.thinnest_wall = widths.wall.width;
  report.thinnest_wall_at = widths.wall.middle;
  report.recommended_dx = widths.gap.width / VoxelReport::cells_across;
  return report;
}

}  // namespace puffin::lbm::geometry
