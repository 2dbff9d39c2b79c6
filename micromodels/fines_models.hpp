#pragma once
// What happens to the fines of a carrier: four mechanisms, each with its law or switched off; and what an event takes.

#include <optional>
#include <string>

#include "micromodels/law.hpp"

namespace puffin::micromodels {

/// How far a set of laws may be trusted.
enum class Label {
  derived,     // from resolved simulations of a coated carrier
  calibrated,  // fitted to the outcome of whole devices
  surrogate,   // physically argued, to stand in
  given        // by the user
};

/// A missing law is a mechanism that does not act.
struct FinesModels {
  std::optional<Law> wall_detach;      // thesis 2.7, 2.8: wall impact, into the air
  std::optional<Law> wall_attach;      // thesis 2.9: wall impact, onto the wall
  std::optional<Law> particle_detach;  // thesis 2.7, 2.8: impact between carriers, into the air
  std::optional<Law> drag_detach;      // thesis 2.10: a rate [1/s] of the slip speed
  Label label = Label::given;
  std::string source;
  double surface_energy = 0.0;  // [J/m^2] the formulation for which the set holds; 0: not stated
};

/// Throws std::invalid_argument if the drag law gives no rate, or surface_energy is negative or not a number.
void check(const FinesModels& models);

/// Fines taken off one carrier by one event, >= 0 and together at most what was left.
struct Taken {
  double to_air = 0.0, to_wall = 0.0;  // number of fines, not rounded to whole ones
};

// `initial`: fines on the carrier at the start; `left`: fines still on it. The laws refer to the initial number
// (eq. 2.7), so they can ask for more than is left: then detachment and attachment shrink in proportion. All throw
// std::invalid_argument if a speed, an angle, `initial` or `left` is negative or not a number.

/// speed [m/s]: normal to the wall at first touch; angle [degrees], 90 = head on.
Taken impact_on_wall(const FinesModels& models, double speed, double angle, double initial, double left);
/// speed [m/s]: relative, at first touch. For one of the two partners: call it for each.
Taken impact_on_carrier(const FinesModels& models, double speed, double angle, double initial, double left);
/// relative_speed [m/s]: |u_air - u_carrier|, eq. 2.11; dt [s].
Taken drag(const FinesModels& models, double relative_speed, double dt, double initial, double left);

}  // namespace puffin::micromodels
