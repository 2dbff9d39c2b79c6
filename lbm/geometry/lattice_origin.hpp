#pragma once
// Where the lattice lies within a surface: so that most of its flat faces are faces of cells.

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Share of a cell, in [0, 1), by which the first face of cells lies below the low end of the surface along `axis`.
///
/// Of all planes of triangles across the axis, those that are a whole number of cells apart are taken together, and the
/// set with the largest area [m^2] is to lie on faces of cells; the one that holds the low end, with 0, unless another
/// is larger by a hundredth. Places count as equal within 1e-3 dx. 0 if there are no such triangles.
double lattice_shift(const TriangleTree& tree, double dx, int axis);

}  // namespace puffin::lbm::geometry
