#include "cases/frozen_ways.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cases/untagged_openings.hpp"

namespace puffin::cases {

Case with_open_patches(Case c, const Surface& surface) {
  if (c.carriers && c.carriers->outside == Outside::bounce) return c;
  for (const std::string& name : surface.patches.names) {
    if (!is_open_unsaid(c, name)) continue;
    Boundary open;
    open.patch = name;
    open.type = BoundaryType::pressure_outlet;
    c.air.boundaries.push_back(open);
  }
  return c;
}

std::vector<std::string> closed_ways(const Case& c, const Surface& surface, double speed,
                                     const std::function<Vec3(const Vec3&)>& field) {
  constexpr double harmless = 0.05;
  std::vector<double> passes(surface.patches.names.size(), 0.0), area = passes;
  for (int t = 0; t < static_cast<int>(surface.mesh.triangles.size()); ++t) {
    const Vec3 outwards = 0.5 * surface.mesh.area_vector(t);
    const Vec3 middle = (surface.mesh.corner(t, 0) + surface.mesh.corner(t, 1) + surface.mesh.corner(t, 2)) / 3.0;
    passes[surface.patches.of_triangle[t]] += std::abs(outwards.dot(field(middle)));
    area[surface.patches.of_triangle[t]] += outwards.norm();
  }
  std::vector<std::string> texts;
  for (std::size_t p = 0; p < passes.size(); ++p) {
    const std::string& name = surface.patches.names[p];
    const bool opens = std::any_of(c.air.boundaries.begin(), c.air.boundaries.end(), [&](const Boundary& b) {
      return (b.patch == name || b.with == name) && b.type != BoundaryType::wall &&
             b.type != BoundaryType::moving_wall && b.type != BoundaryType::slip;
    });
    if (opens || !(passes[p] > harmless * speed * area[p])) continue;
    char text[320];
    std::snprintf(
        text, sizeof text,
        "air.field blows through the patch '%s' (%.3g m/s, mean), which is closed: where fines come there the "
        "run ends; give it an [[air.boundary]]: \"periodic\" in a pair, \"pressure-outlet\" or "
        "\"velocity-inlet\"",
        name.c_str(), passes[p] / area[p]);
    texts.push_back(text);
  }
  return texts;
}

}  // namespace puffin::cases
