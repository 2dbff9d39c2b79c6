#pragma once
// How fast a lattice may be that is to answer pressures hardly with its density.
//
// The lattice's air is weakly compressible: p = rho c_s^2, so a pressure difference dp changes the density by
//   d(rho)/rho = 3 dp/rho (u_lb/U)^2,
// and where mass passes sections of different density, speeds differ by as much. Of turbulent flows dp is a few times
// rho U^2 and the change a few u_lb^2. Slow, viscous flows want far more: friction alone is 8 mu U/D on every wall.

#include <string>

#include "cases/case.hpp"
#include "cases/surface.hpp"

namespace puffin::cases {

/// The speed in lattice units at which a run is started.
struct LatticeSpeed {
  double value = 0.0;   // numerics.lattice_speed, or less
  std::string warning;  // what it is less for, or what a time step given in seconds makes wrong; else empty
};

/// The pressure difference [Pa] that a case is known to have before it is run, the larger of
/// - friction behind its laminar velocity inlets, 8 mu U/D times the wall's area over the inlet's: exact for a pipe
///   (Poiseuille), two thirds of it between plates; D = 4 area / edge of the opening beside walls;
/// - the difference of the pressures at its outlets, where the reference speed U [m/s] makes a laminar flow.
/// Friction of narrow passages behind a wide inlet is not seen: the run measures its density at the end.
double expected_pressure_difference(const Case& c, const Surface& surface, double reference_speed);

/// numerics.lattice_speed, lowered until `expected_pressure_difference` changes the density by at most 0.5 % and tau is
/// at most 1 at the reference speed. A time step given in seconds stays, with a warning. reference_speed: U [m/s],
/// positive.
LatticeSpeed lattice_speed(const Case& c, const Surface& surface, double reference_speed);

/// The gauge pressure [Pa] that all pressure outlets have in common: the lowest if all are above 0, the highest if all
/// are below, else 0. Only differences of pressure move air; on the lattice a pressure is a density, which this is not
/// to change.
double common_pressure(const Case& c);

}  // namespace puffin::cases
