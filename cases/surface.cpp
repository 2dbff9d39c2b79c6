#include "cases/surface.hpp"

#include <algorithm>

#include "cases/generators/generators.hpp"
#include "cases/spelling.hpp"
#include "lbm/geometry/stl.hpp"

namespace puffin::cases {
namespace {

namespace geometry = lbm::geometry;

geometry::TriangleMesh mesh_of(const Geometry& g) {
  if (const auto* stl = std::get_if<StlFile>(&g.source)) return geometry::read_stl(stl->file, stl->unit);
  const auto& generated = std::get<Generated>(g.source);
  return generate(generated.kind, generated.parameters);
}

void refuse_fatal(const std::vector<geometry::Defect>& defects) {
  std::string text;
  for (const geometry::Defect& d : defects)
    if (d.fatal) text += (text.empty() ? "" : "\n") + d.kind + ": " + d.message;
  if (!text.empty()) throw geometry::GeometryError(text);
}

}  // namespace

double Surface::area_of(const std::string& patch) const {
  const int wanted = patches.find(patch);
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (patches.of_triangle[t] == wanted) sum += mesh.area(static_cast<int>(t));
  return wanted < 0 ? 0.0 : sum;
}

std::vector<char> Surface::marked(const std::vector<std::string>& names) const {
  std::vector<char> marks(mesh.triangles.size(), 0);
  for (const std::string& name : names) {
    const int wanted = patches.find(name);
    for (std::size_t t = 0; t < marks.size(); ++t)
      if (wanted >= 0 && patches.of_triangle[t] == wanted) marks[t] = 1;
  }
  return marks;
}

Surface load_surface(const Case& c, bool self_intersections) {
  Surface s;
  s.mesh = mesh_of(c.geometry);
  s.defects = geometry::check_surface(s.mesh, self_intersections);
  refuse_fatal(s.defects);
  std::vector<geometry::PatchSelection> selections;
  for (const Patch& p : c.geometry.patches) selections.push_back({p.name, p.select});
  s.patches = geometry::assign_patches(s.mesh, selections);
  s.volume = geometry::enclosed_volume(s.mesh);
  s.area = geometry::surface_area(s.mesh);
  return s;
}

std::vector<Problem> unknown_patches(const Case& c, const geometry::Patches& patches) {
  std::vector<Problem> problems;
  const auto need = [&](const std::string& key, const std::string& name) {
    if (name.empty() || patches.find(name) >= 0) return;
    const std::string near = nearest(name, patches.names);
    const std::string hint = near.empty() ? "the patches are " + join(patches.names) : "did you mean '" + near + "'?";
    problems.push_back({c.name, 0, 0, key, key + ": there is no patch '" + name + "'; " + hint});
  };
  for (std::size_t i = 0; i < c.air.boundaries.size(); ++i) {
    const std::string key = "air.boundary[" + std::to_string(i) + "]";
    need(key + ".patch", c.air.boundaries[i].patch);
    need(key + ".with", c.air.boundaries[i].with);
  }
  if (c.carriers && c.carriers->fill)
    if (const auto* patch = std::get_if<std::string>(&c.carriers->fill->at)) need("carriers.fill.at", *patch);
  for (const std::string& patch : c.output.forces) need("output.force", patch);
  if (c.fines)
    for (const ScalarBoundary& b : c.fines->boundaries) need("fines.boundary", b.patch);
  return problems;
}

std::vector<std::string> openings_of(const Case& c) {
  std::vector<std::string> names;
  for (const Boundary& b : c.air.boundaries) {
    const bool passes = b.type == BoundaryType::velocity_inlet || b.type == BoundaryType::pressure_outlet ||
                        b.type == BoundaryType::periodic;
    if (!passes) continue;
    names.push_back(b.patch);
    if (!b.with.empty()) names.push_back(b.with);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace puffin::cases
