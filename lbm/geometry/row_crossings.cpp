#include "lbm/geometry/row_crossings.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace puffin::lbm::geometry {

namespace {

__extension__ typedef __int128 Int128;  // products of two 42-bit differences need 85 bits

struct LatticePoint {
  std::int64_t y = 0, z = 0;
};

// Twice the signed area of (a, b, p): exact.
Int128 area2(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p) {
  return static_cast<Int128>(b.y - a.y) * (p.z - a.z) - static_cast<Int128>(b.z - a.z) * (p.y - a.y);
}

int sign(Int128 v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }

// The sign of area2(a, b, p) with p moved by (e, e^2), e > 0 infinitesimal: zero only if a equals b.
int side(Int128 area, const LatticePoint& a, const LatticePoint& b) {
  if (area != 0) return sign(area);
  if (a.z != b.z) return a.z > b.z ? 1 : -1;
  return b.y > a.y ? 1 : (b.y < a.y ? -1 : 0);
}

struct RowCrossing {
  std::int32_t row;
  Crossing crossing;
};

// The lattice of 2^-40 of the box on which vertices and rows lie.
class Lattice {
 public:
  Lattice(const TriangleMesh& mesh, const Voxels& box, double shift) {
    low_ = box.origin - Vec3::Constant(box.dx);
    const Vec3 high = box.centre(box.size[0], box.size[1], box.size[2]) + Vec3::Constant(box.dx);
    scale_ = std::ldexp(1.0, 40) / (high - low_).maxCoeff();
    vertices_.resize(mesh.vertices.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices_.size(), 8192), [&](const auto& r) {
      for (std::size_t v = r.begin(); v < r.end(); ++v) {
        vertices_[v] = {to_lattice(mesh.vertices[v].y(), 1), to_lattice(mesh.vertices[v].z(), 2)};
      }
    });
    for (int d = 1; d < 3; ++d) {
      auto& rows = d == 1 ? row_y_ : row_z_;
      for (int j = 0; j < box.size[d]; ++j) rows.push_back(to_lattice(box.origin[d] + j * box.dx + shift, d));
    }
  }

  const LatticePoint& vertex(int v) const { return vertices_[v]; }
  LatticePoint row(int j, int k) const { return {row_y_[j], row_z_[k]}; }

  // Rows [first, last) with coordinates in [low, high] (lattice units) along y or z.
  std::array<int, 2> rows_within(int d, std::int64_t low, std::int64_t high) const {
    const auto& rows = d == 1 ? row_y_ : row_z_;
    const auto first = std::lower_bound(rows.begin(), rows.end(), low);
    return {static_cast<int>(first - rows.begin()),
            static_cast<int>(std::upper_bound(first, rows.end(), high) - rows.begin())};
  }

 private:
  std::int64_t to_lattice(double value, int d) const { return std::llround((value - low_[d]) * scale_); }

  Vec3 low_;
  double scale_ = 0.0;
  std::vector<LatticePoint> vertices_;
  std::vector<std::int64_t> row_y_, row_z_;
};

void cross_triangle(const TriangleMesh& mesh, int t, const Voxels& box, const Lattice& lattice, double shift,
                    std::vector<RowCrossing>& out) {
  const auto& tri = mesh.triangles[t];
  const LatticePoint &a = lattice.vertex(tri[0]), &b = lattice.vertex(tri[1]), &c = lattice.vertex(tri[2]);
  const auto js = lattice.rows_within(1, std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}));
  const auto ks = lattice.rows_within(2, std::min({a.z, b.z, c.z}), std::max({a.z, b.z, c.z}));
  if (js[0] == js[1] || ks[0] == ks[1]) return;
  const Int128 whole = area2(a, b, c);
  const int facing = sign(whole);
  if (facing == 0) return;
  const double xa = mesh.corner(t, 0).x(), xb = mesh.corner(t, 1).x(), xc = mesh.corner(t, 2).x();
  const double x_low = std::min({xa, xb, xc}), x_high = std::max({xa, xb, xc});
  for (int k = ks[0]; k < ks[1]; ++k) {
    for (int j = js[0]; j < js[1]; ++j) {
      const LatticePoint p = lattice.row(j, k);
      const Int128 wc = area2(a, b, p), wa = area2(b, c, p), wb = area2(c, a, p);
      if (side(wc, a, b) != facing || side(wa, b, c) != facing || side(wb, c, a) != facing) continue;
      const double x = (static_cast<double>(wa) * xa + static_cast<double>(wb) * xb + static_cast<double>(wc) * xc) /
                       static_cast<double>(whole);
      const double cell = std::ceil((std::clamp(x, x_low, x_high) - shift - box.origin.x()) / box.dx);
      const int i = static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(box.size[0])));
      // An outward normal towards -x is an entry.
      out.push_back({j + box.size[1] * k, {i, -facing}});
    }
  }
}

}  // namespace

RowCrossings row_crossings(const TriangleMesh& mesh, const Voxels& box, double shift) {
  const Lattice lattice(mesh, box, shift);
  constexpr int chunk = 16384;
  const int n = static_cast<int>(mesh.triangles.size());
  std::vector<std::vector<RowCrossing>> found((n + chunk - 1) / chunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t part) {
    const int begin = static_cast<int>(part) * chunk, end = std::min(n, begin + chunk);
    for (int t = begin; t < end; ++t) cross_triangle(mesh, t, box, lattice, shift, found[part]);
  });

  RowCrossings result;
  result.first.assign(static_cast<std::size_t>(box.size[1]) * box.size[2] + 1, 0);
  for (const auto& part : found) {
    for (const auto& c : part) ++result.first[c.row];
  }
  std::size_t sum = 0;
  for (auto& f : result.first) {
    const std::size_t count = f;
    f = sum;
    sum += count;
  }
  result.crossings.resize(sum);
  auto next = result.first;
  for (const auto& part : found) {
    for (const auto& c : part) result.crossings[next[c.row]++] = c.crossing;
  }
  return result;
}

}  // namespace puffin::lbm::geometry
