#pragma once
// Counting contacts, for the tables of results. Everything is counted per real carrier: a parcel of 10 that hits a wall
// counts 10; a contact of two parcels of 10 counts 10 for each partner. Contacts that begin before the first motion
// belong to the settling of the dose: they are in the log of events, but not counted.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dem/carriers.hpp"
#include "dem/events.hpp"
#include "lbm/scalars/compensated_sum.hpp"

namespace puffin::coupling {

/// The counts. Plain data; belongs in a checkpoint.
struct Collisions {
  Collisions() = default;
  Collisions(const dem::Carriers& carriers, std::size_t triangles);

  // by carrier id
  std::vector<std::int64_t> contacts;  // with walls and carriers, of each real carrier of the entry
  std::vector<double> carriers;        // real carriers of the entry
  // by wall triangle
  std::vector<double> hits;    // of real carriers
  std::vector<double> energy;  // sum over real carriers [J]
  // totals over real carriers
  double wall = 0.0, particle = 0.0;
  lbm::CompensatedSum wall_energy, particle_energy;  // [J]
};

/// 1/2 m v^2 [J] at first touch: m of one real carrier (mean of the two partners), v the wall-normal speed, or between
/// carriers the relative speed, before adhesion pulls.
double impact_energy(const dem::ContactBegun& contact, const dem::Carriers& carriers);

/// Counts the contacts that began at `first_motion` [s] or later; none if it has no value. Both partners must still be
/// in `carriers`, whose ids ascend. Throws std::invalid_argument if a carrier is not there.
void count_collisions(std::span<const dem::ContactBegun> begun, const dem::Carriers& carriers,
                      const std::optional<double>& first_motion, Collisions& collisions);

/// Median over real carriers of the contacts of a carrier; only those with chosen[id] != 0 if `chosen` is given (by
/// id). No value if there are none. With an even number it is the mean of the middle two.
std::optional<double> median_contacts(const Collisions& collisions, std::span<const std::uint8_t> chosen = {});

/// [J]; no value without contacts.
std::optional<double> mean_wall_energy(const Collisions& collisions);
std::optional<double> mean_particle_energy(const Collisions& collisions);

}  // namespace puffin::coupling
