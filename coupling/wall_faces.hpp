#pragma once
// Which patch of the walls a closed face of a cell belongs to.

#include <array>
#include <vector>

#include "coupling/fines_drift.hpp"
#include "lbm/air.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::coupling {

/// A closed face of a fluid cell, and the wall's triangle that it looks at most.
struct FaceOfWall {
  lbm::ScalarWork::WallFace face;
  int triangle = -1;
};

/// [d] the closed faces of fluid cells whose wall bears a patch with wanted[patch] = 1, in the order of their cells; of
/// the walls beside a cell (find_wall_cells) a face belongs to the one that it looks at most, none that it turns its
/// back to. patch_of: per triangle, -1: no patch. Cells behind immersed walls have none.
std::array<std::vector<FaceOfWall>, 3> find_wall_faces(const lbm::Air& air, const lbm::FaceFluxes& fluxes,
                                                       const std::vector<FinesDrift::WallCell>& walls,
                                                       const std::vector<int>& patch_of,
                                                       const std::vector<char>& wanted);

}  // namespace puffin::coupling
