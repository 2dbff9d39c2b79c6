#pragma once
// Numbers that follow from a case: speeds, masses, lattice parameters, an estimate of the number of steps.
// Everything in SI; areas are given by the caller because only the geometry knows them.

#include <functional>
#include <optional>
#include <string>

#include "cases/case.hpp"

namespace puffin::cases {

/// Area [m^2] of a patch.
using AreaOf = std::function<double(const std::string& patch)>;

/// Volume flow rate into the domain [m^3/s] through a velocity inlet at time t; nullopt if the boundary prescribes none
/// (another type, a velocity vector, or a profile from a file).
std::optional<double> flow_rate(const Boundary& b, double t, double area);

/// Section-mean speed [m/s] of a velocity inlet or a moving wall at time t: Q/A, or the norm of the vector; 0 for
/// others.
double mean_speed(const Boundary& b, double t, double area);

/// The largest section-mean speed [m/s] of any boundary until `end` [s]: exact, as Q(t) is linear between its rows.
double largest_mean_speed(const Air& air, double end, const AreaOf& area_of);

/// What the time step may follow [m/s]: the fastest of inlets and moving walls at time t, and of the air at the start,
/// as what moves then goes on moving.
double followed_speed(const Air& air, double t, const AreaOf& area_of);
/// The largest of it until `end` [s]: where the step is shortest, whatever speed numerics.reference_speed says.
double largest_followed_speed(const Air& air, double end, const AreaOf& area_of);

/// The largest section-mean speed [m/s] until stop.time: inlets times section_ratio (section_speed.hpp), moving walls,
/// the frozen or initial velocity. 0 if nothing moves the air.
double largest_section_speed(const Case& c, const AreaOf& area_of, double section_ratio);

/// The speed that `numerics.lattice_speed` stands for: as given, or the largest section-mean speed.
double reference_speed(const Case& c, const AreaOf& area_of, double section_ratio = 1.0);

/// Cell size [m]: as given, or cbrt(volume / cells). Throws std::invalid_argument if the case gives neither.
double cell_size(const Numerics& n, double fluid_volume);

/// The lattice at reference speed U: dt = u_lb dx / U, nu_lb = nu dt / dx^2, tau = 1/2 + 3 nu_lb, Ma = sqrt(3) u_lb.
struct LatticeNumbers {
  double dx = 0.0;          // [m]
  double dt = 0.0;          // [s], the smallest
  double dt_largest = 0.0;  // [s], with follow-ramp
  double tau = 0.0;         // at dt, the smallest
  double mach = 0.0;        // lattice Mach number of the largest section-mean speed, at least of the reference speed
  double steps = 0.0;       // until stop.time
};
/// With follow-ramp the step grows as U_largest/U(t), to at most four times the smallest. Throws std::invalid_argument
/// unless dx and reference_speed are positive.
LatticeNumbers lattice_numbers(const Case& c, double dx, double reference_speed, const AreaOf& area_of,
                               double section_ratio = 1.0);

/// Re = rho U D / mu.
double reynolds(const Air& air, double speed, double length);

/// Mass of a bare carrier [kg]: rho pi d^3 / 6.
double carrier_mass(double diameter, double density);

/// Carriers with their fines [kg], all of them.
double dose_mass(const Carriers& c);

/// Diameter [m] of a fine of mass fine_mass_ratio times the carrier's and of the given density [kg/m^3].
double fines_diameter(const Carriers& c, double fines_density);

/// The time [s] in which the smallest carrier of a frozen field takes on its speed, rho d^2/(18 mu), at least 0.2 us;
/// infinite without one.
double response_time(const Case& c);

}  // namespace puffin::cases
