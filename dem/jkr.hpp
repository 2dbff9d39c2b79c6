#pragma once
// Adhesion of soft or large spheres (Johnson, Kendall & Roberts, Proc. R. Soc. Lond. A 324, 301 (1971)): the attraction
// acts within the contact and stretches it. Written as by Chokshi, Tielens & Hollenbach, Astrophys. J. 407, 806 (1993):
//   F/F_c = 4 (s^6 - s^3),   delta/delta_c = 6^(1/3) (2 s^4 - 4/3 s),   s = sqrt(a/a_0),
//   F_c = 3/2 pi W R*,   a_0 = (9 pi W R*^2/(2 E*))^(1/3),   delta_c = a_0^2/(2 6^(1/3) R*).
// A contact begins at delta = 0 with a jump to F = -8/9 F_c, pulls with at most F_c, and breaks at delta = -delta_c and
// F = -5/9 F_c. What lies between the two, 7.09 (W^5 R*^4/E*^2)^(1/3), is lost in every contact (Thornton & Ning,
// Powder Technol. 99, 154 (1998)). Valid: Tabor number above about 5; the moduli must be the true ones. Checked by:
// tests/dem/test_jkr.cpp

#include <cmath>
#include <numbers>

namespace puffin::dem {

/// Numbers of one pair. in: work of adhesion W = 2 gamma [J/m^2] > 0, R* [m] > 0, E* [Pa] > 0.
struct JkrCurve {
  double pull_off = 0.0;  // F_c [N]
  double radius = 0.0;    // a_0, of the contact without force [m]
  double stretch = 0.0;   // delta_c [m]

  JkrCurve() = default;
  JkrCurve(double work, double pair_radius, double modulus)
      : pull_off(1.5 * std::numbers::pi * work * pair_radius),
        radius(std::cbrt(4.5 * std::numbers::pi * work * pair_radius * pair_radius / modulus)),
        stretch(radius * radius / (2.0 * std::cbrt(6.0) * pair_radius)) {}

  /// Radius of the contact [m] at an overlap [m] >= -stretch, on the branch that a contact follows (below: the last).
  /// Newton on a convex function from above, so it cannot miss; the last step is below rounding.
  double contact_radius(double overlap) const {
    const double y = overlap / (std::cbrt(6.0) * stretch);
    const double least = std::cbrt(1.0 / 6.0);  // where the branch ends, y = -6^(-1/3)
    double s = std::max(1.0, std::pow(1.5 * std::max(0.0, y), 0.25));
    for (int n = 0; n < 60; ++n) {
      const double slope = 8.0 * s * s * s - 4.0 / 3.0;
      if (slope <= 0.0) return radius * least * least;
      const double step = (2.0 * s * s * s * s - 4.0 / 3.0 * s - y) / slope;
      if (!(step > 1e-15 * s)) break;
      s = std::max(least, s - step);
    }
    return radius * s * s;
  }
  /// Force [N] of a contact of radius a [m], > 0 pushes.
  double force(double a) const {
    const double s3 = std::pow(a / radius, 1.5);
    return 4.0 * pull_off * (s3 * s3 - s3);
  }
};

/// Energy [J] lost between the jump into contact and the break, at any speed.
inline double jkr_loss(double work, double pair_radius, double modulus) {
  return 7.09 * std::cbrt(std::pow(work, 5) * std::pow(pair_radius, 4) / (modulus * modulus));
}

}  // namespace puffin::dem
