#pragma once
// What becomes of a fine between leaving its carrier and coming to rest: through the air, to the wall or another
// carrier.

#include "micromodels/derivation/impact.hpp"

namespace puffin::micromodels::derivation {

/// Speed [m/s] that a sphere of radius R [m] loses to the air on its way from the gap h [m] to a wall, or back:
///   6 pi mu R/m (h/C_c + 2 R I(h/(6 l))), I(x) = (1+x)^2/2 ln(1+x) - (x + x^2/2) ln x - x/2.
/// Stokes' drag with Cunningham's slip correction, and the film between sphere and wall, 6 pi mu R^2 v f(h)/h with
/// f = h/(3 l) [(1 + h/(6 l)) ln(1 + 6 l/h) - 1], l the mean free path: finite down to contact.
/// Source: L. M. Hocking, J. Eng. Math. 7, 207 (1973). Neglected: the air that the carrier itself moves.
double speed_lost_to_air(double radius, double mass, double gap, double viscosity, double mean_free_path);

/// Fines that a carrier has let go: counts where they end. Speeds upwards [m/s]; the wall is z = 0, or another carrier
/// hangs below. On a wall they lose speed to the air, on a carrier they do not (its shape is left out); they stick to
/// what they meet below the capture speed of Thornton & Ning (Powder Technol. 99 (1998) 154), else they bounce with the
/// dashpot's restitution. What stops before the wall is airborne.
class Flight {
 public:
  /// `carrier_up`, `other_up`: speeds after the impact.
  Flight(const Scene& scene, double carrier_up, double other_up);
  /// A fine with the speed `up`, its centre at the height `height` [m].
  void land(double up, double height, Outcome& outcome) const;

 private:
  void meet_carrier(double up, Outcome& outcome) const;

  const Scene& scene_;
  double carrier_up_, other_up_, capture_carrier_, capture_other_;
};

}  // namespace puffin::micromodels::derivation
