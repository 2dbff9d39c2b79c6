#include "lbm/geometry/hole_filling.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "lbm/geometry/adjacency.hpp"

namespace puffin::lbm::geometry {

namespace {

constexpr std::size_t most_corners = 300;  // the triangulation takes rim^3 steps

// Closed walks along edges with one triangle, against that triangle's direction; each visits a vertex once.
std::vector<std::vector<int>> find_rims(const TriangleMesh& mesh) {
  const Adjacency adjacency(mesh);
  std::multimap<int, int> next;
  for (std::size_t e = 0; e < adjacency.edges(); ++e) {
    const auto uses = adjacency.uses(e);
    if (uses.size() != 1) continue;
    const auto& [low, high] = adjacency.ends(e);
    if (uses[0].forward) {
      next.emplace(high, low);
    } else {
      next.emplace(low, high);
    }
  }
  std::vector<std::vector<int>> rims;
  while (!next.empty()) {
    std::vector<int> walk{next.begin()->first};
    while (true) {
      const auto step = next.find(walk.back());
      if (step == next.end()) break;  // not closed: its neighbours disagree about the orientation
      const int to = step->second;
      next.erase(step);
      const auto met = std::find(walk.begin(), walk.end(), to);
      if (met == walk.end()) {
        walk.push_back(to);
        continue;
      }
      rims.emplace_back(met, walk.end());  // a loop is cut off, the walk goes on from its start
      walk.erase(met + 1, walk.end());
    }
  }
  return rims;
}

// The triangles there are, in any sense; put in order when the first rim of three edges asks.
class Known {
 public:
  bool holds(const TriangleMesh& mesh, const std::vector<int>& rim) {
    for (; next_ < mesh.triangles.size(); ++next_) sorted_.insert(in_order(mesh.triangles[next_]));
    return sorted_.count(in_order({rim[0], rim[1], rim[2]})) > 0;
  }

 private:
  static std::array<int, 3> in_order(std::array<int, 3> t) {
    std::sort(t.begin(), t.end());
    return t;
  }
  std::set<std::array<int, 3>> sorted_;
  std::size_t next_ = 0;
};

std::vector<std::array<int, 3>> least_area(const TriangleMesh& mesh, const std::vector<int>& rim) {
  const int n = static_cast<int>(rim.size());
  std::vector<double> cost(static_cast<std::size_t>(n) * n, 0.0);
  std::vector<int> apex(static_cast<std::size_t>(n) * n, -1);
  auto at = [n](int i, int j) { return static_cast<std::size_t>(i) * n + j; };
  for (int width = 2; width < n; ++width) {
    for (int i = 0; i + width < n; ++i) {
      const int j = i + width;
      cost[at(i, j)] = std::numeric_limits<double>::infinity();
      for (int k = i + 1; k < j; ++k) {
        const Vec3 &a = mesh.vertices[rim[i]], &b = mesh.vertices[rim[k]], &c = mesh.vertices[rim[j]];
        const double sum = cost[at(i, k)] + cost[at(k, j)] + 0.5 * (b - a).cross(c - a).norm();
        if (sum < cost[at(i, j)]) {
          cost[at(i, j)] = sum;
          apex[at(i, j)] = k;
        }
      }
    }
  }
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const int k = apex[at(i, j)];
    triangles.push_back({rim[i], rim[k], rim[j]});
    open.push_back({i, k});
    open.push_back({k, j});
  }
  return triangles;
}

}  // namespace

FilledHoles fill_holes(TriangleMesh& mesh, double longest_rim, bool fill_single_facets) {
  FilledHoles filled;
  Known known;
  int solid = -1;
  for (const auto& rim : find_rims(mesh)) {
    if (rim.size() < 3 || rim.size() > most_corners) continue;
    double length = 0.0;
    Vec3 middle = Vec3::Zero();
    for (std::size_t i = 0; i < rim.size(); ++i) {
      length += (mesh.vertices[rim[(i + 1) % rim.size()]] - mesh.vertices[rim[i]]).norm();
      middle += mesh.vertices[rim[i]] / static_cast<double>(rim.size());
    }
    const bool one_facet = fill_single_facets && rim.size() == 3;
    if ((length > longest_rim && !one_facet) || (rim.size() == 3 && known.holds(mesh, rim))) continue;
    if (solid < 0) {
      solid = static_cast<int>(mesh.solids.size());
      mesh.solids.push_back("filled-hole");
    }
    const auto triangles = least_area(mesh, rim);
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
    mesh.solid.insert(mesh.solid.end(), triangles.size(), solid);
    ++filled.holes;
    filled.triangles += triangles.size();
    filled.where.push_back(middle);
  }
  return filled;
}

}  // namespace puffin::lbm::geometry
