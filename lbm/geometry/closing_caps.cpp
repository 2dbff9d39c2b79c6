#include "lbm/geometry/closing_caps.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

namespace puffin::lbm::geometry {

namespace {

struct OpenEdge {
  int from = 0, to = 0, times = 0;  // the surface runs along it `times` more often than against it
};

std::vector<OpenEdge> open_edges(const Adjacency& adjacency) {
  std::vector<OpenEdge> open;
  for (std::size_t e = 0; e < adjacency.edges(); ++e) {
    int sum = 0;
    for (const auto& use : adjacency.uses(e)) sum += use.forward ? 1 : -1;
    const auto& [low, high] = adjacency.ends(e);
    if (sum > 0) open.push_back({low, high, sum});
    if (sum < 0) open.push_back({high, low, -sum});
  }
  return open;
}

// Vertices connected by open edges: a representative of each, found through `leader`.
int find(std::map<int, int>& leader, int v) {
  while (leader[v] != v) v = leader[v] = leader[leader[v]];
  return v;
}

}  // namespace

ClosingCaps::ClosingCaps(const TriangleMesh& mesh, const Adjacency& adjacency) : mesh_(mesh) {
  const auto open = open_edges(adjacency);
  if (open.empty()) return;
  std::map<int, int> leader;
  for (const OpenEdge& e : open) {
    leader.emplace(e.from, e.from);
    leader.emplace(e.to, e.to);
  }
  for (const OpenEdge& e : open) leader[find(leader, e.from)] = find(leader, e.to);

  closed_ = std::make_unique<TriangleMesh>(mesh);
  TriangleMesh caps;
  std::map<int, int> apex;  // of a rim's leader: vertex of closed_
  std::map<int, int> corners;
  for (const auto& [v, unused] : leader) {
    const int rim = find(leader, v);
    const auto [at, is_new] = apex.emplace(rim, static_cast<int>(closed_->vertices.size()));
    if (is_new) closed_->vertices.push_back(Vec3::Zero());
    closed_->vertices[at->second] += mesh.vertices[v];
    ++corners[rim];
  }
  for (const auto& [rim, vertex] : apex) closed_->vertices[vertex] /= corners[rim];
  for (const OpenEdge& e : open) {
    for (int n = 0; n < e.times; ++n) caps.triangles.push_back({e.to, e.from, apex[find(leader, e.from)]});
  }
  closed_->triangles.insert(closed_->triangles.end(), caps.triangles.begin(), caps.triangles.end());
  caps.vertices = closed_->vertices;
  double area = 0.0;
  for (std::size_t t = 0; t < caps.triangles.size(); ++t) area += caps.area(static_cast<int>(t));
  caps_ = std::make_unique<TriangleTree>(std::move(caps));
  // A triangle of area A at distance d fills at most A / d^2 of the 4 pi around a point.
  reach_ = std::sqrt(area / (2.0 * std::numbers::pi));
}

bool ClosingCaps::inside(int n, const Vec3& p) const {
  if (caps_->closest(p, reach_).triangle < 0) return n != 0;
  return std::abs(n - caps_->winding_number(p)) > 0.5;
}

}  // namespace puffin::lbm::geometry
