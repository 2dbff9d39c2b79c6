#pragma once
// Everything about the carriers that changes in time. Plain data; the vectors have one entry a carrier unless stated.

#include <cstdint>
#include <span>
#include <vector>

#include "dem/carriers.hpp"
#include "dem/contact.hpp"
#include "dem/neighbours.hpp"
#include "dem/wall_cache.hpp"

namespace puffin::dem {

/// What a carrier remembers of its rest.
struct RestMemory {
  int steps_at_rest = 0;
  int patience = 1;               // waits for so many times Integration::sleep_steps; grows where sleep does not last
  std::int64_t asleep_since = 0;  // Statistics::steps when it fell asleep
  Eigen::Vector3d load = Eigen::Vector3d::Zero();            // force of air, field and gravity when it fell asleep [N]
  Eigen::Vector3d contact_force = Eigen::Vector3d::Zero();   // sum of its contacts' forces then [N]
  Eigen::Vector3d contact_change = Eigen::Vector3d::Zero();  // how that sum has changed since [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();          // of the load when it fell asleep [N m]
  double hold = 0.0;                                         // what holds it, the weakest contact [N]
};

/// Counts since the start, for reports.
struct Statistics {
  std::int64_t steps = 0;           // calls of advance()
  std::int64_t free_flights = 0;    // carriers moved by the closed form
  std::int64_t contact_steps = 0;   // carriers moved by one sub-step
  std::int64_t sleeping_steps = 0;  // carriers not moved at all
  std::int64_t clusters = 0;        // clusters integrated, repetitions included
  std::int64_t repeated = 0;        // clusters integrated again because the guess was too small
  std::int64_t rebuilds = 0;        // of the neighbour list
  std::int64_t wakes = 0;
  double largest_overlap = 0.0;  // part of the (smaller) diameter
};

struct State {
  Carriers carriers;
  double time = 0.0;                          // [s]
  std::vector<Eigen::Vector3d> drag_impulse;  // given to the carrier by drag in the last call [N s]
  std::vector<RestMemory> rest;
  std::vector<Contact> contacts;            // with free places
  std::vector<std::int32_t> free_contacts;  // their places, the last is used first
  std::vector<std::int32_t> first_contact;  // of each carrier's chain, -1: none
  std::vector<WallCache> walls;
  Neighbours neighbours;
  Statistics statistics;
};

/// Adds carriers at the end. Throws std::invalid_argument unless positions are finite and sizes and masses positive.
void add(std::span<const Carrier> carriers, State& state);

/// Removes the carriers with gone[i] != 0 (one entry a carrier); the others keep their order and their contacts. The
/// contacts of those that go are dropped without an event (open_contacts() tells of them before); sleeping neighbours
/// of those that go wake.
void remove(std::span<const std::uint8_t> gone, State& state);

/// Lets a carrier move again that is asleep, stuck or held.
void wake(std::size_t carrier, State& state);

/// Number of sleeping carriers.
std::size_t count_asleep(const State& state);

}  // namespace puffin::dem
