#include "dem/open_contacts.hpp"

namespace puffin::dem {

double impact_energy(const Contact& c, double mean_mass) {
  const double speed2 = c.normal_speed * c.normal_speed + (c.b >= 0 ? c.tangential_speed * c.tangential_speed : 0.0);
  return 0.5 * mean_mass * speed2;
}

std::vector<ContactEnded> open_contacts(const State& state, double time) { return open_contacts(state, time, {}); }

std::vector<ContactEnded> open_contacts(const State& state, double time, std::span<const std::uint8_t> chosen) {
  const Carriers& all = state.carriers;
  std::vector<ContactEnded> open;
  for (const Contact& c : state.contacts) {
    if (c.phase == ContactPhase::free) continue;
    if (!chosen.empty() && !chosen[c.a] && (c.b < 0 || !chosen[c.b])) continue;
    ContactEnded e;
    e.time_start = c.time_start, e.time_end = time;
    e.a = all.id[c.a], e.b = c.b >= 0 ? all.id[c.b] : -1;
    e.triangle = c.triangle;
    e.normal_speed = c.normal_speed, e.tangential_speed = c.tangential_speed;
    const double mass = all.single_mass(c.a);
    e.energy = impact_energy(c, c.b >= 0 ? 0.5 * (mass + all.single_mass(c.b)) : mass);
    e.max_force = c.max_force, e.max_overlap = c.max_overlap;
    open.push_back(e);
  }
  return open;
}

}  // namespace puffin::dem
