#include "lbm/geometry/repair.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

#include "lbm/geometry/adjacency.hpp"
#include "lbm/geometry/facet_area.hpp"
#include "lbm/geometry/hole_filling.hpp"
#include "lbm/geometry/shells.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/t_junctions.hpp"
#include "lbm/geometry/weld.hpp"

namespace puffin::lbm::geometry {

namespace {

Vec3 middle(const TriangleMesh& mesh, int t) {
  return (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
}

void keep_only(TriangleMesh& mesh, const std::vector<char>& keep) {
  std::size_t to = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep[t]) continue;
    mesh.triangles[to] = mesh.triangles[t];
    mesh.solid[to] = mesh.solid[t];
    ++to;
  }
  mesh.triangles.resize(to);
  mesh.solid.resize(to);
}

Repair remove(TriangleMesh& mesh, const std::vector<char>& keep, const std::string& what) {
  Repair done{.what = what};
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t]) continue;
    ++done.count;
    if (done.where.size() < Defect::places) done.where.push_back(middle(mesh, static_cast<int>(t)));
  }
  keep_only(mesh, keep);
  done.message = what + ": " + std::to_string(done.count);
  return done;
}

Repair remove_degenerate(TriangleMesh& mesh) {
  std::vector<char> keep(mesh.triangles.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = !has_no_area(mesh, static_cast<int>(i));
  return remove(mesh, keep, "removed degenerate facets");
}

// +1 or -1 by the sense in which a triangle runs through its sorted corners.
int sense(const std::array<int, 3>& t) { return ((t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0])) == 2 ? 1 : -1; }

// Of copies with one sense in the majority one stays. Copies that cancel (a wall of no thickness, or the common face of
// two bodies) all go if every edge keeps at least two triangles without them, else the first stays. `mixed`: groups
// with both senses too; else only those with one and in one solid.
Repair remove_duplicates(TriangleMesh& mesh, bool mixed) {
  const Adjacency adjacency(mesh);
  const int n = static_cast<int>(mesh.triangles.size());
  std::vector<std::array<int, 3>> sorted = mesh.triangles;
  for (auto& s : sorted) std::sort(s.begin(), s.end());
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b; });
  std::vector<char> keep(n, 1);
  for (int begin = 0, end = 0; begin < n; begin = end) {
    int sum = 0;
    for (end = begin; end < n && sorted[order[end]] == sorted[order[begin]]; ++end)
      sum += sense(mesh.triangles[order[end]]);
    const bool one_solid = std::all_of(order.begin() + begin, order.begin() + end,
                                       [&](int t) { return mesh.solid[t] == mesh.solid[order[begin]]; });
    if (end - begin < 2 || (!mixed && (std::abs(sum) != end - begin || !one_solid))) continue;
    for (int i = begin; i < end; ++i) keep[order[i]] = 0;
    if (sum != 0) {
      const auto first = std::find_if(order.begin() + begin, order.begin() + end,
                                      [&](int t) { return sense(mesh.triangles[t]) == (sum > 0 ? 1 : -1); });
      keep[*first] = 1;
      continue;
    }
    bool needed = false;
    for (int k = 0; k < 3; ++k) {
      needed = needed || static_cast<int>(adjacency.uses(adjacency.edge(order[begin], k)).size()) - (end - begin) < 2;
    }
    keep[order[begin]] = needed;
  }
  return remove(mesh, keep, "removed duplicate facets");
}

// Across edges of two triangles, neighbours run through the edge in opposite directions; each part keeps the
// orientation of its majority.
std::vector<char> disagreeing(const TriangleMesh& mesh, const Adjacency& adjacency) {
  const int n = static_cast<int>(mesh.triangles.size());
  std::vector<signed char> turn(n, -1);
  std::vector<int> part;
  for (int start = 0; start < n; ++start) {
    if (turn[start] >= 0) continue;
    turn[start] = 0;
    part.assign(1, start);
    std::size_t turned = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int t = part[i];
      turned += turn[t];
      for (int k = 0; k < 3; ++k) {
        if (adjacency.edge(t, k) < 0) continue;
        const auto uses = adjacency.uses(adjacency.edge(t, k));
        if (uses.size() != 2) continue;
        const int other = uses[0].triangle == t ? uses[1].triangle : uses[0].triangle;
        if (turn[other] >= 0) continue;
        turn[other] = static_cast<signed char>(turn[t] ^ (uses[0].forward == uses[1].forward ? 1 : 0));
        part.push_back(other);
      }
    }
    if (2 * turned > part.size()) {
      for (const int t : part) turn[t] ^= 1;
    }
  }
  return {turn.begin(), turn.end()};
}

