#pragma once
// Fines that do not quite follow the air: their drift through it, and what of it ends on walls.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "coupling/scale.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "lbm/mass_fluxes.hpp"
#include "lbm/moments.hpp"
#include "lbm/rows.hpp"

namespace puffin::coupling {

/// tau = rho d^2 C_c/(18 mu) [s], C_c = 1 + Kn (1.257 + 0.4 exp(-1.1/Kn)), Kn = 2 lambda/d, lambda = 0.067 um
/// (Cunningham; Davies 1945). in: diameter [m], density of the fines [kg/m^3], viscosity of the air [Pa s].
double response_time(double diameter, double density, double viscosity);

/// Velocity of fines of small inertia: u_f = u - tau Du/Dt + tau g, to first order in tau.
/// Source: J. Ferry & S. Balachandar, Int. J. Multiph. Flow 27, 1199 (2001). Valid for Stokes numbers (tau over the
/// time in which the air turns) below about 0.2: the errors beyond have not been measured.
///
/// On the lattice Du/Dt is taken as (-grad p + f)/rho, f being the force of carriers on the air and the body force: it
/// differs by the viscous force alone. The drift follows its cause with the delay tau, so that sound does not move the
/// fines.
struct FinesDrift {
  double response_time = 0.0;                         // tau [s]
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // [m/s^2]
  bool deposits = false;                              // walls take what drifts into them, else they hold it off
  /// A cell, and the slots of its neighbours in -x, -y, -z.
  struct Place {
    std::ptrdiff_t slot = 0;
    std::array<std::ptrdiff_t, 3> low{};
  };
  /// A cell with a closed face: where its wall is, and how much of it [dx^2]: the sum over the closed faces of the part
  /// that looks along the wall's normal, so that the cells' areas add up to that of the true surface.
  struct WallCell : Place {
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();
    double area = 0.0;
    int triangle = -1;
    // The cell 1.5 dx from this one's centre, away from the wall; itself where there is none, or where a wall lies
    // within 0.6 dx of it: nearer than rounding to a cell can bring the own one, so another wall of a narrow gap.
    Place inside;
  };
  std::vector<WallCell> walls;
};

/// Drift velocity [m/s] by direction and slot.
using DriftVelocity = std::array<std::vector<double>, 3>;

/// Cells with closed faces; each face with the wall within two cells that it looks at most. A corner cell has several
/// entries, the nearest wall first; cells that see only openings are left out. `opening`: per triangle, 1: no wall.
std::vector<FinesDrift::WallCell> find_wall_cells(const lbm::Rows& rows, const lbm::FaceFluxes& fluxes,
                                                  const lbm::geometry::TriangleTree& tree,
                                                  const std::vector<char>& opening);

/// What pushes the air beside its pressure and its walls, per volume of air in lattice units.
struct ForceOnAir {
  std::array<double, 3> everywhere{0, 0, 0};
  const lbm::BodyForce* carriers = nullptr;  // null: none
};

/// The drift `seconds` later: v <- v + (1 - exp(-seconds/tau)) (tau ((grad p - f)/rho + g) - v), from the lattice's
/// density, with f halfway between the cells as the gradient is: a force that pressure balances moves nothing.
/// A cell beside a closed face takes gradient and force one face further inside: its own density carries the steps of
/// a staircase of cells, of some per cent of the dynamic pressure.
/// An empty `velocity` starts at rest.
void update_drift(const lbm::Rows& rows, const lbm::FaceFluxes& fluxes, const ForceOnAir& force, const Scale& scale,
                  const FinesDrift& drift, double seconds, DriftVelocity& velocity);

/// The drift in a frozen field: tau (g - (u . grad) u), by central differences over half a cell.
void set_frozen_drift(const lbm::Rows& rows, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& air,
                      const FinesDrift& drift, DriftVelocity& velocity);

/// Sets the drift through the open faces (openings have the air's flux alone), and the sinks of the walls:
/// rate = max(v . n, 0) area.
///
/// Of v the part that the air's turning causes is taken from the cell `inside`, times (u/u_inside)^2 <= 1: normal to a
/// wall the air turns as u^2 times its curvature, and slower air beside the wall throws less at it. What the drift
/// carries into that layer and the wall does not take, stays there until the air takes it away. (Fines do not cross the
/// layer at the speed of the flow outside: they forget it within tau times the drift, some micrometres, of a layer of
/// 100.)
void add_drift(const lbm::Rows& rows, const lbm::FluxRoutes& routes, const Scale& scale, const FinesDrift& drift,
               const DriftVelocity& velocity, lbm::FaceFluxes& fluxes);

}  // namespace puffin::coupling
