#pragma once
// Mass fluxes of a field of velocity that is given and does not change.

#include <Eigen/Core>
#include <functional>

#include "coupling/scale.hpp"
#include "lbm/mass_fluxes.hpp"

namespace puffin::coupling {

/// Through each face that `fluxes` has open: velocity at the face's centre, normal to it, times dt/dx; density 1.
/// A field without divergence whose component in a direction does not vary in that direction (uniform, shear,
/// solid-body rotation about an axis of the grid) gives fluxes that balance in every cell without a closed face.
/// velocity: [m/s] at a place [m]. fluxes, routes: as lbm::find_routes left them.
void set_frozen_fluxes(const lbm::Rows& rows, const lbm::FluxRoutes& routes, const Scale& scale,
                       const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& velocity, lbm::FaceFluxes& fluxes);

}  // namespace puffin::coupling
