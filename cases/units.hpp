#pragma once
// Quantities written with a unit ("1.204 kg/m^3", "70 um", "36 L/min", "80ms") -> SI numbers, with the dimension
// checked. A unit is names joined by space, '*' or '/', with integer powers (m^2 or m2) and brackets: "kg/(m s)".

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace puffin::cases {

/// Exponents of kilogram, metre, second and radian.
struct Dimension {
  int kg = 0, m = 0, s = 0, rad = 0;
  bool operator==(const Dimension&) const = default;
};

/// What a key holds: "a length", in metres, written like "0.2 mm".
struct Unit {
  Dimension dimension;
  std::string_view kind;     // with its article: "a length"
  std::string_view symbol;   // SI, as written behind a number; empty: a pure number
  std::string_view example;  // for messages
};

namespace unit {
inline constexpr Unit number{{0, 0, 0}, "a pure number", "", "0.5"};
inline constexpr Unit length{{0, 1, 0}, "a length", "m", "0.2 mm"};
inline constexpr Unit volume{{0, 3, 0}, "a volume", "m^3", "2751.6 mm^3"};
inline constexpr Unit time{{0, 0, 1}, "a time", "s", "80 ms"};
inline constexpr Unit velocity{{0, 1, -1}, "a velocity", "m/s", "2 m/s"};
inline constexpr Unit acceleration{{0, 1, -2}, "an acceleration", "m/s^2", "-9.81 m/s^2"};
inline constexpr Unit flow_rate{{0, 3, -1}, "a volume flow rate", "m^3/s", "36 L/min"};
inline constexpr Unit density{{1, -3, 0}, "a mass density", "kg/m^3", "1520 kg/m^3"};
inline constexpr Unit viscosity{{1, -1, -1}, "a dynamic viscosity", "Pa s", "1.82e-5 Pa s"};
inline constexpr Unit diffusion{{1, -1, -1}, "a mass diffusivity (density times D)", "kg/(m s)", "1e-6 kg/(m s)"};
inline constexpr Unit pressure{{1, -1, -2}, "a pressure", "Pa", "2.4 kPa"};
inline constexpr Unit force_density{{1, -2, -2}, "a force per volume", "N/m^3", "10 N/m^3"};
inline constexpr Unit surface_energy{{1, 0, -2}, "a surface energy", "J/m^2", "3.6e-3 J/m^2"};
inline constexpr Unit stiffness{{1, 0, -2}, "a stiffness", "N/m", "1000 N/m"};
inline constexpr Unit energy{{1, 2, -2}, "an energy", "J", "4.3e-20 J"};
inline constexpr Unit rate{{0, 0, -1}, "a rate", "1/s", "100 1/s"};
inline constexpr Unit angular_velocity{{0, 0, -1, 1}, "an angular velocity", "rad/s", "100 rad/s"};
inline constexpr Unit angle{{0, 0, 0, 1}, "an angle", "rad", "90 deg"};
inline constexpr Unit number_density{{0, -3, 0}, "a number density", "1/m^3", "1e12 1/m^3"};
}  // namespace unit

/// A text that is no quantity, or a quantity of another dimension.
struct UnitError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct Quantity {
  double value = 0.0;  // SI
  Dimension dimension;
};

/// Reads number and unit. Throws UnitError for anything else, an unknown unit, or a number that is not finite.
Quantity parse_quantity(std::string_view text);

/// The SI value of a text that must have the dimension of `expected`; a number without a unit is SI already, and an
/// angle may leave out its radian. Throws UnitError naming both dimensions.
double parse_quantity(std::string_view text, const Unit& expected);

/// "a length [m]" for a dimension with a name, else "[kg m^-1 s^-3]".
std::string describe(const Dimension& dimension);

/// The shortest text that reads back as the same number: "0.0002", "1e-06".
std::string shortest(double value);

/// The value as it stands in a resolved case: "0.0002 m"; without a unit for a pure number.
std::string format_quantity(double value, const Unit& u);

}  // namespace puffin::cases
