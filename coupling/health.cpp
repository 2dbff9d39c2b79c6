#include "coupling/health.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "coupling/divergence.hpp"
#include "lbm/kernel.hpp"

namespace puffin::coupling {

namespace {

long long id_of(const State& state, std::size_t place) {
  return static_cast<long long>(state.carriers.carriers.id[place]);
}

/// Who is in contact with carrier `a`: carrier `b`, or a wall where b < 0.
std::string partner(std::int64_t b, int triangle) {
  return b >= 0 ? "carrier " + std::to_string(b) : "the wall's triangle " + std::to_string(triangle);
}

/// `overlap`: part of the (smaller) diameter.
[[noreturn]] void report_overlap(const std::string& carrier, const std::string& other, double overlap, double time,
                                 double limit) {
  diverge(
      "%s overlaps %s by %.3g of its diameter at t = %.6g s (limit %.2g). Likely causes: carriers.contact.stiffness "
      "or youngs_modulus too low for the speeds, or carriers that overlap at the start",
      carrier.c_str(), other.c_str(), overlap, time, limit);
}

std::string with_place(long long id, const Vec3& x) {
  char text[120];
  std::snprintf(text, sizeof text, "carrier %lld at [%.5g, %.5g, %.5g] m", id, x[0], x[1], x[2]);
  return text;
}

}  // namespace

Health::Health(const Models& models, const State& state, const HealthLimits& limits) : limits_(limits) {
  const dem::Carriers& c = state.carriers.carriers;
  began_inside_.assign(id_range(c), 0);
  for (std::size_t p = 0; p < c.size(); ++p) {
    began_inside_[c.id[p]] = models.walls && models.walls->encloses(c.position[p]);
    fastest_start_ = std::max(fastest_start_, c.velocity[p].norm());
  }
}

void Health::check(const Models& models, const State& state) const {
  check_motion(state);
  check_walls(models, state);
  check_overlaps(state);
  check_ledgers(state);
}

void Health::check_motion(const State& state) const {
  const dem::Carriers& c = state.carriers.carriers;
  const double limit = state.air ? limits_.speed * std::max(lbm::speed_limit * state.scale.speed(), fastest_start_)
                                 : std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < c.size(); ++p) {
    const Vec3& x = c.position[p];
    if (!x.allFinite() || !c.velocity[p].allFinite() || !c.spin[p].allFinite())
      diverge(
          "carrier %lld left the finite numbers before t = %.6g s, at [%.5g, %.5g, %.5g] m. Likely causes: a "
          "contact that is too stiff for its step, or air that diverged around it",
          id_of(state, p), state.time, x[0], x[1], x[2]);
    const double speed = c.velocity[p].norm();
    if (speed > limit)
      diverge(
          "carrier %lld at [%.5g, %.5g, %.5g] m moves at %.4g m/s at t = %.6g s (limit %.4g m/s). Likely causes: "
          "carriers that overlap at the start, or a contact stiffness that does not suit their mass",
          id_of(state, p), x[0], x[1], x[2], speed, state.time, limit);
  }
}

void Health::check_walls(const Models& models, const State& state) const {
  if (!models.walls) return;
  // Those that left through an opening are no longer there (advance.cpp): who is outside went through a wall, even if
  // an opening is the nearest surface by now.
  const dem::Carriers& c = state.carriers.carriers;
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (c.rest[p] != dem::Rest::awake || !began_inside_[c.id[p]] || models.walls->encloses(c.position[p])) continue;
    const Vec3& x = c.position[p];
    diverge(
        "carrier %lld is outside the walls, at [%.5g, %.5g, %.5g] m, at t = %.6g s with %.4g m/s. Likely causes: "
        "its centre was pushed through a wall (carriers.contact.stiffness or youngs_modulus too low for its speed or "
        "for the carriers behind it), or a hole in the surface",
        id_of(state, p), x[0], x[1], x[2], state.time, c.velocity[p].norm());
  }
}

void Health::check_overlaps(const State& state) const {
  const dem::Carriers& c = state.carriers.carriers;
  for (const dem::Contact& contact : state.carriers.contacts) {
    if (contact.phase == dem::ContactPhase::free) continue;
    const double radius = contact.b >= 0 ? std::min(c.radius[contact.a], c.radius[contact.b]) : c.radius[contact.a];
    const double overlap = contact.max_overlap / (2.0 * radius);  // what was there from its start is not in it
    if (!(overlap > limits_.overlap)) continue;
    report_overlap(with_place(id_of(state, static_cast<std::size_t>(contact.a)), c.position[contact.a]),
                   partner(contact.b >= 0 ? c.id[contact.b] : -1, contact.triangle), overlap, state.time,
                   limits_.overlap);
  }
}

void Health::check_impacts(const Models& models, const State& state) const {
  if (!(state.carriers.statistics.largest_overlap > limits_.overlap)) return;
  check(models, state);  // a carrier that went through a wall tells more than its overlap
  const dem::Carriers& c = state.carriers.carriers;
  // One that has left in the same exchange has no place any more, and no radius: its partner's must do.
  const auto place_of = [&](std::int64_t id) { return std::find(c.id.begin(), c.id.end(), id); };
  for (const dem::ContactEnded& contact : state.events.ended) {
    const auto a = place_of(contact.a), b = place_of(contact.b);
    double radius = std::numeric_limits<double>::infinity();
    for (const auto& one : {a, b})
      if (one != c.id.end()) radius = std::min(radius, c.radius[static_cast<std::size_t>(one - c.id.begin())]);
    const double overlap = contact.max_overlap / (2.0 * radius);
    if (!(overlap > limits_.overlap)) continue;
    report_overlap(a != c.id.end() ? with_place(contact.a, c.position[static_cast<std::size_t>(a - c.id.begin())])
                                   : "carrier " + std::to_string(contact.a) + ", which has left,",
                   partner(contact.b, contact.triangle), overlap, contact.time_end, limits_.overlap);
  }
}

void Health::check_ledgers(const State& state) const {
  for (int set = 0; mechanisms * set < state.scalars.scalars(); ++set) {
    const Ledger books = ledger(state.fines, state.scalars, state.budget, set);
    if (std::abs(books.error()) <= limits_.ledger) continue;  // a NaN is over the limit
    diverge(
        "the fines of scalar set %d do not add up at t = %.6g s: error %.3g of the dose (limit %.2g); %.6g loaded, "
        "%.6g in the air, %.6g emitted. Likely cause: the air's mass fluxes are no longer sound",
        set, state.time, books.error(), limits_.ledger, books.loaded, books.in_air, books.emitted);
  }
}

}  // namespace puffin::coupling
