#include "coupling/collisions.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "coupling/first_motion.hpp"

namespace puffin::coupling {

Collisions::Collisions(const dem::Carriers& all, std::size_t triangles)
    : contacts(id_range(all), 0), carriers(contacts.size(), 0.0), hits(triangles, 0.0), energy(triangles, 0.0) {
  for (std::size_t i = 0; i < all.size(); ++i) carriers[all.id[i]] = all.carriers[i];
}

namespace {
int found(const dem::Carriers& carriers, std::int64_t id) {
  const int place = place_of(carriers, id);
  if (place < 0) throw std::invalid_argument("a contact names carrier " + std::to_string(id) + ", which is not there");
  return place;
}
}  // namespace

double impact_energy(const dem::ContactBegun& contact, const dem::Carriers& carriers) {
  const double normal = contact.normal_speed * contact.normal_speed;
  double mass = carriers.single_mass(found(carriers, contact.a));
  if (contact.b < 0) return 0.5 * mass * normal;
  mass = 0.5 * (mass + carriers.single_mass(found(carriers, contact.b)));
  return 0.5 * mass * (normal + contact.tangential_speed * contact.tangential_speed);
}

void count_collisions(std::span<const dem::ContactBegun> begun, const dem::Carriers& carriers,
                      const std::optional<double>& first_motion, Collisions& collisions) {
  if (!first_motion) return;
  for (const dem::ContactBegun& contact : begun) {
    if (contact.time < *first_motion) continue;
    const double energy = impact_energy(contact, carriers);
    const double count = carriers.carriers[found(carriers, contact.a)];
    ++collisions.contacts[contact.a];
    if (contact.b < 0) {
      collisions.wall += count;
      collisions.wall_energy.add(count * energy);
      if (contact.triangle >= 0) {
        collisions.hits.at(contact.triangle) += count;
        collisions.energy.at(contact.triangle) += count * energy;
      }
      continue;
    }
    const double both = count + carriers.carriers[found(carriers, contact.b)];
    ++collisions.contacts[contact.b];
    collisions.particle += both;
    collisions.particle_energy.add(both * energy);
  }
}

std::optional<double> median_contacts(const Collisions& collisions, std::span<const std::uint8_t> chosen) {
  std::vector<std::pair<std::int64_t, double>> counts;  // contacts, real carriers that had so many
  double total = 0.0;
  for (std::size_t id = 0; id < collisions.contacts.size(); ++id) {
    if (collisions.carriers[id] <= 0.0 || (!chosen.empty() && !chosen[id])) continue;
    counts.emplace_back(collisions.contacts[id], collisions.carriers[id]);
    total += collisions.carriers[id];
  }
  if (counts.empty()) return std::nullopt;
  std::sort(counts.begin(), counts.end());
  double passed = 0.0;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    passed += counts[n].second;
    if (passed < 0.5 * total) continue;
    const bool between = passed == 0.5 * total && n + 1 < counts.size();
    return between ? 0.5 * static_cast<double>(counts[n].first + counts[n + 1].first)
                   : static_cast<double>(counts[n].first);
  }
  return static_cast<double>(counts.back().first);
}

std::optional<double> mean_wall_energy(const Collisions& c) {
  return c.wall > 0.0 ? std::optional(c.wall_energy.value() / c.wall) : std::nullopt;
}
std::optional<double> mean_particle_energy(const Collisions& c) {
  return c.particle > 0.0 ? std::optional(c.particle_energy.value() / c.particle) : std::nullopt;
}

}  // namespace puffin::coupling
