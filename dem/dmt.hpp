#pragma once
// Adhesion of hard or small spheres (Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53, 314 (1975)): the
// attraction acts around the contact and leaves its profile that of Hertz.
// Checked by: tests/dem/test_jkr.cpp

#include <numbers>

namespace puffin::dem {

/// F = 4/3 E* sqrt(R*) delta^1.5 - 4 pi gamma R* while delta >= 0. Pull-off F0 = 4 pi gamma R* = 2 pi W R* [N], at zero
/// overlap; no hysteresis. gamma: energy of ONE surface [J/m^2], W = 2 gamma. Valid: Tabor number below about 0.1..1.
inline double dmt_pull_off(double surface_energy, double radius) {
  return 4.0 * std::numbers::pi * surface_energy * radius;
}

}  // namespace puffin::dem
