#include "lbm/inlet_gains.hpp"

#include <algorithm>
#include <cmath>

#include "lbm/d3q19.hpp"
#include "lbm/geometry/surface_check.hpp"

namespace puffin::lbm {

using geometry::Vec3;

double gain_of(int direction, const Vec3& u) {
  const auto& c = d3q19::velocity[direction];
  return -6.0 * d3q19::weight[direction] * Vec3(c[0], c[1], c[2]).dot(u);
}

double cubic_gain_of(int direction, const Vec3& u) {
  const auto& c = d3q19::velocity[direction];
  double sum = 0.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (a != b && c[a] != 0) sum += (c[b] == 0 ? 0.0 : -0.5) * c[a] * u[a] * u[b] * u[b];
  if (direction > 6) return sum;
  for (int a = 0; a < 3; ++a) sum += c[a] * u[a] * (u.squaredNorm() - u[a] * u[a]);
  return sum;
}

void scale_inlets(const Rows& rows, const LinkGeometry& surface, const std::vector<InletEdge>& edges, Links& links) {
  // Inlets: the mean speed over the cells of the opening is the one asked for. On a grid that does not fit the opening
  // the cells cover a slightly different area; keeping the speed keeps the dynamic head, to which the pressure drop is
  // proportional (keeping the flow rate instead would put the error of the area twice into the pressure).
  // Where the profile falls to zero at the walls (exact_flow) the sum over the cells is the midpoint rule for the flow
  // rate whatever the fit, and the flow rate is kept.
  links.opening_cells_area.assign(surface.boundaries.size(), 0.0);
  for (std::size_t b = 0; b < surface.boundaries.size(); ++b) {
    const Boundary& boundary = surface.boundaries[b];
    if (boundary.kind != BoundaryKind::velocity_inlet && boundary.kind != BoundaryKind::pressure_outlet) continue;
    Vec3 normal = Vec3::Zero();
    for (std::size_t t = 0; t < surface.patch_of_triangle.size(); ++t)
      if (surface.patch_of_triangle[t] == static_cast<int>(b)) normal += surface.mesh->area_vector(static_cast<int>(t));
    const double patch_area = 0.5 * normal.norm() / (rows.dx() * rows.dx());
    normal.normalize();
    double gain = 0.0, speed = 0.0, area = 0.0, faces = 0.0;
    for (const InletEdge& edge : edges)
      if (edge.inlet == static_cast<int>(b)) gain += edge.own;
    for (const auto* list : {&links.inlets, &links.outlets})
      for (const auto& link : *list) {
        if (link.patch != static_cast<int>(b)) continue;
        gain += link.gain;
        if (link.direction > 6) continue;  // faces of cells alone make up the area
        const auto& c = d3q19::velocity[link.direction];
        const double face = std::abs(normal.dot(Vec3(c[0], c[1], c[2])));
        area += face, faces += 1.0;
        if (boundary.profile) speed -= face * normal.dot(boundary.profile(rows.centre(link.slot)));
      }
    links.opening_cells_area[b] = area;
    if (faces == 0.0)
      throw geometry::GeometryError("the opening '" + boundary.patch +
                                    "' touches no cell of the fluid; dx is too large for it");
    if (boundary.kind != BoundaryKind::velocity_inlet) continue;
    if (!(gain > 0.0) || !(speed > 0.0))
      throw geometry::GeometryError("the profile of the inlet '" + boundary.patch + "' does not point into the fluid");
    // The mean of the profile over the cells is brought to 1, then the links to the flow of all cells at that mean.
    const double scale = (boundary.exact_flow ? patch_area : area) / gain;
    for (auto& link : links.inlets)
      if (link.patch == static_cast<int>(b)) link.gain *= scale, link.cubic *= scale * scale * scale;
    for (const InletEdge& edge : edges) {
      if (edge.inlet != static_cast<int>(b)) continue;
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
}

}  // namespace puffin::lbm
