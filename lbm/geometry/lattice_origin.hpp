#pragma once
// Where the lattice lies within a surface: so that most of its flat faces are faces of cells.

#include <vector>

#include "lbm/geometry/triangle_tree.hpp"

namespace puffin::lbm::geometry {

/// Share of a cell, in [0, 1), by which the first face of cells lies below the low end of the surface along `axis`.
///
/// Planes of triangles across the axis that are a whole number of cells apart count together, with their area; others
/// with less of theirs the farther they are off, none from 0.02 dx on. The largest such set comes to lie on faces of
/// cells. The low end wins against sets that are not larger by a hundredth, and where no set is a fiftieth of the
/// surface. `flush`: per triangle, 1 = alone decides where there are such along the axis; empty: none.
double lattice_shift(const TriangleTree& tree, double dx, int axis, const std::vector<char>& flush = {});

}  // namespace puffin::lbm::geometry
