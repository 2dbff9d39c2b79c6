#include "lbm/geometry/adjacency.hpp"

#include <algorithm>

namespace puffin::lbm::geometry {

namespace {

// Counting sort: fills `first` (size bins + 1) from the number of entries a bin.
void accumulate(std::vector<std::size_t>& first) {
  std::size_t sum = 0;
  for (auto& f : first) {
    const std::size_t count = f;
    f = sum;
    sum += count;
  }
}

}  // namespace

Adjacency::Adjacency(const TriangleMesh& mesh) {
  const auto n_vertices = mesh.vertices.size();
  const auto n_triangles = mesh.triangles.size();
  auto degenerate = [](const std::array<int, 3>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };

  // Triangles around each vertex, and uses of edges bucketed by the edge's lower vertex.
  first_around_.assign(n_vertices + 1, 0);
  std::vector<std::size_t> bucket(n_vertices + 1, 0);
  for (const auto& t : mesh.triangles) {
    if (degenerate(t)) continue;
    for (int k = 0; k < 3; ++k) {
      ++first_around_[t[k]];
      ++bucket[std::min(t[k], t[(k + 1) % 3])];
    }
  }
  accumulate(first_around_);
  accumulate(bucket);
  around_.resize(first_around_.back());
  struct Half {
    std::int32_t other, triangle;
    std::int8_t k;
    bool forward;
  };
  std::vector<Half> halves(bucket.back());
  auto next_around = first_around_;
  auto next_half = bucket;
  for (std::size_t i = 0; i < n_triangles; ++i) {
    const auto& t = mesh.triangles[i];
    if (degenerate(t)) continue;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      around_[next_around[a]++] = static_cast<std::int32_t>(i);
      halves[next_half[std::min(a, b)]++] = {std::max(a, b), static_cast<std::int32_t>(i), static_cast<std::int8_t>(k),
                                             a < b};
    }
  }

  edge_of_.assign(n_triangles, {-1, -1, -1});
  uses_.reserve(halves.size());
  ends_.reserve(halves.size() / 2);
  first_use_.reserve(halves.size() / 2 + 1);
  for (std::size_t v = 0; v < n_vertices; ++v) {
    const auto begin = halves.begin() + bucket[v], end = halves.begin() + bucket[v + 1];
    std::stable_sort(begin, end, [](const Half& a, const Half& b) { return a.other < b.other; });
    for (auto h = begin; h != end; ++h) {
      if (h == begin || h->other != (h - 1)->other) {
        ends_.push_back({static_cast<std::int32_t>(v), h->other});
        first_use_.push_back(uses_.size());
      }
      edge_of_[h->triangle][h->k] = static_cast<std::int32_t>(ends_.size() - 1);
      uses_.push_back({h->triangle, h->forward});
    }
  }
  first_use_.push_back(uses_.size());
}

}  // namespace puffin::lbm::geometry
