#pragma once
// SI <-> lattice units. The lattice counts lengths in cells (dx), times in air steps (dt) and masses in the mass of one
// cell of air at the reference density (density dx^3). The step dt follows the ramp of the flow, so a conversion is
// always asked of the present Scale and never stored.

namespace puffin::coupling {

/// The three units of the lattice, and what follows from them. A value in lattice units ends in _lu.
struct Scale {
  double dx = 0.0;       // edge of a cell [m]
  double dt = 0.0;       // one air step [s]
  double density = 0.0;  // reference density of the air [kg/m^3]; 1 in lattice units
  double base = 0.0;     // gauge pressure of air of that density [Pa]: what all outlets have in common

  /// SI value of one lattice unit.
  double speed() const { return dx / dt; }                                  // [m/s]
  double cell_mass() const { return density * dx * dx * dx; }               // [kg]
  double force() const { return density * dx * dx * dx * dx / (dt * dt); }  // [N], acting on one cell
  double pressure_unit() const { return density * dx * dx / (dt * dt); }    // [Pa]

  double velocity_lu(double velocity) const { return velocity * dt / dx; }                   // from [m/s]
  double velocity(double velocity_lu) const { return velocity_lu * dx / dt; }                // to [m/s]
  double acceleration_lu(double acceleration) const { return acceleration * dt * dt / dx; }  // from [m/s^2]
  /// Force on one cell: F dt^2 / (density dx^4).
  double force_lu(double force_on_cell) const { return force_on_cell / force(); }     // from [N]
  double force(double force_on_cell_lu) const { return force_on_cell_lu * force(); }  // to [N]
  /// Force per volume: f dt^2 / (density dx); equal to the force on one cell in lattice units.
  double force_density_lu(double force_density) const { return force_density * dt * dt / (density * dx); }  // [N/m^3]
  double viscosity_lu(double viscosity) const { return viscosity * dt / (dx * dx); }   // kinematic, from [m^2/s]
  double viscosity(double viscosity_lu) const { return viscosity_lu * dx * dx / dt; }  // kinematic, to [m^2/s]
  /// Relaxation time of the shear stress: tau = 3 nu_lu + 1/2.
  double relaxation_time(double viscosity) const { return 3.0 * viscosity_lu(viscosity) + 0.5; }  // from [m^2/s]
  /// Gauge pressure of an isothermal lattice: p = base + c_s^2 (rho - 1), c_s^2 = 1/3.
  double pressure(double density_excess_lu) const { return base + pressure_difference(density_excess_lu); }  // to [Pa]
  double pressure_difference(double density_lu) const { return density_lu / 3.0 * pressure_unit(); }         // to [Pa]
  double density_excess_lu(double pressure) const { return 3.0 * (pressure - base) / pressure_unit(); }  // from [Pa]
  /// Volume flow rate [m^3/s] of one cell face crossed at one lattice velocity.
  double flow_rate() const { return dx * dx * dx / dt; }
  /// Momentum [N s] of one cell at one lattice velocity.
  double momentum() const { return cell_mass() * speed(); }
};

}  // namespace puffin::coupling
