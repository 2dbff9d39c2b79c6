#include "dem/state.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "dem/chains.hpp"

namespace puffin::dem {

std::int32_t link(const Contact& contact, State& state) {
  std::int32_t place;
  if (state.free_contacts.empty()) {
    place = static_cast<std::int32_t>(state.contacts.size());
    state.contacts.push_back(contact);
  } else {
    place = state.free_contacts.back();
    state.free_contacts.pop_back();
    state.contacts[place] = contact;
  }
  Contact& c = state.contacts[place];
  c.next_a = state.first_contact[c.a];
  state.first_contact[c.a] = place;
  c.next_b = -1;
  if (c.b >= 0) {
    c.next_b = state.first_contact[c.b];
    state.first_contact[c.b] = place;
  }
  return place;
}

void unlink(std::int32_t place, State& state) {
  const Contact gone = state.contacts[place];
  for (const std::int32_t carrier : {gone.a, gone.b}) {
    if (carrier < 0) continue;
    const std::int32_t after = carrier == gone.a ? gone.next_a : gone.next_b;
    std::int32_t* pointer = &state.first_contact[carrier];
    while (*pointer != place) {
      Contact& c = state.contacts[*pointer];
      pointer = c.a == carrier ? &c.next_a : &c.next_b;
    }
    *pointer = after;
  }
  state.contacts[place] = Contact{};
  state.free_contacts.push_back(place);
}

Eigen::Vector3d contact_force(const State& state, std::int32_t carrier) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for_each_contact(state, carrier, [&](std::int32_t c) {
    const Contact& contact = state.contacts[c];
    sum += contact.a == carrier ? contact.force : Eigen::Vector3d(-contact.force);
  });
  return sum;
}

void add(std::span<const Carrier> added, State& state) {
  for (const Carrier& c : added) {
    const auto fail = [&](const std::string& what) {
      throw std::invalid_argument("dem: carrier " + std::to_string(c.id) + ": " + what);
    };
    if (!c.position.allFinite() || !c.velocity.allFinite() || !c.spin.allFinite())
      fail("position, velocity and spin must be finite numbers");
    if (!(c.radius > 0.0) || !std::isfinite(c.radius)) fail("radius must be > 0 m");
    if (!(c.mass > 0.0) || !std::isfinite(c.mass)) fail("mass must be > 0 kg");
    if (!(c.carriers > 0.0)) fail("an entry must stand for more than 0 carriers");
    if (!(c.single_radius >= 0.0) || c.single_radius > c.radius * (1.0 + 1e-9))
      fail("single_radius must lie between 0 and radius");
  }
  Carriers& all = state.carriers;
  for (const Carrier& c : added) {
    all.id.push_back(c.id);
    all.position.push_back(c.position);
    all.velocity.push_back(c.velocity);
    all.spin.push_back(c.spin);
    all.radius.push_back(c.radius);
    all.mass.push_back(c.mass);
    all.carriers.push_back(c.carriers);
    all.single_radius.push_back(c.single_radius > 0.0 ? c.single_radius : c.radius);
    all.rest.push_back(Rest::awake);
  }
  const std::size_t n = all.size();
  state.drag_impulse.resize(n, Eigen::Vector3d::Zero());
  state.rest.resize(n);
  state.first_contact.resize(n, -1);
  state.walls.resize(n);
  state.neighbours.valid = false;
}

void remove(std::span<const std::uint8_t> gone, State& state) {
  const std::size_t n = state.carriers.size();
  if (gone.size() != n) throw std::invalid_argument("dem: remove() needs one flag a carrier");
  if (std::none_of(gone.begin(), gone.end(), [](std::uint8_t g) { return g != 0; })) return;

  for (std::size_t i = 0; i < n; ++i) {
    if (!gone[i]) continue;
    for_each_contact(state, static_cast<std::int32_t>(i), [&](std::int32_t c) {
      const Contact& contact = state.contacts[c];
      const std::int32_t other = contact.a == static_cast<std::int32_t>(i) ? contact.b : contact.a;
      if (other >= 0 && state.carriers.rest[other] == Rest::asleep) wake(other, state);
      unlink(c, state);
    });
  }
  std::vector<std::int32_t> place(n, -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (!gone[i]) place[i] = static_cast<std::int32_t>(kept++);

  const auto squeeze = [&](auto& values) {
    for (std::size_t i = 0; i < n; ++i)
      if (place[i] >= 0 && place[i] != static_cast<std::int32_t>(i)) values[place[i]] = std::move(values[i]);
    values.resize(kept);
  };
  Carriers& all = state.carriers;
  squeeze(all.id), squeeze(all.position), squeeze(all.velocity), squeeze(all.spin);
  squeeze(all.radius), squeeze(all.mass), squeeze(all.carriers), squeeze(all.single_radius), squeeze(all.rest);
  squeeze(state.drag_impulse), squeeze(state.rest), squeeze(state.first_contact), squeeze(state.walls);
  for (Contact& c : state.contacts) {
    if (c.phase == ContactPhase::free) continue;
    c.a = place[c.a];
    if (c.b >= 0) c.b = place[c.b];
  }
  state.neighbours.valid = false;
}

constexpr std::int64_t lasting = 10;  // times what it had waited for: a sleep that was worth it
constexpr int most_patience = 64;     // times Integration::sleep_steps

void wake(std::size_t carrier, State& state) {
  if (state.carriers.rest[carrier] == Rest::awake) return;
  state.carriers.rest[carrier] = Rest::awake;
  RestMemory& rest = state.rest[carrier];
  const bool napped = state.statistics.steps - rest.asleep_since < lasting * rest.steps_at_rest;
  const int patience = napped ? 2 * std::clamp(rest.patience, 1, most_patience / 2) : 1;
  rest = RestMemory{};
  rest.patience = patience;
  ++state.statistics.wakes;
}

std::size_t count_asleep(const State& state) {
  return static_cast<std::size_t>(std::count(state.carriers.rest.begin(), state.carriers.rest.end(), Rest::asleep));
}

}  // namespace puffin::dem
