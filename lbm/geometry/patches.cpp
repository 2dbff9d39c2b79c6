#include "lbm/geometry/patches.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>

#include "lbm/geometry/adjacency.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/triangle_distance.hpp"

namespace puffin::lbm::geometry {

namespace {

constexpr double plane_fraction = 1e-5;         // of the bounding box diagonal
constexpr double flat_cosine = 1.0 - 3.807e-5;  // half a degree

constexpr double near_fraction = 1e-2;  // of the diagonal: a point farther from the surface is a slip

double diagonal_of(const TriangleMesh& mesh) {
  Vec3 low = mesh.vertices[0], high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).norm();
}

// Number of single letters to insert, delete or replace to turn a into b (Levenshtein).
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (std::tolower(a[i - 1]) == std::tolower(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string unknown_solid(const std::string& name, const std::vector<std::string>& known) {
  std::string message = "there is no solid '" + name + "'";
  const auto best = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return letters_apart(name, a) < letters_apart(name, b);
  });
  if (best != known.end() && letters_apart(name, *best) <= std::max<std::size_t>(1, name.size() / 3)) {
    message += "; did you mean '" + *best + "'?";
  }
  message += " The solids of the file:";
  for (const auto& k : known) message += " '" + k + "'";
  return message;
}

struct Outcome {
  std::vector<int> triangles;
  std::string error;  // empty if all is well
};

Outcome select_solid(const TriangleMesh& mesh, const std::string& name) {
  const auto found = std::find(mesh.solids.begin(), mesh.solids.end(), name);
  if (found == mesh.solids.end()) return {{}, unknown_solid(name, mesh.solids)};
  Outcome result;
  const int wanted = static_cast<int>(found - mesh.solids.begin());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.solid[t] == wanted) result.triangles.push_back(static_cast<int>(t));
  }
  if (result.triangles.empty()) result.error = "the solid '" + name + "' has no triangles";
  return result;
}

Outcome select_plane(const TriangleMesh& mesh, const std::string& plane) {
  static const std::array<std::string, 6> names{"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"};
  const auto found = std::find(names.begin(), names.end(), plane);
  if (found == names.end()) {
    return {{}, "'plane:" + plane + "' is no plane; write plane:x-min, x-max, y-min, y-max, z-min or z-max"};
  }
  const int side = static_cast<int>(found - names.begin()), axis = side / 2;
  const bool at_max = side % 2 == 1;
  Vec3 low = mesh.vertices[0], high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double tolerance = plane_fraction * (high - low).norm();
  const double level = at_max ? high[axis] : low[axis];
  Outcome result;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int t = static_cast<int>(i);
    bool all = true;
    for (int k = 0; k < 3; ++k) all = all && std::abs(mesh.corner(t, k)[axis] - level) <= tolerance;
    if (all) result.triangles.push_back(t);
  }
  if (result.triangles.empty()) {
    result.error = "no triangle lies flat in the plane " + plane + " of the bounding box (" + "xyz"[axis] + " = " +
                   std::to_string(level * 1e3) + " mm)";
  }
  return result;
}

std::optional<Vec3> parse_point(const std::string& text) {
  Vec3 p;
  const char *at = text.data(), *end = text.data() + text.size();
  auto take = [&](char c) {
    while (at != end && *at == ' ') ++at;
    if (at == end || *at != c) return false;
    ++at;
    while (at != end && *at == ' ') ++at;
    return true;
  };
  if (!take('[')) return std::nullopt;
  for (int d = 0; d < 3; ++d) {
    if (d > 0 && !take(',')) return std::nullopt;
    if (at != end && *at == '+') ++at;
    const auto [next, error] = std::from_chars(at, end, p[d]);
    if (error != std::errc() || !std::isfinite(p[d])) return std::nullopt;
    at = next;
  }
  if (!take(']') || at != end) return std::nullopt;
  return p;
}

// Triangles connected to the first that are turned less than half a degree from the normal, or lie in the plane through
// the first with all corners (slivers and facets without area have no normal worth asking).
std::vector<int> flat_around(const TriangleMesh& mesh, const Adjacency& adjacency, int first, const Vec3& normal) {
  const double tolerance = plane_fraction * diagonal_of(mesh);
  const Vec3 on = (mesh.corner(first, 0) + mesh.corner(first, 1) + mesh.corner(first, 2)) / 3.0;
  const auto flat = [&](int t) {
    const Vec3 n = mesh.area_vector(t);
    if (n.norm() > 0.0 && n.dot(normal) >= flat_cosine * n.norm()) return true;
    bool in_plane = true;
    for (int k = 0; k < 3; ++k) in_plane = in_plane && std::abs(normal.dot(mesh.corner(t, k) - on)) <= tolerance;
    return in_plane;
  };
  std::vector<int> found{first};
  std::vector<char> taken(mesh.triangles.size(), 0);
  taken[first] = 1;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      for (const auto& use : adjacency.uses(static_cast<std::size_t>(adjacency.edge(found[i], k)))) {
        if (taken[use.triangle] || !flat(use.triangle)) continue;
        taken[use.triangle] = 1;
        found.push_back(use.triangle);
      }
    }
  }
  return found;
}

struct Near {
  int triangle = -1;
  double distance = std::numeric_limits<double>::infinity();
};

Near nearest_facet(const TriangleMesh& mesh, const Adjacency& adjacency, const Vec3& point) {
  Near best;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int t = static_cast<int>(i);
    if (!(mesh.area(t) > 0.0) || adjacency.edge(t, 0) < 0) continue;
    const auto on = nearest_on_triangle(point, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
    const double distance = (on.point - point).norm();
    if (distance < best.distance) best = {t, distance};
  }
  return best;
}

