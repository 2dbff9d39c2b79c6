#pragma once
// Places that a case names and that its geometry does not have.

#include <string>
#include <vector>

#include "cases/surface.hpp"
#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::cases {

/// Listed carriers whose centre lies outside the geometry.
std::vector<Problem> carrier_place_problems(const Case& c, const lbm::geometry::TriangleTree& tree);

/// Besides: probes further than a cell outside, planes, slices and boxes of fields beyond the bounding box. What only
/// the lattice can tell (a plane through solid alone, a line that meets no fluid) is found when the run begins.
/// in: edge of a cell [m], > 0
std::vector<Problem> output_place_problems(const Case& c, const lbm::geometry::TriangleTree& tree, double dx);

/// Patches that carriers meet otherwise than the air does, or leave through for their tag alone; listed carriers that
/// begin deeper in a wall or in each other than a contact goes (10 % of a radius): such an overlap is taken as the
/// shape and pushes nothing.
std::vector<std::string> carrier_place_warnings(const Case& c, const lbm::geometry::TriangleTree& tree);

}  // namespace puffin::cases
