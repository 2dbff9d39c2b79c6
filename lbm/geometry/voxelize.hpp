#pragma once
// From triangles to cells: which cell centres lie inside the surface.

#include <array>
#include <cstddef>
#include <vector>

#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/geometry/voxels.hpp"

namespace puffin::lbm::geometry {

struct VoxelizeOptions {
  std::array<bool, 3> periodic{false, false, false};  // the box in these directions is a whole number of cells
  std::vector<char> openings;                         // per triangle: 1 = part of an opening; empty: keep every cell
  std::vector<char> flush;                            // per triangle: 1 = should be faces of cells; empty: none
  std::size_t most_cells = std::size_t{1} << 32;      // refuse boxes with more cells than this
};

/// Fluid cells that no opening reaches and that were therefore turned solid.
struct Pockets {
  std::size_t count = 0;    // connected pockets
  std::size_t cells = 0;    // cells in them
  std::vector<Vec3> where;  // [m] a cell centre of each, largest pocket first, at most 1000
};

/// Voxels of the volume enclosed by the tree's mesh. The box covers the bounding box; along each axis most of the
/// surface's flat faces are faces of cells (lattice_origin.hpp), along a periodic one the ends. A cell is fluid if
/// |winding number| > 1/2 at its centre. A centre on the surface, to within the rounding of single precision
/// coordinates, belongs to the side towards +x, +y, +z.
///
/// Method: for a closed mesh the winding number along a row of cells is the signed count of the crossings of the row
/// with triangles. Whether a row crosses a triangle is decided exactly: vertices and rows are moved to a lattice of
/// 2^-40 of the box and the orientations evaluated in 128-bit integers, ties broken by an infinitesimal shift of the
/// row (Edelsbrunner & Muecke 1990), so no crossing is lost or counted twice on shared edges and vertices. A mesh
/// with holes or turned facets is closed by caps first, whose own winding number is taken off again near them
/// (closing_caps.hpp), so that the generalised winding number of the given triangles decides.
///
/// Throws std::invalid_argument for dx <= 0, a box beyond most_cells, openings or flush of the wrong length, or a
/// periodic direction whose box is no whole number of cells (the nearest valid dx is named); GeometryError if no centre
/// is inside or an opening is given and no fluid cell lies at any.
Voxels voxelize(const TriangleTree& tree, double dx, const VoxelizeOptions& options = {}, Pockets* dropped = nullptr);

/// Turns fluid cells solid that are not connected (through faces; across periodic faces too) to a fluid cell within one
/// dx of an opening triangle that is nearer to it than any other triangle. Called by voxelize if openings are given.
Pockets drop_pockets(const TriangleTree& tree, const VoxelizeOptions& options, Voxels& voxels);

}  // namespace puffin::lbm::geometry
