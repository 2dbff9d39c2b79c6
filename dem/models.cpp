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

/// What both contact laws share.
template <class Contact>
void check_common(const Contact& contact) {
  require(contact.restitution > 0.0 && contact.restitution <= 1.0, "restitution", contact.restitution,
          "give 0 < e <= 1 (for a nearly dead impact 0.01)");
  check(contact.friction);
  require(not_negative(contact.rolling_friction), "rolling_friction", contact.rolling_friction, "give a value >= 0");
}

void check(const LinearContact& contact) {
  check_common(contact);
  require(contact.max_overlap > 0.0 && contact.max_overlap <= 0.2, "max_overlap", contact.max_overlap,
          "give a part of the diameter between 0 and 0.2, e.g. 0.02");
  require(contact.tangential_ratio > 0.0 && contact.tangential_ratio <= 1.0, "tangential_ratio",
          contact.tangential_ratio, "give k_t/k between 0 and 1, e.g. 2/7");
  if (contact.stiffness)
    require(positive(*contact.stiffness), "stiffness", *contact.stiffness,
            "give a value > 0 N/m, or leave it automatic");
}

void check(const HertzContact& contact) {
  check_common(contact);
  require(contact.restitution >= 0.01, "restitution", contact.restitution, "a Hertz contact can return 0.01 at least");
  for (const Elasticity& e : {contact.body, contact.partner}) {
    require(positive(e.youngs_modulus), "youngs_modulus", e.youngs_modulus, "give a modulus > 0 Pa, e.g. 24e9");
    require(e.poisson >= 0.0 && e.poisson <= 0.5, "poisson", e.poisson, "give 0 to 0.5, e.g. 0.3");
  }
}

void check(const NoAdhesion&, const ContactModel&) {}

/// What all adhesive laws share.
template <class Law>
void check_attraction(const Law& law) {
  require(positive(law.surface_energy), "surface_energy", law.surface_energy,
          "give a value > 0 J/m^2, or choose no adhesion");
  require(law.spread.sigma >= 0.0 && law.spread.sigma <= 3.0, "sigma of the surface energy", law.spread.sigma,
          "give the deviation of ln(surface_energy), 0 to 3, e.g. 0.5");
}

void check(const Hamaker& hamaker, const ContactModel&) {
  check_attraction(hamaker);
  require(positive(hamaker.cutoff_gap), "cutoff_gap", hamaker.cutoff_gap, "give a gap > 0 m, e.g. 4e-10");
  if (hamaker.hamaker == 0.0) return;
  const double gamma = hamaker.hamaker / (24.0 * std::numbers::pi * hamaker.cutoff_gap * hamaker.cutoff_gap);
  require(std::abs(gamma - hamaker.surface_energy) <= 0.05 * hamaker.surface_energy, "hamaker", hamaker.hamaker,
          "it must agree with surface_energy = H/(24 pi cutoff_gap^2) within 5 %: change one, or leave it out");
}

void check(const Dmt& dmt, const ContactModel&) {
  check_attraction(dmt);
  require(positive(dmt.cutoff_gap), "cutoff_gap", dmt.cutoff_gap, "give a gap > 0 m, e.g. 4e-10");
}

void check(const Jkr& jkr, const ContactModel& contact) {
  check_attraction(jkr);
  if (!std::holds_alternative<HertzContact>(contact))
    throw std::invalid_argument("dem: JKR adhesion on a linear contact; its curve needs the moduli of a Hertz contact");
}

void check(const Surfaces& surfaces) {
  std::visit([](const auto& contact) { check(contact); }, surfaces.contact);
  std::visit([&](const auto& adhesion) { check(adhesion, surfaces.contact); }, surfaces.adhesion);
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
