#pragma once
// What a drawing needs of the walls: extent, edges, measures.

#include <string>
#include <vector>

#include "tools/output/frames.hpp"
#include "tools/output/picture/scene.hpp"

namespace puffin::output {

inline Vec3 point_of(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

struct Extent {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};
Extent extent_of(const WallFrame& walls);

/// The edges worth drawing: creases of more than 25 degrees, borders between patches, and open edges.
std::vector<SceneEdge> outline_of(const WallFrame& walls, const Colour& colour, float width, float opacity);

struct PatchMeasure {
  double area = 0.0;           // [m^2]
  Vec3 middle = Vec3::Zero();  // centre of area [m]
};
std::vector<PatchMeasure> measures_of(const WallFrame& walls);

/// Enclosed volume [m^3]: one third of the surface integral of x . n.
double volume_of(const WallFrame& walls);

/// Where the plane (axis, at) cuts the triangles: pairs of points.
std::vector<std::array<Vec3, 2>> cut_of(const WallFrame& walls, int axis, double at);

}  // namespace puffin::output
