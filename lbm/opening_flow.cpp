#include "lbm/opening_flow.hpp"

#include <algorithm>
#include <cmath>

#include "lbm/d3q19.hpp"
#include "lbm/geometry/surface_check.hpp"

namespace puffin::lbm {

using geometry::Vec3;

namespace {

/// An opening, or one face of several.
struct Face {
  std::int16_t patch = 0, part = 0;
  Vec3 normal = Vec3::Zero();
  double area = 0.0;  // [dx^2]
  double share = 1.0;
  bool has(const OpeningLink& link) const { return link.patch == patch && link.part == part; }
  bool has(const InletEdge& edge) const { return edge.inlet == patch && edge.part == part; }
};

std::vector<Face> faces_of(const LinkGeometry& surface, std::size_t b, double dx) {
  const auto patch = static_cast<std::int16_t>(b);
  std::vector<Face> faces;
  if (const auto& parts = surface.boundaries[b].parts) {
    for (std::size_t p = 0; p < parts->area.size(); ++p)
      faces.push_back(
          {patch, static_cast<std::int16_t>(p), parts->normal[p], parts->area[p] / (dx * dx), parts->share[p]});
    return faces;
  }
  Vec3 normal = Vec3::Zero();
  for (std::size_t t = 0; t < surface.patch_of_triangle.size(); ++t)
    if (surface.patch_of_triangle[t] == patch) normal += surface.mesh->area_vector(static_cast<int>(t));
  const double area = 0.5 * normal.norm() / (dx * dx);
  normal.normalize();
  return {{patch, 0, normal, area, 1.0}};
}

/// How the message calls it.
std::string name_of(const Face& face, const Boundary& boundary, const char* what) {
  const std::string name = std::string(what) + " '" + boundary.patch + "'";
  return boundary.parts ? "face " + std::to_string(face.part + 1) + " of " + name : name;
}

/// On the cells.
struct Sums {
  double gain = 0.0, speed = 0.0, area = 0.0, faces = 0.0;
};

Sums sums_of(const Face& face, const Rows& rows, const Boundary& boundary, const std::vector<InletEdge>& edges,
             const Links& links) {
  Sums sums;
  for (const InletEdge& edge : edges)
    if (face.has(edge)) sums.gain += edge.own;
  for (const auto* list : {&links.inlets, &links.outlets})
    for (const auto& link : *list) {
      if (!face.has(link)) continue;
      sums.gain += link.gain;
      if (link.direction > 6) continue;  // faces of cells alone make up the area
      const auto& c = d3q19::velocity[link.direction];
      const double of_cell = std::abs(face.normal.dot(Vec3(c[0], c[1], c[2])));
      sums.area += of_cell, sums.faces += 1.0;
      if (boundary.profile) sums.speed -= of_cell * face.normal.dot(boundary.profile(rows.centre(link.slot)));
    }
  return sums;
}

/// Brings the links to the flow of all cells at the face's share of the mean speed.
void scale_links(const Face& face, double scale, const std::vector<InletEdge>& edges, Links& links) {
  for (auto& link : links.inlets)
    if (face.has(link)) link.gain *= scale, link.cubic *= scale * scale * scale;
  for (const InletEdge& edge : edges) {
    if (!face.has(edge)) continue;
    for (auto at = std::lower_bound(links.inlets.begin(), links.inlets.end(), edge.slot,
                                    [](const OpeningLink&link, std::ptrdiff_t slot) { return link.slot < slot; });
         at != links.inlets.end() && at->slot == edge.slot; ++at) {
      if (at->direction != edge.face) continue;
      at->gain += scale * edge.own;
      at->wall_gain -= edge.carried;
      at->wall = edge.wall;  // all walls that slide have one speed on the lattice
    }
  }
}

}  // namespace

void set_inlet_flow(const Rows& rows, const LinkGeometry& surface, const std::vector<InletEdge>& edges, Links& links) {
  links.opening_cells_area.assign(surface.boundaries.size(), 0.0);
  for (std::size_t b = 0; b < surface.boundaries.size(); ++b) {
    const Boundary& boundary = surface.boundaries[b];
    const bool inlet = boundary.kind == BoundaryKind::velocity_inlet;
    if (!inlet && boundary.kind != BoundaryKind::pressure_outlet) continue;
    const std::vector<Face> faces = faces_of(surface, b, rows.dx());
    double whole = 0.0;
    for (const Face& face : faces) whole += face.area;
    for (const Face& face : faces) {
      const Sums sums = sums_of(face, rows, boundary, edges, links);
      links.opening_cells_area[b] += sums.area * face.share;
      if (sums.faces == 0.0 && face.area < 0.01 * whole) continue;  // a stray strip
      if (sums.faces == 0.0)
        throw geometry::GeometryError(name_of(face, boundary, "the opening") +
                                      " touches no cell of the fluid; dx is too large for it");
      if (!inlet) continue;
      if (!(sums.gain > 0.0) || !(sums.speed > 0.0))
        throw geometry::GeometryError("the profile of " + name_of(face, boundary, "the inlet") +
                                      " does not point into the fluid");
      scale_links(face, (boundary.exact_flow ? face.area : sums.area) * face.share / sums.gain, edges, links);
    }
  }
}

}  // namespace puffin::lbm
