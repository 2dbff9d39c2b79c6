#include "cases/surface.hpp"

#include <algorithm>

#include "cases/generators/generators.hpp"
#include "lbm/geometry/repair.hpp"
#include "lbm/geometry/stl.hpp"

namespace puffin::cases {
namespace {

namespace geometry = lbm::geometry;

geometry::TriangleMesh mesh_of(const Geometry& g) {
  if (const auto* stl = std::get_if<StlFile>(&g.source)) return geometry::read_stl(stl->file, stl->unit);
  const auto& generated = std::get<Generated>(g.source);
  return generate(generated.kind, generated.parameters);
}

/// Every patch that the case names.
std::vector<std::string> named_patches(const Case& c) {
  std::vector<std::string> names = c.output.forces;
  for (const Boundary& b : c.air.boundaries) names.insert(names.end(), {b.patch, b.with});
  if (c.fines)
    for (const ScalarBoundary& b : c.fines->boundaries) names.push_back(b.patch);
  if (c.carriers && c.carriers->fill)
    if (const auto* patch = std::get_if<std::string>(&c.carriers->fill->at)) names.push_back(*patch);
  return names;
}

/// The tags of the case, and those of the faces of the bounding box that it names without having tagged them.
std::vector<geometry::PatchSelection> selections_of(const Case& c, const geometry::TriangleMesh& mesh) {
  std::vector<geometry::PatchSelection> selections;
  std::vector<std::string> known = mesh.solids;
  for (const Patch& p : c.geometry.patches) {
    selections.push_back({p.name, p.select});
    known.push_back(p.name);
  }
  const std::vector<std::string> named = named_patches(c);
  const auto has = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (const std::string& face : box_faces)
    if (has(named, face) && !has(known, face)) selections.push_back({face, "plane:" + face});
  return selections;
}

/// A surface that is sound but for facets that stand twice is taken without the copies, with a warning. Another fault
/// is told of the surface as it was given.
void leave_out_copies(bool self_intersections, Surface& s) {
  const auto fatal = [](const geometry::Defect& d) { return d.fatal; };
  const auto is_copy = [](const geometry::Defect& d) { return d.fatal && d.kind == "duplicate facet"; };
  const auto copies = std::find_if(s.defects.begin(), s.defects.end(), is_copy);
  if (copies == s.defects.end()) return;
  geometry::TriangleMesh single = s.mesh;
  const std::size_t removed = geometry::remove_copies(single).count;
  std::vector<geometry::Defect> left = geometry::check_surface(single, self_intersections);
  if (std::any_of(left.begin(), left.end(), fatal)) return;
  geometry::Defect told = *copies;
  told.fatal = false;
  told.count = removed;
  told.message = std::to_string(removed) + " facets stand more than once, the first around " +
                 geometry::place_text(told.where.front()) + ": the copies are left out";
  left.push_back(told);
  s.mesh = std::move(single);
  s.defects = std::move(left);
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
  leave_out_copies(self_intersections, s);
  refuse_fatal(s.defects);
  s.patches = geometry::assign_patches(s.mesh, selections_of(c, s.mesh));
  s.volume = geometry::enclosed_volume(s.mesh);
  s.area = geometry::surface_area(s.mesh);
  return s;
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

std::vector<std::string> slip_patches_of(const Case& c) {
  std::vector<std::string> names;
  for (const Boundary& b : c.air.boundaries)
    if (b.type == BoundaryType::slip) names.push_back(b.patch);
  return names;
}

}  // namespace puffin::cases
