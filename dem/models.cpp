#include "dem/models.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

namespace puffin::dem {
namespace {

void require(bool good, const std::string& what, double value, const std::string& remedy) {
  if (good) return;
  std::ostringstream text;
  text << "dem: " << what << " = " << value << "; " << remedy;
  throw std::invalid_argument(text.str());
}

bool not_negative(double value) { return std::isfinite(value) && value >= 0.0; }
bool positive(double value) { return std::isfinite(value) && value > 0.0; }

void check(const Friction& friction) {
  if (const auto* constant = std::get_if<ConstantFriction>(&friction)) {
    require(not_negative(constant->coefficient), "friction", constant->coefficient, "give a coefficient >= 0");
    return;
  }
  const auto& f = std::get<SpeedFriction>(friction);
  for (const double mu : {f.stick, f.slip, f.limit})
    require(not_negative(mu), "friction coefficient", mu, "give coefficients stick, slip, limit >= 0");
  require(positive(f.slip_speed), "slip_speed", f.slip_speed, "give a speed > 0");
  require(std::isfinite(f.limit_speed) && f.limit_speed > f.slip_speed, "limit_speed", f.limit_speed,
          "give a speed above slip_speed");
}

void check(const Surfaces& surfaces) {
  const auto& contact = std::get<LinearContact>(surfaces.contact);
  require(contact.restitution > 0.0 && contact.restitution <= 1.0, "restitution", contact.restitution,
          "give 0 < e <= 1 (for a nearly dead impact 0.01)");
  check(contact.friction);
  require(not_negative(contact.rolling_friction), "rolling_friction", contact.rolling_friction, "give a value >= 0");
  require(contact.max_overlap > 0.0 && contact.max_overlap <= 0.2, "max_overlap", contact.max_overlap,
          "give a part of the diameter between 0 and 0.2, e.g. 0.02");
  require(contact.tangential_ratio > 0.0 && contact.tangential_ratio <= 1.0, "tangential_ratio",
          contact.tangential_ratio, "give k_t/k between 0 and 1, e.g. 2/7");
  if (contact.stiffness)
    require(positive(*contact.stiffness), "stiffness", *contact.stiffness,
            "give a value > 0 N/m, or leave it automatic");
  if (const auto* hamaker = std::get_if<Hamaker>(&surfaces.adhesion)) {
    require(positive(hamaker->surface_energy), "surface_energy", hamaker->surface_energy,
            "give a value > 0 J/m^2, or choose no adhesion");
    require(positive(hamaker->cutoff_gap), "cutoff_gap", hamaker->cutoff_gap, "give a gap > 0 m, e.g. 4e-10");
    if (hamaker->hamaker != 0.0) {
      const double d0 = hamaker->cutoff_gap;
      const double gamma = hamaker->hamaker / (24.0 * std::numbers::pi * d0 * d0);
      require(std::abs(gamma - hamaker->surface_energy) <= 0.05 * hamaker->surface_energy, "hamaker", hamaker->hamaker,
              "it must agree with surface_energy = H/(24 pi cutoff_gap^2) within 5 %: change one, or leave it out");
    }
  }
}

}  // namespace

void check(const Models& models) {
  check(models.carrier);
  check(models.wall);
  require(models.gravity.allFinite(), "gravity", models.gravity.norm(), "give three finite numbers");
  const Integration& in = models.integration;
  require(in.steps_per_contact >= 10.0 && in.steps_per_contact <= 1e4, "steps_per_contact", in.steps_per_contact,
          "give 10 to 10000, e.g. 20");
  require(in.skin > 0.0 && in.skin <= 2.0, "skin", in.skin, "give 0 to 2 diameters, e.g. 0.2");
  require(in.sleep_steps > 0, "sleep_steps", in.sleep_steps, "give at least 1");
  require(in.sleep_use > 0.0 && in.sleep_use <= 1.0, "sleep_use", in.sleep_use, "give 0 to 1, e.g. 0.8");
  require(in.wake_change > 0.0 && in.sleep_use + in.wake_change <= 1.0, "wake_change", in.wake_change,
          "sleep_use + wake_change must not exceed 1, or carriers would sleep through their release");
}

}  // namespace puffin::dem
