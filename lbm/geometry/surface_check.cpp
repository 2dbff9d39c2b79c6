#include "lbm/geometry/surface_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "lbm/geometry/adjacency.hpp"
#include "lbm/geometry/facet_area.hpp"
#include "lbm/geometry/self_intersection.hpp"
#include "lbm/geometry/shells.hpp"
#include "lbm/geometry/t_junctions.hpp"

namespace puffin::lbm::geometry {

namespace {

std::string text(double value) {
  std::array<char, 32> s;
  std::snprintf(s.data(), s.size(), "%.4g", value);
  return s.data();
}

std::string edge_text(const TriangleMesh& mesh, const std::array<std::int32_t, 2>& ends) {
  return "the edge from " + place_text(mesh.vertices[ends[0]]) + " to " + place_text(mesh.vertices[ends[1]]);
}

void add_place(Defect& defect, const Vec3& where, const std::string& message) {
  if (defect.count++ == 0) defect.message = message;
  if (defect.where.size() < Defect::places) defect.where.push_back(where);
}

// Uses of an edge along minus against it: zero for every edge means that the triangles bound a volume.
int balance(std::span<const Adjacency::Use> uses) {
  int sum = 0;
  for (const auto& use : uses) sum += use.forward ? 1 : -1;
  return sum;
}

void check_edges(const TriangleMesh& mesh, const Adjacency& adjacency, std::vector<Defect>& found) {
  Defect hole{.kind = "hole", .fatal = true};
  Defect crowded{.kind = "non-manifold edge"};
  Defect turned{.kind = "inconsistent orientation", .fatal = true};
  for (std::size_t e = 0; e < adjacency.edges(); ++e) {
    const auto uses = adjacency.uses(e);
    const auto& ends = adjacency.ends(e);
    const Vec3 middle = 0.5 * (mesh.vertices[ends[0]] + mesh.vertices[ends[1]]);
    if (uses.size() == 1) {
      add_place(hole, middle,
                "the surface has a hole: " + edge_text(mesh, ends) +
                    " belongs to one triangle only; if it is an opening, close it with a flat cap in a solid of its "
                    "own, else close the "
                    "surface in the CAD program or use --repair");
    } else if (uses.size() > 2) {
      // Four triangles in balance are two bodies that touch in an edge: a volume all the same.
      if (balance(uses) != 0) crowded.fatal = true;
      add_place(crowded, middle,
                edge_text(mesh, ends) + " belongs to " + std::to_string(uses.size()) +
                    " triangles; export the union of the bodies, without faces inside");
    } else if (balance(uses) != 0) {
      add_place(turned, middle,
                "the two triangles at " + edge_text(mesh, ends) +
                    " point to different sides of the surface; make the normals agree or use --repair");
    }
  }
  if (hole.count > 0) {
    const std::vector<TJunction> junctions = find_t_junctions(mesh, adjacency);
    if (!junctions.empty())
      hole.message += "; " + std::to_string(junctions.size()) +
                      " corners lie on edges of other triangles, the first at " +
                      place_text(mesh.vertices[junctions[0].vertex]) +
                      ": meshes of different fineness meet there, and --repair splits their triangles";
  }
  for (Defect* d : {&hole, &crowded, &turned}) {
    if (d->count > 0) found.push_back(std::move(*d));
  }
}

void check_facets(const TriangleMesh& mesh, std::vector<Defect>& found) {
  Defect degenerate{.kind = "degenerate facet"};
  Defect duplicate{.kind = "duplicate facet"};
  std::vector<std::pair<std::array<int, 3>, int>> keys;
  keys.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int t = static_cast<int>(i);
    const auto& tri = mesh.triangles[i];
    const bool equal_corners = has_equal_corners(tri);
    if (has_no_area(mesh, t)) {
      add_place(degenerate, (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0,
                "the triangle at " + place_text(mesh.corner(t, 0)) + " has no area; harmless, --repair removes it");
    }
    if (!equal_corners) {
      std::array<int, 3> sorted = tri;
      std::sort(sorted.begin(), sorted.end());
      keys.emplace_back(sorted, t);
    }
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].first != keys[i - 1].first) continue;
    const int t = keys[i].second;
    // A copy with the same sense counts the area of its patch twice. One turned round is the common face of two bodies.
    const auto around = [&](int s) { return mesh.area_vector(s).dot(mesh.area_vector(t)); };
    duplicate.fatal = duplicate.fatal || around(keys[i - 1].second) > 0.0;
    add_place(duplicate, (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0,
              "the triangle at " + place_text(mesh.corner(t, 0)) +
                  " is there more than once, and areas and volumes would count it as often; --repair removes copies");
  }
  for (Defect* d : {&duplicate, &degenerate}) {
    if (d->count > 0) found.push_back(std::move(*d));
  }
}

// The unit in which a surface that is `longest` long as it was read would be 5 mm to 500 mm long.
std::string likely_unit(double longest) {
  struct Unit {
    const char* name;
    double metres;
  };
  // Read as `from`, meant as `to`.
  // The likeliest first.
  constexpr std::array<Unit, 5> units{{{"mm", 1e-3}, {"m", 1.0}, {"inch", 0.0254}, {"cm", 1e-2}, {"um", 1e-6}}};
  // Too large: taken for m; too small: taken for mm.
  for (const Unit& from :
       longest > 1.0 ? std::array{units[1], units[3], units[0]} : std::array{units[0], units[1], units[3]})
    for (const Unit& to : units) {
      const double meant = longest / from.metres * to.metres;
      if (meant >= 5e-3 && meant <= 0.5)
        return std::string("; if it was read in ") + from.name + ", its unit may be " + to.name +
               (std::string(to.name) == "inch" ? " (export in mm)" : "") + ": " + text(meant * 1e3) + " mm long";
    }
  return "";
}

void check_size(const TriangleMesh& mesh, std::vector<Defect>& found) {
  Vec3 low = mesh.vertices[0], high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double longest = (high - low).maxCoeff(), away = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  // Devices and test channels are between 0.2 mm and 2 m long.
  if (longest < 2e-4 || longest > 2.0)
    found.push_back({.kind = "suspicious size",
                     .count = 1,
                     .where = {0.5 * (low + high)},
                     .message = "the surface is " + text(longest) +
                                " m long; is the unit right? Set unit = \"mm\" (or " +
                                "another) in [geometry], or --unit" + likely_unit(longest)});
  // Single precision resolves 2^-24 of the largest coordinate.
  const double resolved = std::ldexp(away, -24);
  if (resolved > 1e-5 * longest)
    found.push_back({.kind = "coarse coordinates",
                     .count = 1,
                     .where = {0.5 * (low + high)},
                     .message = "the surface lies " + text(away) +
                                " m from the origin, where the single precision of "
                                "STL resolves " +
                                text(resolved) + " m, " + text(100.0 * resolved / longest) +
                                " % of its length; move it to the origin before the export"});
}

}  // namespace

