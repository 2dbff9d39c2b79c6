#pragma once
// Faces inside the fluid, found without cells: for runs that have none.

#include <cstddef>
#include <vector>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Places of the surface with fluid on both sides, among places spread evenly over it.
struct BuriedPlaces {
  std::vector<Vec3> where;  // [m]
  std::size_t asked = 0;
};

/// Asks 20,000 places, each for an equal part of the area: s across, a buried face that is much wider is met. As by
/// cells of s (hidden_faces): fluid must be on both sides a thousandth of s away (so walls thinner than s are none),
/// and half of s away (so the strip between two walls that all but coincide, as at the seams of exports, is none); and
/// closer than a thousandth (the tip of a wedge is none). `openings`: per triangle 1 = part of an opening, which is not
/// asked; empty: none. Cost: two winding numbers for a place that is not buried.
BuriedPlaces buried_places(const TriangleTree& tree, const std::vector<char>& openings = {});

/// Throws GeometryError with the first place and a remedy if there are two or more.
void refuse_buried(const BuriedPlaces& places);

}  // namespace puffin::lbm::geometry