// The likeliest cause is the unit of the file in place of metres: said where the point would then lie on the surface.
std::string too_far(const TriangleMesh& mesh, const Adjacency& adjacency, const Vec3& point, double away, double most) {
  struct Unit {
    const char* name;
    double metres;
  };
  std::array<char, 400> text;
  std::snprintf(text.data(), text.size(),
                "near:[%.6g, %.6g, %.6g] lies %.4g mm from the surface, more than 1 %% of its diagonal (%.4g mm): its "
                "numbers are metres; give a point on the feature",
                point.x(), point.y(), point.z(), 1e3 * away, 1e3 * most);
  std::string message = text.data();
  if (away < diagonal_of(mesh)) return message;
  for (const Unit& unit : std::array<Unit, 4>{{{"mm", 1e-3}, {"cm", 1e-2}, {"inch", 0.0254}, {"um", 1e-6}}}) {
    const Vec3 meant = unit.metres * point;
    if (!(nearest_facet(mesh, adjacency, meant).distance <= most)) continue;
    std::snprintf(text.data(), text.size(), "; if they were meant in %s, write near:[%.9g, %.9g, %.9g]", unit.name,
                  meant.x(), meant.y(), meant.z());
    return message + text.data();
  }
  return message;
}

Outcome select_near(const TriangleMesh& mesh, const Adjacency& adjacency, const std::string& text) {
  const auto point = parse_point(text);
  if (!point) return {{}, "'near:" + text + "' is no point; write near:[x, y, z] with numbers in metres"};
  const auto [nearest, away] = nearest_facet(mesh, adjacency, *point);
  if (nearest < 0) return {{}, "every triangle is degenerate"};
  const double most = near_fraction * diagonal_of(mesh);
  if (!(away <= most)) return {{}, too_far(mesh, adjacency, *point, away, most)};
  // A sliver's normal is rounding: the plane of what it found is better, and finds the rest.
  std::vector<int> found = flat_around(mesh, adjacency, nearest, mesh.area_vector(nearest).normalized());
  Vec3 sum = Vec3::Zero();
  for (const int t : found) sum += mesh.area_vector(t);
  if (sum.norm() > 0.0) found = flat_around(mesh, adjacency, nearest, sum.normalized());
  return {std::move(found), {}};
}

Outcome select(const TriangleMesh& mesh, const Adjacency& adjacency, const std::string& how) {
  auto starts = [&](const char* word) { return how.rfind(word, 0) == 0; };
  if (starts("solid:")) return select_solid(mesh, how.substr(6));
  if (starts("plane:")) return select_plane(mesh, how.substr(6));
  if (starts("near:")) return select_near(mesh, adjacency, how.substr(5));
  return {{}, "'" + how + "' selects nothing; write solid:NAME, plane:x-min (... z-max) or near:[x, y, z]"};
}

}  // namespace

int Patches::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

Patches assign_patches(const TriangleMesh& mesh, const std::vector<PatchSelection>& selections) {
  if (mesh.triangles.empty()) throw GeometryError("error: the surface has no triangles");
  const Adjacency adjacency(mesh);
  Patches patches;
  patches.of_triangle.assign(mesh.triangles.size(), -1);
  std::vector<char> found;  // per name: its selection found triangles
  std::string errors;
  auto complain = [&](const std::string& name, const std::string& what) {
    errors += (errors.empty() ? "error: patch '" : "\nerror: patch '") + name + "': " + what;
  };
  for (const auto& selection : selections) {
    if (patches.find(selection.name) >= 0) {
      complain(selection.name, "this name is used twice");
      continue;
    }
    const int patch = static_cast<int>(patches.names.size());
    patches.names.push_back(selection.name);
    const Outcome chosen = select(mesh, adjacency, selection.select);
    found.push_back(chosen.error.empty());
    if (!chosen.error.empty()) complain(selection.name, chosen.error);
    std::size_t shared = 0;
    int other = -1;
    for (const int t : chosen.triangles) {
      if (patches.of_triangle[t] >= 0) {
        ++shared;
        other = patches.of_triangle[t];
      } else {
        patches.of_triangle[t] = patch;
      }
    }
    if (shared > 0) {
      complain(selection.name, "'" + selection.select + "' overlaps patch '" + patches.names[other] + "' in " +
                                   std::to_string(shared) + " triangles; a triangle belongs to one patch");
    }
  }
  // A solid that bears the name of a selection must be inside it: otherwise its rest would silently join the patch.
  const std::size_t selected = patches.names.size();
  std::vector<std::size_t> left_over(selected, 0);
  for (std::size_t t = 0; t < mesh.triangles.size() && mesh.solids.size() > 1; ++t) {
    const int same_name = patches.of_triangle[t] < 0 ? patches.find(mesh.solids[mesh.solid[t]]) : -1;
    if (same_name >= 0) ++left_over[same_name];
  }
  for (std::size_t p = 0; p < selected; ++p) {
    if (found[p] && left_over[p] > 0) {
      complain(patches.names[p], "the file has a solid of this name with " + std::to_string(left_over[p]) +
                                     " triangles outside the selection; select solid:" + patches.names[p] +
                                     " or give the patch another name");
    }
  }
  if (!errors.empty()) throw GeometryError(errors);

  auto index_of = [&](const std::string& name) {
    const int known = patches.find(name);
    if (known >= 0) return known;
    patches.names.push_back(name);
    return static_cast<int>(patches.names.size()) - 1;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (patches.of_triangle[t] < 0) {
      patches.of_triangle[t] = index_of(mesh.solids.size() > 1 ? mesh.solids[mesh.solid[t]] : "wall");
    }
  }
  return patches;
}

}  // namespace puffin::lbm::geometry
