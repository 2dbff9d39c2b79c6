#include "lbm/scalars/held_faces.hpp"

namespace puffin::lbm {

std::optional<double> fixed_value(const ScalarLaw& law, int patch) {
  return patch < static_cast<int>(law.fixed.size()) ? law.fixed[patch] : std::nullopt;
}

std::vector<HeldFace> held_faces(const ScalarWork& work, const FaceFluxes& fluxes, int d, const ScalarLaw& law) {
  std::vector<HeldFace> held;
  if (law.fixed.empty()) return held;
  for (const auto& face : work.openings[d]) {
    if (fluxes.open[d][face.ghost_is_high ? face.cell : face.ghost] != 2) continue;
    if (const auto value = fixed_value(law, face.patch)) held.push_back({face.cell, face.patch, *value, true, true});
  }
  for (const auto& face : work.held_walls[d])
    if (const auto value = fixed_value(law, face.patch))
      held.push_back({face.cell, face.patch, *value, false, law.wall == WallRule::reflect});
  return held;
}

}  // namespace puffin::lbm
