#include "lbm/geometry/shells.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

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
  for (int outer = 0; outer < shells.count; ++outer) {
    std::unique_ptr<TriangleTree> tree;
    for (int inner = 0; inner < shells.count; ++inner) {
      const Vec3& p = part[inner].vertices[0];
      if (inner == outer || (p.array() < low[outer].array()).any() || (p.array() > high[outer].array()).any()) continue;
      if (!tree) tree = std::make_unique<TriangleTree>(part[outer]);
      if (tree->inside(p)) ++depth[inner];
    }
  }
  return depth;
}

std::vector<Defect> check_shells(const TriangleMesh& mesh, const Adjacency& adjacency, bool closed) {
  std::vector<Defect> found;
  const Shells shells = find_shells(mesh, adjacency);
  const std::vector<double> volume = shell_volumes(mesh, shells);
  const std::vector<int> depth = nesting(mesh, shells);
  std::vector<Vec3> first(shells.count, Vec3::Zero());
  for (std::size_t i = mesh.triangles.size(); i-- > 0;) {
    first[shells.of_triangle[i]] = mesh.corner(static_cast<int>(i), 0);
  }
  Defect inside_out{.kind = "inside out", .fatal = true};
  Defect separate{.kind = "disconnected part"};
  Defect nested{.kind = "nested shell"};
  auto add = [](Defect& d, const Vec3& where, const std::string& message) {
    if (d.count++ == 0) d.message = message;
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
      add(nested, first[s],
          "the part of the surface at " + place_text(first[s]) + " lies inside another; " +
              (volume[s] < 0.0 ? "it is taken as a body in the flow"
                               : "it changes nothing, because it points outwards"));
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
