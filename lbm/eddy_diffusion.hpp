#pragma once
// What the eddies that the cells do not resolve do to a scalar.

#include <vector>

#include "lbm/air.hpp"
#include "lbm/scalars/face_fluxes.hpp"

namespace puffin::lbm {

/// Smagorinsky's eddy viscosity nu_t = (tau - tau0)/3 at every active slot between two steps,
/// 2 tau = tau0 + sqrt(tau0^2 + 18 sqrt2 L^2 |Pi|/rho) as in the collision (twice_tau in collision.hpp), from the
/// stress that has arrived; 0 without large-eddy simulation. Lattice units. Not for other eddy viscosities.
void find_eddy_viscosity(const Air& air, double tau0, std::vector<double>& viscosity);

/// FaceFluxes::eddy at the open faces: the mean of the two cells' nu_t over a turbulent Schmidt number (0.7 to 0.9 in
/// shear flows: Reynolds, Int. J. Heat Mass Transf. 18, 1055 (1975)).
void find_eddy_diffusion(const Air& air, double tau0, double schmidt, FaceFluxes& fluxes);

}  // namespace puffin::lbm
