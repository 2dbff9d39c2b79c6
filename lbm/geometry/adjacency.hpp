#pragma once
// Who shares an edge or a vertex with whom.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lbm/geometry/triangle_mesh.hpp"

namespace puffin::lbm::geometry {

/// Edges of a welded mesh and the triangles around each edge and vertex. Edge k of a triangle runs from its corner k to
/// its corner (k+1)%3. Degenerate triangles (two equal corner indices) take part in nothing.
class Adjacency {
 public:
  Adjacency() = default;
  explicit Adjacency(const TriangleMesh& mesh);

  /// One triangle's use of an edge.
  struct Use {
    std::int32_t triangle = -1;
    bool forward = true;  // the triangle runs from the edge's lower vertex index to the higher
  };

  std::size_t edges() const { return ends_.size(); }
  /// Vertex indices of edge e, lower first.
  const std::array<std::int32_t, 2>& ends(std::size_t e) const { return ends_[e]; }
  std::span<const Use> uses(std::size_t e) const {
    return {uses_.data() + first_use_[e], first_use_[e + 1] - first_use_[e]};
  }
  /// Edge k of triangle t, or -1 if the triangle is degenerate.
  std::int32_t edge(int t, int k) const { return edge_of_[t][k]; }
  std::span<const std::int32_t> around(int vertex) const {
    return {around_.data() + first_around_[vertex], first_around_[vertex + 1] - first_around_[vertex]};
  }

 private:
  std::vector<std::array<std::int32_t, 2>> ends_;
  std::vector<Use> uses_;
  std::vector<std::size_t> first_use_;
  std::vector<std::array<std::int32_t, 3>> edge_of_;
  std::vector<std::int32_t> around_;
  std::vector<std::size_t> first_around_;
};

}  // namespace puffin::lbm::geometry
