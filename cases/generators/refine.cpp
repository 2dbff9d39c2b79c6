#include "cases/generators/refine.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace puffin::cases::generators {
namespace {

using lbm::geometry::TriangleMesh;
using lbm::geometry::Vec3;

class Refiner {
 public:
  Refiner(TriangleMesh& mesh, std::vector<int>& face) : mesh_(mesh), face_(face) {
    triangle_of_.reserve(4 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) enter(static_cast<int>(t));
  }

  void run(double longest_edge) {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) suspect(static_cast<int>(t));
    make_delaunay();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) queue_edges(static_cast<int>(t), longest_edge);
    while (!long_edges_.empty()) {
      const auto [between_faces, length, a, b] = long_edges_.top();
      long_edges_.pop();
      if (triangle_of_.count(key(-a, -b)) == 0) continue;  // swapped or cut since
      halve(-a, -b, longest_edge);
    }
  }

 private:
  static std::uint64_t key(int a, int b) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
  }
  void enter(int t) {
    const auto& c = mesh_.triangles[t];
    for (int k = 0; k < 3; ++k) triangle_of_[key(c[k], c[(k + 1) % 3])] = t;
  }
  /// The corner of triangle t across from its edge a-b.
  int opposite(int t, int a, int b) const {
    const auto& c = mesh_.triangles[t];
    return c[0] + c[1] + c[2] - a - b;
  }
  void suspect(int t) {
    const auto& c = mesh_.triangles[t];
    for (int k = 0; k < 3; ++k) suspects_.emplace_back(c[k], c[(k + 1) % 3]);
  }
  void queue_edges(int t, double longest_edge) {
    const auto& c = mesh_.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const int a = std::min(c[k], c[(k + 1) % 3]), b = std::max(c[k], c[(k + 1) % 3]);
      const double length = (mesh_.vertices[a] - mesh_.vertices[b]).norm();
      if (length <= longest_edge) continue;
      const bool between_faces = face_[triangle_of_.at(key(a, b))] != face_[triangle_of_.at(key(b, a))];
      long_edges_.emplace(between_faces, length, -a, -b);  // equal lengths: smallest indices first
    }
  }
  /// Cotangent of the angle at p in the triangle p, a, b.
  double cotangent(int p, int a, int b) const {
    const Vec3 u = mesh_.vertices[a] - mesh_.vertices[p], v = mesh_.vertices[b] - mesh_.vertices[p];
    return u.dot(v) / u.cross(v).norm();
  }

  /// Swaps diagonal a-b for c-d if the angles at c and d add up to more than pi (then the four corners are convex).
  void swap_if_better(int a, int b) {
    const auto left = triangle_of_.find(key(a, b)), right = triangle_of_.find(key(b, a));
    if (left == triangle_of_.end() || right == triangle_of_.end()) return;
    const int t = left->second, u = right->second;
    if (face_[t] != face_[u]) return;
    const int c = opposite(t, a, b), d = opposite(u, a, b);
    if (cotangent(c, a, b) + cotangent(d, a, b) >= -1e-9) return;
    if (triangle_of_.count(key(c, d)) != 0 || triangle_of_.count(key(d, c)) != 0) return;
    triangle_of_.erase(key(a, b));
    triangle_of_.erase(key(b, a));
    mesh_.triangles[t] = {c, a, d};
    mesh_.triangles[u] = {d, b, c};
    enter(t);
    enter(u);
    changed_.push_back(t);
    changed_.push_back(u);
    suspect(t);
    suspect(u);
  }
  void make_delaunay() {
    while (!suspects_.empty()) {
      const auto [a, b] = suspects_.back();
      suspects_.pop_back();
      swap_if_better(a, b);
    }
  }

  /// Cuts both triangles at edge a-b in two.
  void halve(int a, int b, double longest_edge) {
    const int middle = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.push_back(0.5 * (mesh_.vertices[a] + mesh_.vertices[b]));
    changed_.clear();
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      const auto found = triangle_of_.find(key(from, to));
      const int t = found->second, c = opposite(t, from, to), added = static_cast<int>(mesh_.triangles.size());
      triangle_of_.erase(found);
      mesh_.triangles[t] = {from, middle, c};
      mesh_.triangles.push_back({middle, to, c});
      mesh_.solid.push_back(mesh_.solid[t]);
      face_.push_back(face_[t]);
      for (const int changed : {t, added}) {
        enter(changed);
        suspect(changed);
        changed_.push_back(changed);
      }
    }
    make_delaunay();
    for (const int t : changed_) queue_edges(t, longest_edge);
  }

  TriangleMesh& mesh_;
  std::vector<int>& face_;
  std::unordered_map<std::uint64_t, int> triangle_of_;                  // directed edge -> the triangle to its left
  std::vector<std::pair<int, int>> suspects_;                           // edges that may have to be swapped
  std::vector<int> changed_;                                            // triangles changed by the last cut
  std::priority_queue<std::tuple<bool, double, int, int>> long_edges_;  // between faces, length, minus the indices
};

}  // namespace

void refine(double longest_edge, TriangleMesh& mesh, std::vector<int>& face) { Refiner(mesh, face).run(longest_edge); }

}  // namespace puffin::cases::generators
