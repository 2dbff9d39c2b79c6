#include "micromodels/derivation/flight.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "micromodels/derivation/one_fine.hpp"

namespace puffin::micromodels::derivation {

double speed_lost_to_air(double radius, double mass, double gap, double viscosity, double mean_free_path) {
  if (gap <= 0.0 || viscosity == 0.0) return 0.0;
  const double knudsen = mean_free_path / radius;
  const double slip = 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
  const double x = gap / (6.0 * mean_free_path);
  const double film = 0.5 * (1.0 + x) * (1.0 + x) * std::log1p(x) - (x + 0.5 * x * x) * std::log(x) - 0.5 * x;
  return 6.0 * std::numbers::pi * viscosity * radius / mass * (gap / slip + 2.0 * radius * film);
}

Flight::Flight(const Scene& scene, double carrier_up, double other_up)
    : scene_(scene),
      carrier_up_(carrier_up),
      other_up_(other_up),
      capture_carrier_(capture_speed(on_carrier(scene, 1.0))) {
  const double infinite = std::numeric_limits<double>::infinity(), mass = fine_mass(scene);
  capture_other_ = capture_carrier_;
  if (scene.target == Partner::wall)
    capture_other_ =
        capture_speed(pair_contact(scene.surface, 0.5 * scene.fine_diameter, infinite, mass, infinite, true, 1.0));
}

void Flight::land(double up, double height, Outcome& o) const {
  const bool wall = scene_.target == Partner::wall;
  const double closing = other_up_ - up;
  if (closing <= 0.0) return meet_carrier(up, o);
  const double radius = 0.5 * scene_.fine_diameter;
  const double lost =
      wall ? speed_lost_to_air(radius, fine_mass(scene_), height - radius, scene_.air_viscosity, scene_.mean_free_path)
           : 0.0;
  const double arrives = closing - lost;
  if (arrives <= 0.0) {
    ++o.detached;
  } else if (arrives < capture_other_) {
    ++(wall ? o.to_wall : o.redeposited);
  } else {
    const double e = scene_.surface.restitution * std::sqrt(1.0 - std::pow(capture_other_ / arrives, 2));
    meet_carrier(other_up_ + e * arrives, o);
  }
}

void Flight::meet_carrier(double up, Outcome& o) const {
  const double closing = up - carrier_up_;
  ++(closing > 0.0 && closing < capture_carrier_ ? o.redeposited : o.detached);
}

}  // namespace puffin::micromodels::derivation
