#include "micromodels/fines_models.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puffin::micromodels {

namespace {

void check_event(double angle, double initial, double left) {
  if (!(angle >= 0.0 && angle <= 180.0))
    throw std::invalid_argument("micro-model: the impact angle must lie in [0, 180] degrees");
  if (!(initial >= 0.0 && left >= 0.0) || !std::isfinite(initial) || !std::isfinite(left))
    throw std::invalid_argument("micro-model: the numbers of fines must be >= 0");
}

double asked(const std::optional<Law>& law, double speed, double angle, double initial) {
  return law ? fraction(*law, speed, angle) * initial : 0.0;
}

/// Clips a demand to what is left. The last line keeps the sum below `left` to the bit.
Taken clipped(double air, double wall, double left) {
  const double demand = air + wall;
  const double shrink = demand > left ? left / demand : 1.0;
  const double to_wall = std::min(wall * shrink, left);
  return {std::min(air * shrink, left - to_wall), to_wall};
}

}  // namespace

void check(const FinesModels& models) {
  if (models.drag_detach && !gives_rate(*models.drag_detach))
    throw std::invalid_argument("drag_detach: a " + name(*models.drag_detach) +
                                " law knows impacts, not rates; use power or table");
  if (!(models.surface_energy >= 0.0) || !std::isfinite(models.surface_energy))
    throw std::invalid_argument("surface_energy of the micro-models must be a number >= 0");
}

Taken impact_on_wall(const FinesModels& models, double speed, double angle, double initial, double left) {
  check_event(angle, initial, left);
  return clipped(asked(models.wall_detach, speed, angle, initial), asked(models.wall_attach, speed, angle, initial),
                 left);
}

Taken impact_on_carrier(const FinesModels& models, double speed, double angle, double initial, double left) {
  check_event(angle, initial, left);
  return clipped(asked(models.particle_detach, speed, angle, initial), 0.0, left);
}

Taken drag(const FinesModels& models, double relative_speed, double dt, double initial, double left) {
  check_event(head_on, initial, left);
  if (!(dt >= 0.0)) throw std::invalid_argument("micro-model: the time step must be >= 0");
  if (!models.drag_detach) return {};
  return clipped(rate(*models.drag_detach, relative_speed) * dt * initial, 0.0, left);
}

}  // namespace puffin::micromodels
