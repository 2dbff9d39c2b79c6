#pragma once
// Drag of a sphere beside a plane wall, over its drag far away. Slow flow: Re < 1.
// Checked by: tests/coupling/test_lift.cpp

#include <algorithm>

namespace puffin::coupling {

/// Motion along the wall, s = radius over the centre's distance, at most 1:
///   1/(1 - 9/16 s + 1/8 s^3 - 45/256 s^4 - 1/16 s^5).
/// Source: Faxen (1923), in Happel & Brenner, Low Reynolds Number Hydrodynamics (1965), section 7-4.
inline double drag_along_wall(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return 1.0 / (1.0 - s * (9.0 / 16.0 - s * s * (1.0 / 8.0 - s * (45.0 / 256.0 + s / 16.0))));
}

/// Motion towards it or away, g = gap over radius: (6 g^2 + 9 g + 2)/(6 g^2 + 2 g), within 1 % of the series of
/// Brenner, Chem. Eng. Sci. 16, 242 (1961), and 1/g as g -> 0. Source: Bevan & Prieve, J. Chem. Phys. 113, 1228 (2000).
/// Roughness keeps surfaces apart: g is taken as at least 0.001.
inline double drag_towards_wall(double g) {
  g = std::max(g, 1e-3);
  return (6.0 * g * g + 9.0 * g + 2.0) / (6.0 * g * g + 2.0 * g);
}

}  // namespace puffin::coupling
