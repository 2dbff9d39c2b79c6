#pragma once
// The closed list of laws, and how they are asked.

#include <string>
#include <variant>

#include "micromodels/lift_off_law.hpp"
#include "micromodels/power_law.hpp"
#include "micromodels/table_law.hpp"
#include "micromodels/weibull_law.hpp"

namespace puffin::micromodels {

using Law = std::variant<PowerLaw, TableLaw, WeibullLaw, LiftOffLaw>;

inline constexpr double head_on = 90.0;  // impact angle [degrees] between velocity and surface

/// Fraction of the INITIAL fines of a carrier that an impact takes, clipped to [0, 1].
/// in: speed [m/s] >= 0 (at walls the normal one, between carriers the relative one); angle [degrees], used by tables
/// alone. Throws std::invalid_argument if the speed is negative or not a number.
double fraction(const Law& law, double speed, double angle = head_on);

/// Rate [1/s], of the initial fines, at which the slip speed [m/s] takes fines off; >= 0. For power laws and tables.
/// Throws std::invalid_argument for other laws, or if the speed is negative or not a number.
double rate(const Law& law, double slip_speed);
bool gives_rate(const Law& law);

const Validity& valid(const Law& law);
/// As in the micro-model file: power, table, weibull, lift-off.
std::string name(const Law& law);

}  // namespace puffin::micromodels
