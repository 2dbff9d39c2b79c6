#include "coupling/health.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lbm/kernel.hpp"

namespace puffin::coupling {

namespace {

template <class... Args>
[[noreturn]] void diverge(const char* format, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, format, args...);
  throw Diverged(text);
}

long long id_of(const State& state, std::size_t place) {
  return static_cast<long long>(state.carriers.carriers.id[place]);
}

}  // namespace

Health::Health(const Models& models, const State& state, const HealthLimits& limits) : limits_(limits) {
  const dem::Carriers& c = state.carriers.carriers;
  began_inside_.assign(id_range(c), 0);
  for (std::size_t p = 0; p < c.size(); ++p) {
    began_inside_[c.id[p]] = models.walls && models.walls->inside(c.position[p]);
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
  const dem::Carriers& c = state.carriers.carriers;
  for (std::size_t p = 0; p < c.size(); ++p) {
    if (c.rest[p] != dem::Rest::awake || !began_inside_[c.id[p]] || models.walls->inside(c.position[p])) continue;
    const Vec3& x = c.position[p];
    diverge(
        "carrier %lld is outside the walls, at [%.5g, %.5g, %.5g] m, at t = %.6g s with %.4g m/s. Likely causes: "
        "its centre was pushed through a wall by the carriers behind it (a stiffness too low), or a hole in the "
        "surface",
        id_of(state, p), x[0], x[1], x[2], state.time, c.velocity[p].norm());
  }
}

void Health::check_overlaps(const State& state) const {
  const dem::Carriers& c = state.carriers.carriers;
  for (const dem::Contact& contact : state.carriers.contacts) {
    if (contact.phase == dem::ContactPhase::free) continue;
    const double radius = contact.b >= 0 ? std::min(c.radius[contact.a], c.radius[contact.b]) : c.radius[contact.a];
    const double overlap = (contact.max_overlap - contact.offset) / (2.0 * radius);
    if (!(overlap > limits_.overlap)) continue;
    const Vec3& x = c.position[contact.a];
    const std::string other = contact.b >= 0 ? "carrier " + std::to_string(c.id[contact.b])
                                             : "the wall's triangle " + std::to_string(contact.triangle);
    diverge(
        "carrier %lld at [%.5g, %.5g, %.5g] m overlaps %s by %.3g of its diameter at t = %.6g s (limit %.2g). "
        "Likely causes: carriers.contact.stiffness too low for the speeds, or carriers that overlap at the start",
        id_of(state, static_cast<std::size_t>(contact.a)), x[0], x[1], x[2], other.c_str(), overlap, state.time,
        limits_.overlap);
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
