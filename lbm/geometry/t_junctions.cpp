#include "lbm/geometry/t_junctions.hpp"

#include <algorithm>
#include <tuple>

#include "lbm/geometry/point_windows.hpp"

namespace puffin::lbm::geometry {

namespace {

double tolerance_of(const TriangleMesh& mesh) {
  Vec3 low = mesh.vertices[0], high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return on_edge_fraction * (high - low).norm();
}

}  // namespace

std::vector<TJunction> find_t_junctions(const TriangleMesh& mesh, const Adjacency& adjacency) {
  struct Rim {
    int triangle, edge;
  };
  std::vector<Rim> rims;
  std::vector<int> corners;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t e = adjacency.edge(t, k);
      if (e < 0 || adjacency.uses(static_cast<std::size_t>(e)).size() != 1) continue;
      rims.push_back({t, k});
      corners.push_back(mesh.triangles[t][k]);
      corners.push_back(mesh.triangles[t][(k + 1) % 3]);
    }
  if (rims.empty()) return {};
  const double tolerance = tolerance_of(mesh);
  const PointWindows windows(mesh.vertices, corners);
  std::vector<TJunction> found;
  for (const Rim& rim : rims) {
    const auto& tri = mesh.triangles[rim.triangle];
    const Vec3 &a = mesh.vertices[tri[rim.edge]], &b = mesh.vertices[tri[(rim.edge + 1) % 3]];
    const Vec3 ab = b - a;
    const Vec3 low = a.cwiseMin(b).array() - tolerance, high = a.cwiseMax(b).array() + tolerance;
    for (const int v : windows.candidates(low, high)) {
      const Vec3& x = mesh.vertices[v];
      if ((x.array() < low.array()).any() || (x.array() > high.array()).any()) continue;
      if (v == tri[0] || v == tri[1] || v == tri[2]) continue;
      const double at = ab.dot(x - a) / ab.squaredNorm();
      if (!(at > 0.0 && at < 1.0) || (a + at * ab - x).norm() > tolerance) continue;
      found.push_back({rim.triangle, rim.edge, v, at});
    }
  }
  std::sort(found.begin(), found.end(), [](const TJunction& p, const TJunction& q) {
    return std::tie(p.triangle, p.edge, p.at, p.vertex) < std::tie(q.triangle, q.edge, q.at, q.vertex);
  });
  return found;
}

std::vector<Vec3> split_at_t_junctions(TriangleMesh& mesh) {
  std::vector<Vec3> places;
  constexpr int passes = 16;  // one edge a triangle and pass; what is left then is no seam
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<TJunction> found = find_t_junctions(mesh, Adjacency(mesh));
    if (found.empty()) break;
    for (std::size_t n = 0; n < found.size();) {
      const int triangle = found[n].triangle, edge = found[n].edge;
      const std::array<int, 3> whole = mesh.triangles[triangle];
      const int last = whole[(edge + 1) % 3], apex = whole[(edge + 2) % 3];
      int from = whole[edge];
      bool first = true;
      const auto add = [&](int to) {
        if (first) {
          mesh.triangles[triangle] = {from, to, apex};
        } else {
          mesh.triangles.push_back({from, to, apex});
          mesh.solid.push_back(mesh.solid[triangle]);
        }
        first = false;
        from = to;
      };
      for (; n < found.size() && found[n].triangle == triangle; ++n) {
        if (found[n].edge != edge) continue;  // in the next pass
        places.push_back(mesh.vertices[found[n].vertex]);
        add(found[n].vertex);
      }
      add(last);
    }
  }
  return places;
}

}  // namespace puffin::lbm::geometry
