#include "coupling/frozen_fluxes.hpp"

#include <algorithm>

namespace puffin::coupling {

void set_frozen_fluxes(const lbm::Rows& rows, const lbm::FluxRoutes& routes, const Scale& scale,
                       const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& velocity,
                       lbm::FaceFluxes& fluxes) {
  std::fill(fluxes.density.begin(), fluxes.density.end(), 1.0);
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d to_face = 0.5 * rows.dx() * Eigen::Vector3d::Unit(d);
    for (std::size_t n = 0; n < rows.slots(); ++n) {
      const auto slot = static_cast<std::ptrdiff_t>(n);
      const bool stored = rows.is_active(slot) || rows.is_ghost(slot);
      const bool passes = fluxes.open[d][n] == 1 || fluxes.open[d][n] == 2;
      fluxes.mass[d][n] = stored && passes ? scale.velocity_lu(velocity(rows.centre(slot) + to_face)[d]) : 0.0;
    }
    for (const auto& image : routes.images) fluxes.mass[d][image.ghost] = fluxes.mass[d][image.active];
  }
}

}  // namespace puffin::coupling
