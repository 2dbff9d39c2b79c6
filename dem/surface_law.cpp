#include "dem/surface_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/linear_contact.hpp"

namespace puffin::dem {

SurfaceLaw::SurfaceLaw(const Surfaces& surfaces) {
  const auto& contact = std::get<LinearContact>(surfaces.contact);
  restitution = contact.restitution;
  zeta = damping_ratio(contact.restitution);
  peak = peak_overlap_factor(zeta);
  rolling = contact.rolling_friction;
  stiffness = contact.stiffness.value_or(0.0);
  max_overlap = contact.max_overlap;
  tangential_ratio = contact.tangential_ratio;
  if (const auto* constant = std::get_if<ConstantFriction>(&contact.friction)) {
    stick = slip = limit = constant->coefficient;
  } else {
    const auto& f = std::get<SpeedFriction>(contact.friction);
    stick = f.stick, slip = f.slip, limit = f.limit, slip_speed = f.slip_speed, limit_speed = f.limit_speed;
  }
  if (const auto* hamaker = std::get_if<Hamaker>(&surfaces.adhesion)) {
    pull_per_radius = 4.0 * std::numbers::pi * hamaker->surface_energy;
    cutoff_gap = hamaker->cutoff_gap;
    scaling_power = 1 + static_cast<int>(hamaker->parcel_scaling);
  }
}

double SurfaceLaw::friction(double speed) const {
  if (slip_speed == 0.0) return stick;
  if (speed < slip_speed) return stick + (stick - slip) * (speed / slip_speed - 2.0) * (speed / slip_speed);
  if (speed < limit_speed) return slip + (limit - slip) * (speed - slip_speed) / (limit_speed - slip_speed);
  return limit;
}

double SurfaceLaw::largest_friction() const { return std::max({stick, slip, limit}); }

PairLaw pair_law(const SurfaceLaw& law, double radius_a, double single_a, double radius_b, double single_b,
                 double reduced_mass) {
  PairLaw pair;
  const bool wall = std::isinf(radius_b);
  pair.mass = reduced_mass;
  pair.radius = wall ? radius_a : radius_a * radius_b / (radius_a + radius_b);
  pair.allowed = law.max_overlap * 2.0 * (wall ? radius_a : std::min(radius_a, radius_b));
  if (law.pull_per_radius > 0.0) {
    const double single = wall ? single_a : single_a * single_b / (single_a + single_b);
    const double l = pair.radius / single;
    double scale = 1.0;
    for (int power = 1; power < law.scaling_power; ++power) scale *= l;
    pair.pull_off = law.pull_per_radius * pair.radius * scale;
    pair.well = pair.pull_off * law.cutoff_gap;
    pair.pull_stiffness = pair.pull_off / (2.0 * law.cutoff_gap);
  }
  return pair;
}

double first_stiffness(const SurfaceLaw& law, const PairLaw& pair, double speed, double load) {
  if (law.stiffness > 0.0) return law.stiffness;
  // The dashpot and the sub-steps move the peak by up to a few per cent: 5 % more stiffness is 2.5 % less overlap.
  const double impact = 1.05 * stiffness_for_overlap(pair.mass, speed, pair.allowed, law.zeta);
  // At rest adhesion and load press with a force that shall use a tenth of the allowed overlap.
  const double rest = 10.0 * (pair.pull_off + load) / pair.allowed;
  return std::max(impact, rest);
}

}  // namespace puffin::dem
