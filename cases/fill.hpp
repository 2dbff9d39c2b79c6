#pragma once
// The dose that [carriers.fill] asks for, in the geometry of its case.

#include "cases/dose.hpp"
#include "cases/surface.hpp"
#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::cases {

/// in: a case with a fill; its surface and the tree of that surface's triangles. A settled dose is given as it is
/// before it falls. Throws as place_dose, and std::invalid_argument if the patch of `at` has no face to lie on.
Dose dose_of(const Case& described, const Surface& surface, const lbm::geometry::TriangleTree& tree);

}  // namespace puffin::cases
