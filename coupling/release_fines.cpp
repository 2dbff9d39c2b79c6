#include "coupling/release_fines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "coupling/first_motion.hpp"
#include "coupling/stencil_loop.hpp"

namespace puffin::coupling {

namespace {

int place_or_throw(const dem::Carriers& carriers, std::int64_t id) {
  const int place = place_of(carriers, id);
  if (place < 0) throw std::invalid_argument("a contact names carrier " + std::to_string(id) + ", which is not there");
  return place;
}

/// Without air everything is kept in one place (keep_fines_in_one_place).
void put_aside(const std::vector<int>& places, const std::vector<double>& amount, Mechanism mechanism,
               lbm::ScalarFields& fields) {
  lbm::CompensatedSum sum;
  for (const int place : places) sum.add(amount[place]);
  for (int set = 0; mechanisms * set < fields.scalars(); ++set)
    fields.amount[scalar_index(set, mechanism)].front() += sum.value();
}

/// Puts `amount` (by place) into the cells, in every set of scalars.
void put_into_air(const Stencils& stencils, const std::vector<double>& amount, Mechanism mechanism,
                  lbm::ScalarFields& fields) {
  for_each_by_tile(stencils, [&](int, const Stencil& stencil) {
    const double fines = amount[stencil.carrier];
    if (fines == 0.0) return;
    for (int set = 0; mechanisms * set < fields.scalars(); ++set) {
      std::vector<double>& cells = fields.amount[scalar_index(set, mechanism)];
      for (const StencilEntry& e : stencils.entries(stencil)) cells[e.slot] += e.weight * fines;
    }
  });
}

}  // namespace

double angle_to_surface(const dem::ContactBegun& contact) {
  return std::clamp(90.0 - contact.angle * 180.0 / std::numbers::pi, 0.0, 90.0);
}

void FinesRelease::begin(std::size_t carriers) {
  in_air_.resize(carriers);
  for (auto& amount : amount_) amount.resize(carriers);
  for (const Stencil& stencil : stencils_.stencils()) {
    in_air_[stencil.carrier] = stencil.count > 0;
    for (auto& amount : amount_) amount[stencil.carrier] = 0.0;
  }
}

void FinesRelease::by_contacts(std::span<const dem::ContactBegun> begun, const std::optional<double>& first_motion,
                               const dem::Carriers& carriers, const micromodels::FinesModels& models,
                               const CellIndex& cells, Fines& fines, lbm::ScalarFields& fields) {
  taken_.assign(begun.size(), Taken{});
  marks_.assign(begun.size(), ContactMark{});
  if (begun.empty() || !first_motion) return;
  places_.clear();
  for (const dem::ContactBegun& contact : begun) {
    places_.push_back(place_or_throw(carriers, contact.a));
    if (contact.b >= 0) places_.push_back(place_or_throw(carriers, contact.b));
  }
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  const bool airless = cells.slots() == 0;  // a scene without air: carry_fines.hpp, keep_fines_in_one_place
  if (!airless) stencils_.build(cells, carriers.position, carriers.radius, places_);
  begin(carriers.size());
  for (const int place : places_) {
    if (!airless) break;
    in_air_[place] = 1;
    for (auto& amount : amount_) amount[place] = 0.0;
  }

  std::size_t contact_index = 0;
  const auto lose = [&](std::int64_t id, Mechanism mechanism, int triangle, const auto& ask) {
    const int place = place_or_throw(carriers, id);
    if (!in_air_[place]) {
      ++fines.without_air;
      return;
    }
    ContactMark& mark = marks_[contact_index];
    const bool first = id == begun[contact_index].a;
    (first ? mark.a_loses : mark.b_loses) = true;
    (first ? mark.drag_a : mark.drag_b) = std::exchange(fines.slip.asked[id], 0.0);
    const micromodels::Taken asked = ask(fines.initial[id], fines.left[id]);
    const Taken taken = take(asked.to_air, asked.to_wall, fines.left[id]);
    amount_[static_cast<int>(mechanism)][place] += taken.air;
    fines.to_air[static_cast<int>(mechanism)].add(taken.air);
    taken_[contact_index].air += taken.air;
    taken_[contact_index].wall += taken.wall;
    if (taken.wall > 0.0) {
      fines.stuck.at(triangle) += taken.wall;
      fines.to_wall.add(taken.wall);
    }
  };
  for (contact_index = 0; contact_index < begun.size(); ++contact_index) {
    const dem::ContactBegun& contact = begun[contact_index];
    if (contact.time < *first_motion) continue;
    const double angle = angle_to_surface(contact);
    if (contact.b < 0) {
      if (contact.triangle < 0) throw std::invalid_argument("a contact with a wall names no triangle");
      lose(contact.a, Mechanism::wall, contact.triangle, [&](double initial, double left) {
        return micromodels::impact_on_wall(models, contact.normal_speed, angle, initial, left);
      });
      continue;
    }
    const double speed = std::hypot(contact.normal_speed, contact.tangential_speed);
    for (const std::int64_t id : {contact.a, contact.b})
      lose(id, Mechanism::particle, -1, [&](double initial, double left) {
        return micromodels::impact_on_carrier(models, speed, angle, initial, left);
      });
  }
  for (const Mechanism mechanism : {Mechanism::wall, Mechanism::particle})
    if (const auto& amount = amount_[static_cast<int>(mechanism)]; airless)
      put_aside(places_, amount, mechanism, fields);
    else
      put_into_air(stencils_, amount, mechanism, fields);
}

void FinesRelease::by_drag(const Stencils& stencils, std::span<const double> slip, double duration,
                           const dem::Carriers& carriers, const micromodels::FinesModels& models, Fines& fines,
                           lbm::ScalarFields& fields) {
  // What has no finite speed is left to the health check: it has no class, and no law knows it.
  // One that is held is not there yet.
  const auto flies = [&](const Stencil& at) {
    return at.count > 0 && std::isfinite(slip[at.carrier]) && carriers.rest[at.carrier] != dem::Rest::held;
  };
  for (const Stencil& stencil : stencils.stencils())
    if (flies(stencil)) fines.slip.add(carriers.id[stencil.carrier], slip[stencil.carrier], duration);
  if (!models.drag_detach) return;
  std::vector<double>& amount = amount_[static_cast<int>(Mechanism::drag)];
  amount.resize(carriers.size());
  lbm::CompensatedSum& to_air = fines.to_air[static_cast<int>(Mechanism::drag)];
  for (const Stencil& stencil : stencils.stencils()) {
    amount[stencil.carrier] = 0.0;
    if (!flies(stencil)) continue;
    const auto id = carriers.id[stencil.carrier];
    const micromodels::Taken asked =
        micromodels::drag(models, slip[stencil.carrier], duration, fines.initial[id], fines.left[id]);
    fines.slip.asked[id] += rate(*models.drag_detach, slip[stencil.carrier]) * duration * fines.initial[id];
    amount[stencil.carrier] = take(asked.to_air, 0.0, fines.left[id]).air;
    to_air.add(amount[stencil.carrier]);
  }
  put_into_air(stencils, amount, Mechanism::drag, fields);
}

}  // namespace puffin::coupling
