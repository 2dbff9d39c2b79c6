#pragma once
// The speed of air that no inlet, no moving wall and no velocity at the start sets.

#include <string>

#include "cases/case.hpp"
#include "cases/surface.hpp"

namespace puffin::cases {

struct EstimatedSpeed {
  double value = 0.0;   // [m/s]; 0: nothing moves the air
  std::string warning;  // how it was found; empty where it is 0
};

/// For cases without a speed of their own. What moves the air is the force density G [N/m^3], of the body force (its
/// largest value until stop.time) and of the pressures apart at the openings over the length volume/opening. In a
/// passage of D = 4 volume/wall area G keeps up the smaller of
///   G D^2/(32 mu)            laminar: exact for a pipe, 2/3 of it between plates (Poiseuille)
///   sqrt(2 G D/(0.03 rho))   turbulent: Darcy's friction factor 0.03, that of Re 1e4
/// and it cannot exceed G stop.time/rho, nor sqrt(2 dp/rho) where a pressure dp drives it. Air that starts as a file
/// says is at least as fast as that. Good within a factor of two for straight passages, too high (and so safe for the
/// lattice) with bends and for forces that swing quickly. Throws std::invalid_argument for files that cannot be used.
EstimatedSpeed estimated_speed(const Case& c, const Surface& surface);

/// What is said of a case whose air nothing moves.
inline constexpr const char* no_speed =
    "nothing sets the speed of the air: give numerics.reference_speed, e.g. \"1 m/s\"";

}  // namespace puffin::cases
