#include "lbm/geometry/weld.hpp"

#include <cmath>
#include <cstdint>

namespace puffin::lbm::geometry {

namespace {

// Open-addressing hash from a cell of edge 2 * tolerance to the vertices in it (chained through `next`).
class VertexGrid {
 public:
  VertexGrid(std::size_t capacity, double cell) : cell_(cell) {
    std::size_t slots = 16;
    while (slots < 2 * capacity) slots *= 2;
    head_.assign(slots, -1);
    next_.reserve(capacity);
  }

  // The first kept vertex within tolerance of p, or -1.
  int find(const std::vector<Vec3>& kept, const Vec3& p, double tolerance) const {
    // With cells twice the tolerance wide only the 8 cells around the nearest cell corner can hold a partner.
    std::array<std::int64_t, 3> low;
    for (int d = 0; d < 3; ++d) low[d] = static_cast<std::int64_t>(std::floor((p[d] - tolerance) / cell_));
    int best = -1;
    for (int corner = 0; corner < 8; ++corner) {
      std::array<std::int64_t, 3> c;
      bool reached = true;
      for (int d = 0; d < 3; ++d) {
        c[d] = low[d] + ((corner >> d) & 1);
        reached = reached && static_cast<double>(c[d]) * cell_ <= p[d] + tolerance;
      }
      if (!reached) continue;
      for (int v = head_[slot(c)]; v >= 0; v = next_[v]) {
        if ((best < 0 || v < best) && (kept[v] - p).squaredNorm() <= tolerance * tolerance) best = v;
      }
    }
    return best;
  }

  void insert(const Vec3& p) {
    std::array<std::int64_t, 3> c;
    for (int d = 0; d < 3; ++d) c[d] = static_cast<std::int64_t>(std::floor(p[d] / cell_));
    const std::size_t s = slot(c);
    next_.push_back(head_[s]);
    head_[s] = static_cast<int>(next_.size()) - 1;
  }

 private:
  std::size_t slot(const std::array<std::int64_t, 3>& c) const {
    std::uint64_t h = static_cast<std::uint64_t>(c[0]) * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(c[1])) * 0xBF58476D1CE4E5B9ull;
    h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(c[2])) * 0x94D049BB133111EBull;
    return static_cast<std::size_t>(h ^ (h >> 31)) & (head_.size() - 1);
  }

  double cell_;
  std::vector<int> head_, next_;
};

}  // namespace

std::size_t weld(TriangleMesh& mesh, double tolerance) {
  double largest = 0.0;
  for (const auto& v : mesh.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  // Cells must be countable in 53 bits; a zero tolerance still merges equal corners.
  const double cell = std::max({2.0 * tolerance, largest * 1e-15, 1e-300});
  VertexGrid grid(mesh.vertices.size(), cell);
  std::vector<Vec3> kept;
  kept.reserve(mesh.vertices.size() / 4 + 8);
  std::vector<int> becomes(mesh.vertices.size(), -1);
  std::size_t used = 0;
  for (auto& t : mesh.triangles) {
    for (int& corner : t) {
      int& to = becomes[corner];
      if (to < 0) {
        ++used;
        const Vec3& p = mesh.vertices[corner];
        to = grid.find(kept, p, tolerance);
        if (to < 0) {
          to = static_cast<int>(kept.size());
          grid.insert(p);
          kept.push_back(p);
        }
      }
      corner = to;
    }
  }
  mesh.vertices = std::move(kept);
  return used - mesh.vertices.size();
}

}  // namespace puffin::lbm::geometry
