#pragma once
// Drag laws of a sphere in air, alone or among others.
//
// Every law is a factor f on Stokes's drag of ONE carrier at the slip u - v between the air in the gaps and the
// carrier:
//     F = beta (u - v),   beta = 3 pi mu d f(Re, phi)   [kg/s],     Re = rho d |u - v| / mu,   phi: solid fraction.
// A parcel of n carriers moves with n beta at the same Re: drag knows the single diameter, not the parcel's.
// The force due to the mean pressure gradient is not part of it.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace puffin::coupling {

/// f = 1 + 0.15 Re^0.687 for Re <= 1000; above, the drag coefficient keeps its value at Re = 1000 (0.438).
/// Source: Schiller & Naumann, Z. VDI 77, 318 (1933). Valid: one sphere, Re < 800 within 5 %; phi is ignored.
struct SchillerNaumann {
  static constexpr std::string_view name = "schiller-naumann";
  double factor(double reynolds, double) const {
    const double re = std::min(reynolds, 1000.0);
    const double f = 1.0 + 0.15 * std::pow(re, 0.687);
    return reynolds > 1000.0 ? f * reynolds / 1000.0 : f;
  }
};

/// F = (1/8) C_d pi d^2 rho e^2 |v| v e^-X with e = 1 - phi, Re_s = e Re, C_d = (0.63 + 4.8 / sqrt(Re_s))^2 and
/// X = 3.7 - 0.65 exp(-(1.5 - log10 Re_s)^2 / 2); so f = C_d Re e^(2 - X) / 24.
/// Source: Di Felice, Int. J. Multiphase Flow 20, 153 (1994). Valid: any Re below 1e4, phi from 0 to packing.
/// As Re -> 0: C_d Re_s -> 4.8^2 = 23.04 (4 % below Stokes's 24), X -> 3.7. For a single sphere it exceeds Schiller &
/// Naumann by 13 % at Re = 100 and by 27 % at Re = 500.
struct DiFelice {
  static constexpr std::string_view name = "di-felice";
  double factor(double reynolds, double solid_fraction) const {
    const double e = 1.0 - solid_fraction;
    const double re = e * reynolds;
    const double root = 0.63 * std::sqrt(re) + 4.8;  // C_d Re_s = root^2, finite at Re = 0
    const double bend = re > 0.0 ? 1.5 - std::log10(re) : 1e3;
    const double x = 3.7 - 0.65 * std::exp(-0.5 * bend * bend);
    return root * root / 24.0 * std::pow(e, 1.0 - x);
  }
};

/// F / (3 pi mu d e |v|) = 10 phi/e^2 + e^2 (1 + 1.5 sqrt(phi))
///                       + 0.413 Re_s/(24 e^2) [1/e + 3 e phi + 8.4 Re_s^-0.343] / [1 + 10^(3 phi) Re_s^-(0.5 + 2 phi)]
/// with e = 1 - phi, Re_s = e Re; f is e times that.
/// Source: Beetstra, van der Hoef & Kuipers, AIChE J. 53, 489 (2007), their drag without the pressure gradient's part.
/// Valid: Re_s < 1000, 0.1 <= phi <= 0.6, the range of the simulations behind it. For a single sphere (phi = 0) it
/// exceeds Schiller & Naumann by 16 % at Re = 100 and by 49 % at Re = 500.
struct Beetstra {
  static constexpr std::string_view name = "beetstra";
  double factor(double reynolds, double solid_fraction) const {
    const double phi = solid_fraction, e = 1.0 - phi;
    const double viscous = 10.0 * phi / (e * e) + e * e * (1.0 + 1.5 * std::sqrt(phi));
    const double re = e * reynolds;
    if (!(re > 0.0)) return e * viscous;
    const double above = 1.0 / e + 3.0 * e * phi + 8.4 * std::pow(re, -0.343);
    const double below = 1.0 + std::pow(10.0, 3.0 * phi) * std::pow(re, -0.5 - 2.0 * phi);
    return e * (viscous + 0.413 * re / (24.0 * e * e) * above / below);
  }
};

/// No drag at all: a dry scene, or a check.
struct NoDrag {
  static constexpr std::string_view name = "none";
  double factor(double, double) const { return 0.0; }
};

using DragLaw = std::variant<SchillerNaumann, DiFelice, Beetstra, NoDrag>;

/// The law of that name. Throws std::invalid_argument and lists the names if there is none.
DragLaw drag_law(std::string_view name);

/// The air a drag law needs: density [kg/m^3] and dynamic viscosity [Pa s].
struct Air {
  double density = 0.0, viscosity = 0.0;
};

/// beta = 3 pi mu d f [kg/s] of one sphere of diameter `d` [m] at slip speed `slip` [m/s] >= 0 and solid fraction
/// `phi` in [0, 0.65].
template <class Law>
double drag_coefficient(const Law& law, const Air& air, double d, double slip, double phi) {
  return 3.0 * std::numbers::pi * air.viscosity * d * law.factor(air.density * d * slip / air.viscosity, phi);
}

/// One sphere, the law chosen at run time; for many use drag_coefficients.
inline double drag_coefficient(const DragLaw& law, const Air& air, double d, double slip, double phi) {
  return std::visit([&](const auto& l) { return drag_coefficient(l, air, d, slip, phi); }, law);
}

/// Drag coefficients of parcels, beta_p = (carriers in the parcel) x (coefficient of one carrier) [kg/s], for those in
/// `which`. in, all by carrier index: velocities of the air and of the parcels [m/s], radius of ONE carrier [m], number
/// of carriers in the parcel, solid fraction (empty: 0). out: `beta` by carrier index, others are left alone.
void drag_coefficients(const DragLaw& law, const Air& air, std::span<const int> which,
                       std::span<const Eigen::Vector3d> air_velocity, std::span<const Eigen::Vector3d> velocity,
                       std::span<const double> single_radius, std::span<const double> carriers_in_parcel,
                       std::span<const double> solid_fraction, std::span<double> beta);

}  // namespace puffin::coupling
