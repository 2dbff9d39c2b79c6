#pragma once
// Which cells the lattice computes: those whose centre lies in the fluid, and what a wall scheme wants beside them.
//
// The sharp walls (bouzidi, halfway) want no others. Partially saturated cells (psm.hpp) want every cell that is fluid
// in part; markers (markers.hpp) want a band of live cells behind the wall, deep enough for their kernels.

#include <array>
#include <cstdint>
#include <vector>

#include "lbm/geometry/voxels.hpp"
#include "lbm/links.hpp"

namespace puffin::lbm {

struct ActiveCells {
  geometry::Voxels computed;  // the computed cells
  geometry::Voxels inside;    // of the same box: those whose centre lies in the fluid
  /// Partially saturated cells: the computed cells that are solid in part, and their share; sorted by cell.
  struct Partial {
    std::int64_t cell = 0;  // Voxels::index
    float solid = 0.0F;
  };
  std::vector<Partial> partial{};

  /// Solid share of a computed cell; 0 without partially saturated cells.
  float solid(std::int64_t cell) const;
};

/// The same cells in a box with `margin` more cells on every side that is not periodic.
geometry::Voxels padded(const geometry::Voxels& voxels, int margin, const std::array<bool, 3>& periodic);

/// Adds the cells behind the walls whose centre is less than `depth` cells from them. Cells beyond an opening do not
/// belong: an opening ends the band as it ends the fluid. The box grows by the depth.
ActiveCells with_band(const geometry::Voxels& voxels, const LinkGeometry& surface, double depth,
                      const std::array<bool, 3>& periodic);

/// Adds the cells that are fluid in part though their centre is not; gives the solid share of all
/// (geometry/solid_fraction.hpp). Cells with less than `least` of fluid are left out.
ActiveCells with_cut_cells(const geometry::Voxels& voxels, const LinkGeometry& surface, double least);

}  // namespace puffin::lbm