void turn_facets(TriangleMesh& mesh, const std::vector<char>& turn, Repair& done) {
  for (std::size_t t = 0; t < turn.size(); ++t) {
    if (!turn[t]) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    ++done.count;
    if (done.where.size() < Defect::places) done.where.push_back(middle(mesh, static_cast<int>(t)));
  }
}

struct Senses {
  std::vector<char> wrong;  // per triangle: of a part that is in nothing else and points into itself
  bool right = true;        // such parts there are none, and all that lie in another are bodies in the flow
};

Senses senses_of(const TriangleMesh& mesh) {
  const Shells shells = find_shells(mesh, Adjacency(mesh));
  const auto volume = shell_volumes(mesh, shells);
  const auto depth = nesting(mesh, shells);
  Senses senses;
  for (const int s : shells.of_triangle) {
    senses.wrong.push_back(depth[s] % 2 == 0 && volume[s] < 0.0);
    senses.right = senses.right && (depth[s] % 2 == 0 ? volume[s] >= 0.0 : volume[s] <= 0.0);
  }
  return senses;
}

// Parts that point into the volume they enclose, unless they lie inside another part (a body in the flow); all parts if
// the surface is right when it is turned as a whole.
std::vector<char> inside_out(const TriangleMesh& mesh) {
  const Senses as_it_is = senses_of(mesh);
  if (std::count(as_it_is.wrong.begin(), as_it_is.wrong.end(), 1) == 0) return as_it_is.wrong;
  TriangleMesh turned = mesh;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  if (senses_of(turned).right) return std::vector<char>(mesh.triangles.size(), 1);
  return as_it_is.wrong;
}

}  // namespace

Repair remove_copies(TriangleMesh& mesh) { return remove_duplicates(mesh, false); }

std::vector<Repair> repair(TriangleMesh& mesh, const RepairOptions& options) {
  std::vector<Repair> done;
  if (mesh.triangles.empty()) return done;
  Vec3 low = mesh.vertices[0], high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double diagonal = (high - low).norm();
  auto note = [&](Repair&& r) {
    if (r.count > 0) done.push_back(std::move(r));
  };

  const double tolerance = options.weld_tolerance > 0.0 ? options.weld_tolerance : mend_fraction * diagonal;
  Repair welded{.what = "welded vertices", .count = weld(mesh, tolerance)};
  welded.message = "welded vertices: " + std::to_string(welded.count);
  note(std::move(welded));
  note(remove_degenerate(mesh));
  note(remove_duplicates(mesh, true));

  Repair split{.what = "split facets", .where = split_at_t_junctions(mesh)};
  split.count = split.where.size();
  if (split.where.size() > Defect::places) split.where.resize(Defect::places);
  split.message = "split facets: " + std::to_string(split.count) + " corners of neighbours lay on their edges";
  note(std::move(split));

  Repair turned{.what = "turned facets"};
  turn_facets(mesh, disagreeing(mesh, Adjacency(mesh)), turned);

  const bool usual = !(options.largest_hole > 0.0);
  const FilledHoles filled = fill_holes(mesh, usual ? diagonal / 20.0 : options.largest_hole, usual);
  turn_facets(mesh, inside_out(mesh), turned);
  turned.message = "turned facets: " + std::to_string(turned.count);
  note(std::move(turned));
  note({.what = "filled holes",
        .count = filled.holes,
        .where = filled.where,
        .message = "filled holes: " + std::to_string(filled.holes) + " with " + std::to_string(filled.triangles) +
                   " triangles in the solid 'filled-hole'; look at them"});
  return done;
}

}  // namespace puffin::lbm::geometry
