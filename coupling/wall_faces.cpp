#include "coupling/wall_faces.hpp"

#include <cstddef>

namespace puffin::coupling {

std::array<std::vector<FaceOfWall>, 3> find_wall_faces(const lbm::Air& air, const lbm::FaceFluxes& fluxes,
                                                       const std::vector<FinesDrift::WallCell>& walls,
                                                       const std::vector<int>& patch_of,
                                                       const std::vector<char>& wanted) {
  std::array<std::vector<FaceOfWall>, 3> faces;
  for (std::size_t first = 0, end = 0; first < walls.size(); first = end) {
    const FinesDrift::WallCell& cell = walls[first];
    while (end < walls.size() && walls[end].slot == cell.slot) ++end;
    if (!air.is_fluid(cell.slot)) continue;
    for (int d = 0; d < 3; ++d)
      for (const bool high : {false, true}) {
        if (fluxes.open[d][high ? cell.slot : cell.low[d]] != 0) continue;
        const auto sees = [&](const FinesDrift::WallCell& wall) { return high ? wall.outward[d] : -wall.outward[d]; };
        const FinesDrift::WallCell* best = &cell;
        for (std::size_t n = first; n < end; ++n)
          if (sees(walls[n]) > sees(*best)) best = &walls[n];
        const int patch = sees(*best) > 0.0 ? patch_of[static_cast<std::size_t>(best->triangle)] : -1;
        if (patch >= 0 && wanted[static_cast<std::size_t>(patch)])
          faces[d].push_back({{cell.slot, patch, high}, best->triangle});
      }
  }
  return faces;
}

}  // namespace puffin::coupling
