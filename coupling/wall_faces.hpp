#pragma once
// Which patch of the walls a closed face of a cell belongs to.

#include <array>
#include <vector>

#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/rows.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::coupling {

/// [d] the closed faces whose wall bears a patch with wanted[patch] = 1, in the order of their cells. The wall of a
/// face is the triangle nearest to its centre within two cells; of those as near to a thousandth of a cell, the one
/// that the face looks at most. `opening`, `patch_of`: per triangle; openings and triangles of no patch (-1) count as
/// none.
std::array<std::vector<lbm::ScalarWork::WallFace>, 3> find_wall_faces(
    const lbm::Rows& rows, const lbm::FaceFluxes& fluxes, const lbm::geometry::TriangleTree& tree,
    const std::vector<char>& opening, const std::vector<int>& patch_of, const std::vector<char>& wanted);

}  // namespace puffin::coupling
