#include "lbm/geometry/shells.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "lbm/geometry/point_windows.hpp"
#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

namespace {

std::vector<TriangleMesh> parts(const TriangleMesh& mesh, const Shells& shells) {
  std::vector<TriangleMesh> result(shells.count);
  std::vector<int> becomes(mesh.vertices.size(), -1), owner(mesh.vertices.size(), -1);
  std::vector<std::vector<int>> members(shells.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) members[shells.of_triangle[t]].push_back(static_cast<int>(t));
  for (int s = 0; s < shells.count; ++s) {
    for (const int t : members[s]) {
      std::array<int, 3> triangle = mesh.triangles[t];
      for (int& v : triangle) {
        if (owner[v] != s) {
          owner[v] = s;
          becomes[v] = static_cast<int>(result[s].vertices.size());
          result[s].vertices.push_back(mesh.vertices[v]);
        }
        v = becomes[v];
      }
      result[s].triangles.push_back(triangle);
    }
  }
  return result;
}

// Of some points of a shell the one farthest from the surface of another.
Vec3 farthest_from(const TriangleTree& other, const TriangleMesh& shell) {
  constexpr std::size_t samples = 32;
  Vec3 best = shell.vertices[0];
  double away = other.closest(best).distance;
  const std::size_t n = shell.triangles.size();
  for (std::size_t k = 0; k < std::min(n, samples); ++k) {
    const int t = static_cast<int>(k * n / std::min(n, samples));
    const Vec3 p = (shell.corner(t, 0) + shell.corner(t, 1) + shell.corner(t, 2)) / 3.0;
    const double distance = other.closest(p).distance;
    if (distance <= away) continue;
    away = distance;
    best = p;
  }
  return best;
}

}  // namespace

Shells find_shells(const TriangleMesh& mesh, const Adjacency& adjacency) {
  const int n = static_cast<int>(mesh.triangles.size());
  Shells shells;
  shells.of_triangle.assign(n, -1);
  std::vector<int> open;
  for (int start = 0; start < n; ++start) {
    if (shells.of_triangle[start] >= 0) continue;
    if (adjacency.edge(start, 0) < 0) {
      shells.of_triangle[start] = 0;
      continue;
    }
    const int shell = shells.count++;
    shells.of_triangle[start] = shell;
    open.push_back(start);
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) {
        for (const auto& use : adjacency.uses(adjacency.edge(t, k))) {
          if (shells.of_triangle[use.triangle] >= 0) continue;
          shells.of_triangle[use.triangle] = shell;
          open.push_back(use.triangle);
        }
      }
    }
  }
  shells.count = std::max(shells.count, 1);
  return shells;
}

std::vector<double> shell_volumes(const TriangleMesh& mesh, const Shells& shells) {
  std::vector<double> volume(shells.count, 0.0);
  std::vector<Vec3> from(shells.count, Vec3::Constant(std::nan("")));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int t = static_cast<int>(i), s = shells.of_triangle[i];
    if (!from[s].allFinite()) from[s] = mesh.corner(t, 0);
    volume[s] +=
        (mesh.corner(t, 0) - from[s]).dot((mesh.corner(t, 1) - from[s]).cross(mesh.corner(t, 2) - from[s])) / 6.0;
  }
  return volume;
}

std::vector<int> nesting(const TriangleMesh& mesh, const Shells& shells) {
  std::vector<int> depth(shells.count, 0);
  if (shells.count < 2) return depth;
  const std::vector<TriangleMesh> part = parts(mesh, shells);
  std::vector<Vec3> low(shells.count), high(shells.count);
  for (int s = 0; s < shells.count; ++s) {
    low[s] = high[s] = part[s].vertices[0];
    for (const auto& v : part[s].vertices) {
      low[s] = low[s].cwiseMin(v);
      high[s] = high[s].cwiseMax(v);
    }
  }
  std::vector<int> all(shells.count);
  std::iota(all.begin(), all.end(), 0);
  const PointWindows lows(low, all);
  for (int outer = 0; outer < shells.count; ++outer) {
    std::unique_ptr<TriangleTree> tree;
    // What lies inside lies inside the box, but for the rounding of single precision.
    const Vec3 rounding = Vec3::Constant(1e-6 * (high[outer] - low[outer]).norm());
    const Vec3 from = low[outer] - rounding, to = high[outer] + rounding;
    for (const int inner : lows.candidates(from, to)) {
      if (inner == outer || (low[inner].array() < from.array()).any() || (high[inner].array() > to.array()).any())
        continue;
      if (!tree) tree = std::make_unique<TriangleTree>(part[outer]);
      if (tree->inside(farthest_from(*tree, part[inner]))) ++depth[inner];
    }
  }
  return depth;
}

std::vector<Defect> check_shells(const TriangleMesh& mesh, const Adjacency& adjacency, bool closed) {
  std::vector<Defect> found;
  const Shells shells = find_shells(mesh, adjacency);
  const std::vector<double> volume = shell_volumes(mesh, shells);
  // Open surfaces have no inside, and may be of as many parts as triangles.
  const std::vector<int> depth = closed ? nesting(mesh, shells) : std::vector<int>(shells.count, 0);
  std::vector<Vec3> first(shells.count, Vec3::Zero());
  for (std::size_t i = mesh.triangles.size(); i-- > 0;) {
    first[shells.of_triangle[i]] = mesh.corner(static_cast<int>(i), 0);
  }
  Defect inside_out{.kind = "inside out", .fatal = true};
  Defect separate{.kind = "disconnected part"};
  Defect nested{.kind = "nested shell"};
  auto add = [](Defect& d, const Vec3& where, const std::string& message, bool has_message = false) {
    if (d.count++ == 0 && !has_message) d.message = message;
    if (d.where.size() < Defect::places) d.where.push_back(where);
  };
  for (int s = 0; s < shells.count; ++s) {
    if (closed && depth[s] % 2 == 0 && volume[s] < 0.0) {
      add(inside_out, first[s],
          "the part of the surface at " + place_text(first[s]) +
              " is inside out: its triangles point into the volume they enclose; turn the normals around or use "
              "--repair");
    }
    if (depth[s] > 0) {
      const bool twice = depth[s] % 2 == 1 && volume[s] > 0.0;
      const std::string lies = "the part of the surface at " + place_text(first[s]) + " lies inside another";
      if (twice && !nested.fatal) {
        nested.message = lies +
                         " and points outwards: it encloses fluid a second time, and areas and volumes would "
                         "count it twice; remove it, or turn it round if it is a body in the flow";
        nested.fatal = true;
      }
      add(nested, first[s], lies + (volume[s] < 0.0 ? "; it is taken as a body in the flow" : ""), nested.fatal);
    } else if (s > 0) {
      add(separate, first[s],
          "the part of the surface at " + place_text(first[s]) + " is not connected to the first part");
    }
  }
  for (Defect* d : {&inside_out, &separate, &nested}) {
    if (d->count > 0) found.push_back(std::move(*d));
  }
  return found;
}

}  // namespace puffin::lbm::geometry