std::string place_text(const Vec3& p) {
  std::array<char, 96> s;
  std::snprintf(s.data(), s.size(), "(%.9g, %.9g, %.9g) m", p.x(), p.y(), p.z());
  return s.data();
}

double enclosed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Vec3 from = mesh.vertices[0];  // a point near the surface keeps the terms small
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int i = static_cast<int>(t);
    volume += (mesh.corner(i, 0) - from).dot((mesh.corner(i, 1) - from).cross(mesh.corner(i, 2) - from));
  }
  return volume / 6.0;
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.area(static_cast<int>(t));
  return area;
}

std::vector<Defect> check_surface(const TriangleMesh& mesh, bool self_intersections) {
  std::vector<Defect> found;
  if (mesh.triangles.empty()) {
    found.push_back({.kind = "hole", .count = 1, .message = "the surface has no triangles", .fatal = true});
    return found;
  }
  const Adjacency adjacency(mesh);
  check_edges(mesh, adjacency, found);
  const bool closed = std::none_of(found.begin(), found.end(), [](const Defect& d) { return d.fatal; });
  check_facets(mesh, found);
  for (Defect& d : check_shells(mesh, adjacency, closed)) found.push_back(std::move(d));
  if (self_intersections) {
    Defect crossing{.kind = "self-intersection"};
    for (const Intersection& i : find_self_intersections(mesh)) {
      add_place(crossing, i.where,
                "two triangles cross or overlap at " + place_text(i.where) +
                    "; the enclosed volume is taken as their union, and a run refuses faces inside it; export the "
                    "union of the bodies");
    }
    if (crossing.count > 0) found.push_back(std::move(crossing));
  }
  check_size(mesh, found);
  std::stable_sort(found.begin(), found.end(), [](const Defect& a, const Defect& b) { return a.fatal > b.fatal; });
  return found;
}

void require_closed(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw GeometryError("error: the surface has no triangles");
  const Adjacency adjacency(mesh);
  std::vector<Defect> found;
  check_edges(mesh, adjacency, found);
  const auto bad = std::find_if(found.begin(), found.end(), [](const Defect& d) { return d.fatal; });
  if (bad != found.end()) {
    throw GeometryError("error: " + bad->message + " (" + std::to_string(bad->count) + " such edge" +
                        (bad->count == 1 ? "" : "s") + ")");
  }
  if (!(enclosed_volume(mesh) > 0.0)) {
    throw GeometryError(
        "error: the surface is inside out: its triangles point into the volume they enclose; turn the normals "
        "around or use --repair");
  }
}

}  // namespace puffin::lbm::geometry
