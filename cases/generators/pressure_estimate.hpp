#pragma once
// What the pressure drop of a device should be, by hand: the sum of textbook losses along its path. Used to choose the
// dimensions that the thesis does not state, and as a first check of a computed flow. Never used by the solver.

#include <string>
#include <vector>

#include "cases/generators/generators.hpp"

namespace puffin::cases {

struct PressureLoss {
  std::string where;  // "lip", "step", "friction of leg 1", "bend 1", ...
  double loss = 0.0;  // [Pa] of total pressure
};

struct PressureEstimate {
  std::vector<PressureLoss> losses;
  double inlet_head = 0.0;            // [Pa] 1/2 rho U^2 at the inlet
  double outlet_head = 0.0;           // [Pa] at the outlet
  double total_to_static_drop = 0.0;  // [Pa] total at the inlet minus static at the outlet = losses + outlet_head
  double static_drop = 0.0;           // [Pa] total_to_static_drop - inlet_head
};

/// Turbulent, incompressible, steady; every velocity head is that of a section mean.
/// - sudden widening (lip, step): Borda-Carnot, 1/2 rho (U1 - U2)^2
/// - friction of a leg: Blasius, f = 0.3164 Re^-0.25 on D_h = 4 A / perimeter, over the length of its centre line
/// - mitre: ASHRAE Fundamentals CR3-6, C(H/W) K_Re on the upstream head, times Idelchik's factor for a change of width
///   (diagram 6-4: elbow with sharp corners, converging or diverging)
/// - rounded bend: ASHRAE Fundamentals CR3-1, C(r/W, H/W) K_Re, on the head of the narrower leg, with r = inner radius
///   plus W/2; plus Borda-Carnot if the duct widens
/// K_Re = (Re / 1.4e5)^-0.128 for mitres and (Re / 2e5)^-0.231 for rounded bends, fits to their tables (1.40 and 2.0 at
/// Re = 1e4), at least 1.
/// in : kind "l-bend" or "omega-bend"; flow rate [m^3/s], density [kg/m^3], viscosity [Pa s], all > 0
/// Accuracy: 20 % or so; bends closer than 10 D_h to each other or to the step are not independent.
/// Throws std::invalid_argument for other kinds or values, GeneratorError for wrong parameters.
PressureEstimate estimate_pressure(const std::string& kind, const Parameters& parameters, double flow_rate,
                                   double density = 1.204, double viscosity = 1.82e-5);

}  // namespace puffin::cases
