#include "coupling/find_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "coupling/air_steps.hpp"
#include "coupling/averaged.hpp"
#include "coupling/drag_limit.hpp"
#include "coupling/field_forces.hpp"
#include "coupling/resting.hpp"
#include "coupling/self_disturbance.hpp"
#include "coupling/volume_fraction.hpp"

namespace puffin::coupling {

namespace {

/// Of the walls that move [lattice units].
double fastest_wall_lu(const Models& models, const State& s) {
  double fastest = 0.0;
  for (std::size_t b = 0; b < s.drive.speed.size(); ++b)
    if (!models.patches[b].is_inlet && !models.patches[b].is_outlet)
      fastest = std::max(fastest, std::abs(s.drive.speed[b]));
  return fastest;
}

}  // namespace

void find_loads(const Models& models, double interval, State& s) {
  dem::Carriers& c = s.carriers.carriers;
  const std::size_t count = c.size();
  std::vector<int> which(count);
  for (std::size_t p = 0; p < count; ++p) which[p] = static_cast<int>(p);
  std::vector<Vec3> velocity(count, Vec3::Zero()), own(count);
  for (std::size_t p = 0; p < count; ++p) own[p] = motion_of(c, p);
  if (computes_air(models, s)) {
    interpolate(s.stencils, s.air->moments, count, s.samples, fastest_wall_lu(models, s));
    for (std::size_t p = 0; p < count; ++p) velocity[p] = s.samples.velocity_lu[p] * s.scale.speed();
  } else if (models.frozen_air) {
    // At the middle of the way, so that a vortex or a shear is followed to second order.
    for (std::size_t p = 0; p < count; ++p) velocity[p] = models.frozen_air(c.position[p] + 0.5 * interval * own[p]);
  }
  s.loads.assign(count, dem::Load{});
  if (!s.air && !models.frozen_air) return;
  std::vector<double> beta(count, 0.0), solid, volume;
  double largest_fraction = 1.0;
  if (computes_air(models, s) && models.volume_fraction != VolumeFraction::none) {
    volume.resize(count);
    for (std::size_t p = 0; p < count; ++p)
      volume[p] = c.carriers[p] * 4.1887902047863909846 * std::pow(c.single_radius[p], 3);
    solid.assign(count, 0.0);
    largest_fraction = solid_fraction(s.stencils, volume, s.scale.dx, s.spreader, solid);
  }
  drag_coefficients(models.drag, models.air, which, velocity, own, c.single_radius, c.carriers, solid, beta);
  if (models.frozen_air) {  // the coefficient too at the middle: with the slip that half the interval will have left
    std::vector<Vec3> middle(count);
    for (std::size_t p = 0; p < count; ++p)
      middle[p] = velocity[p] + (own[p] - velocity[p]) * std::exp(-0.5 * interval * beta[p] / c.mass[p]);
    drag_coefficients(models.drag, models.air, which, velocity, middle, c.single_radius, c.carriers, solid, beta);
  }
  if (computes_air(models, s) && models.two_way) take_off_self(models, solid, s, velocity, beta);
  if (computes_air(models, s))
    for (const int p : s.stencils.outside()) beta[p] = 0.0;  // no air there: nothing drags
  const std::vector<WallFactors> walls = find_wall_factors(models, s);
  std::vector<double> excess;  // [kg/s] of drag across the nearest wall over that along it
  for (std::size_t p = 0; p < walls.size(); ++p) {
    excess.push_back(beta[p] * std::max(0.0, walls[p].across - walls[p].along));
    beta[p] *= walls[p].along;
  }
  if (computes_air(models, s) && models.two_way) {
    const double reaction_time = interval / least_share(s.pores);  // a cell that is partly solid holds less air
    double load = volume.empty() || !walls.empty() ? std::numeric_limits<double>::infinity()
                                                   : load_bound(largest_fraction, beta, volume, reaction_time, s.scale);
    const double most = largest_load(interval / s.scale.dt);
    // A bound that would shorten the next intervals is no reason to: then the load itself is found.
    const double longest = static_cast<double>(models.steps_per_exchange_asleep) * s.scale.dt / interval;
    if (!(load * longest <= largest_load(static_cast<double>(models.steps_per_exchange_asleep)))) {
      std::vector<double> loads(count, 0.0);
      if (walls.empty())
        limit_drag(s.stencils, reaction_time, s.scale, s.spreader, loads, beta, most);
      else
        limit_drag_beside_walls(s.stencils, reaction_time, s.scale, s.spreader, loads, beta, excess, most);
      load = *std::max_element(loads.begin(), loads.end());
    }
    s.load_rate = load / interval;
  }
  for (std::size_t p = 0; p < count; ++p) {
    s.loads[p].air_velocity = velocity[p];
    s.loads[p].drag = beta[p];
  }
  add_drag_across(walls, excess, interval, s);
  add_field_forces(models, interval, s);
}

}  // namespace puffin::coupling
