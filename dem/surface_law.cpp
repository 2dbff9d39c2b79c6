#include "dem/surface_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/dmt.hpp"
#include "dem/linear_contact.hpp"

namespace puffin::dem {

SurfaceLaw::SurfaceLaw(const Surfaces& surfaces) {
  std::visit(
      [this](const auto& contact) {
        restitution = contact.restitution;
        rolling = contact.rolling_friction;
        if (const auto* constant = std::get_if<ConstantFriction>(&contact.friction)) {
          stick = slip = limit = constant->coefficient;
        } else {
          const auto& f = std::get<SpeedFriction>(contact.friction);
          stick = f.stick, slip = f.slip, limit = f.limit, slip_speed = f.slip_speed, limit_speed = f.limit_speed;
        }
      },
      surfaces.contact);
  if (const auto* linear = std::get_if<LinearContact>(&surfaces.contact)) {
    zeta = damping_ratio(linear->restitution);
    peak = peak_overlap_factor(zeta);
    stiffness = linear->stiffness.value_or(0.0);
    max_overlap = linear->max_overlap;
    tangential_ratio = linear->tangential_ratio;
  } else {
    const auto& elastic = std::get<HertzContact>(surfaces.contact);
    hertz = true;
    zeta = hertz_damping(elastic.restitution);
    moduli = pair_moduli(elastic.body.youngs_modulus, elastic.body.poisson, elastic.partner.youngs_modulus,
                         elastic.partner.poisson);
    tangential_ratio = 4.0 * moduli.shear / moduli.normal;  // 8 G* a / (2 E* a)
    rayleigh = rayleigh_time(1.0, 1.0, elastic.body.youngs_modulus, elastic.body.poisson);
  }
  const auto attract = [this](Attraction how, double per_radius, const auto& adhesion) {
    attraction = how;
    pull_per_radius = per_radius;
    scaling_power = 1 + static_cast<int>(adhesion.parcel_scaling);
    spread = adhesion.spread;
  };
  if (const auto* hamaker = std::get_if<Hamaker>(&surfaces.adhesion)) {
    attract(Attraction::well, dmt_pull_off(hamaker->surface_energy, 1.0), *hamaker);
    cutoff_gap = hamaker->cutoff_gap;
  } else if (const auto* dmt = std::get_if<Dmt>(&surfaces.adhesion)) {
    attract(hertz ? Attraction::dmt : Attraction::well, dmt_pull_off(dmt->surface_energy, 1.0), *dmt);
    cutoff_gap = dmt->cutoff_gap;
  } else if (const auto* jkr = std::get_if<Jkr>(&surfaces.adhesion)) {
    attract(Attraction::jkr, 3.0 * std::numbers::pi * jkr->surface_energy, *jkr);
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
                 double reduced_mass, double strength) {
  PairLaw pair;
  const bool wall = std::isinf(radius_b);
  pair.mass = reduced_mass;
  pair.radius = wall ? radius_a : radius_a * radius_b / (radius_a + radius_b);
  pair.allowed = law.max_overlap * 2.0 * (wall ? radius_a : std::min(radius_a, radius_b));
  if (law.attraction == Attraction::none) return pair;
  const double single = wall ? single_a : single_a * single_b / (single_a + single_b);
  const double l = pair.radius / single;
  double scale = strength;
  for (int power = 1; power < law.scaling_power; ++power) scale *= l;
  const double per_radius = law.pull_per_radius * scale;
  if (law.attraction == Attraction::well) {
    pair.pull_off = per_radius * pair.radius;
    pair.well = pair.pull_off * law.cutoff_gap;
    pair.pull_stiffness = pair.pull_off / (2.0 * law.cutoff_gap);
  } else if (law.attraction == Attraction::dmt) {
    pair.constant_pull = per_radius * pair.radius;
    pair.bend = hertz_overlap(law.moduli.normal, pair.radius, pair.constant_pull);
  } else {
    pair.jkr = JkrCurve(per_radius / (1.5 * std::numbers::pi), pair.radius, law.moduli.normal);
    pair.bend = pair.jkr.stretch;
  }
  return pair;
}

double glancing_overlap(const PairLaw& pair, double length, double closing, double speed) {
  constexpr double part = 0.05, least = 0.1;
  if (!(speed > 0.0)) return pair.allowed;
  const double cosine = closing / speed;
  return std::clamp(0.5 * part * length * cosine * cosine, least * pair.allowed, pair.allowed);
}

double first_stiffness(const SurfaceLaw& law, const PairLaw& pair, double speed, double load, double overlap) {
  if (law.hertz) {
    const double e = law.moduli.normal;
    const double deepest = std::max(hertz_peak_overlap(e, pair.radius, pair.mass, speed),
                                    hertz_overlap(e, pair.radius, load + pair.largest_pull()));
    return hertz_stiffness(e, std::max(hertz_radius(pair.radius, deepest), pair.jkr.radius));
  }
  if (law.stiffness > 0.0) return law.stiffness;
  // The dashpot and the sub-steps move the peak by up to a few per cent: 5 % more stiffness is 2.5 % less overlap.
  const double s = speed * law.peak / overlap;  // as stiffness_for_overlap()
  const double impact = 1.05 * pair.mass * s * s;
  // At rest adhesion and load press with a force that shall use a tenth of the allowed overlap.
  const double rest = 10.0 * (pair.pull_off + load) / pair.allowed;
  return std::max(impact, rest);
}

}  // namespace puffin::dem
