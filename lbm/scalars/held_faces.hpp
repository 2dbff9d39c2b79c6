#pragma once
// Faces behind which a concentration is held, on openings and on walls, half a cell from the centre of their cell.

#include <cstddef>
#include <optional>
#include <vector>

#include "lbm/scalars/face_fluxes.hpp"
#include "lbm/scalars/scalar_fields.hpp"

namespace puffin::lbm {

struct HeldFace {
  std::ptrdiff_t cell = 0;
  int patch = 0;
  double value = 0.0;    // amount per lattice mass of air, as ScalarLaw::fixed
  bool opening = false;  // else a wall: what it takes is booked as absorbed
  bool takes = true;     // false on absorbing walls, whose closed faces take by themselves
};

/// What is held on a patch, if anything.
std::optional<double> fixed_value(const ScalarLaw& law, int patch);

/// Those of direction d for one scalar, openings first. Time: in the number of faces of openings and held walls.
std::vector<HeldFace> held_faces(const ScalarWork& work, const FaceFluxes& fluxes, int d, const ScalarLaw& law);

}  // namespace puffin::lbm
