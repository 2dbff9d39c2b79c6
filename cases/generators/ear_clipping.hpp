#pragma once
// Triangulates a plane polygon with holes.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace puffin::cases::generators {

/// Triangles of the polygon loops[0] without the holes loops[1...], as indices into `points`. loops[0] runs
/// counter-clockwise, the holes clockwise; no other corners are used and every corner is used, also those inside a
/// straight side, so that the triangles conform to their neighbours. All triangles are counter-clockwise and none has
/// zero area.
/// Source: two-ears theorem (Meisters 1975); holes joined by bridges between mutually visible corners. Cost O(n^3) at
/// worst, for the few hundred corners of a face.
/// Throws std::logic_error if the loops cross themselves or each other.
std::vector<std::array<int, 3>> triangulate(const std::vector<Eigen::Vector2d>& points,
                                            const std::vector<std::vector<int>>& loops);

}  // namespace puffin::cases::generators
