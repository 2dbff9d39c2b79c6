// The carriers in a checkpoint: every member of dem::State. A member that is new in dem makes a line here refuse to
// compile: add its name, and give it to the archive unless it is scratch.

#include <algorithm>
#include <cmath>

#include "coupling/checkpoint/checkpoint.hpp"

namespace puffin::coupling {

// Found through the archive's namespace, so not in an unnamed one.

void fields(auto& archive, Is<dem::Carriers> auto& carriers) {
  auto& [id, position, velocity, spin, radius, mass, real, single_radius, rest] = carriers;
  archive(id, position, velocity, spin, radius, mass, real, single_radius, rest);
}

void fields(auto& archive, Is<dem::RestMemory> auto& memory) {
  auto& [steps_at_rest, patience, asleep_since, load, contact_force, contact_change, torque, hold] = memory;
  archive(steps_at_rest, patience, asleep_since, load, contact_force, contact_change, torque, hold);
}

void fields(auto& archive, Is<dem::Contact> auto& contact) {
  auto& [phase, a, b, triangle, next_a, next_b, stiffness, knee_stiffness, slip_stiffness, offset, normal, slip, roll,
         force, normal_force, use, hold, time_start, normal_speed, tangential_speed, max_force, max_overlap] = contact;
  archive(phase, a, b, triangle, next_a, next_b, stiffness, knee_stiffness, slip_stiffness, offset, normal, slip, roll,
          force, normal_force, use, hold, time_start, normal_speed, tangential_speed, max_force, max_overlap);
}

void fields(auto& archive, Is<dem::WallPlane> auto& plane) {
  auto& [point, normal, triangle] = plane;
  archive(point, normal, triangle);
}

void fields(auto& archive, Is<dem::WallCache> auto& cache) {
  auto& [asked_at, clear, trust, planes] = cache;
  archive(asked_at, clear, trust, planes);
}

void fields(auto& archive, Is<dem::Neighbours> auto& neighbours) {
  auto& [begin, list, built_at, budget, valid] = neighbours;
  archive(begin, list, built_at, budget, valid);
}

void fields(auto& archive, Is<dem::Statistics> auto& counts) {
  auto& [steps, free_flights, contact_steps, sleeping_steps, clusters, repeated, rebuilds, wakes, largest_overlap] =
      counts;
  archive(steps, free_flights, contact_steps, sleeping_steps, clusters, repeated, rebuilds, wakes, largest_overlap);
}

void fields(auto& archive, Is<dem::State> auto& state) {
  auto& [carriers, time, drag_impulse, rest, contacts, free_contacts, first_contact, walls, neighbours, statistics] =
      state;
  archive(carriers, time, drag_impulse, rest, contacts, free_contacts, first_contact, walls, neighbours, statistics);
}

namespace {

/// What indices lead to must be there: the file may have been altered with care.
class Check {
 public:
  explicit Check(const dem::State& state) : state_(state), size_(state.carriers.size()) {}

  bool good() const { return lengths() && carriers() && contacts() && chains() && neighbours(); }

 private:
  bool lengths() const {
    const dem::Carriers& c = state_.carriers;
    const auto all = [&](const auto&... arrays) { return ((arrays.size() == size_) && ...); };
    return all(c.position, c.velocity, c.spin, c.radius, c.mass, c.carriers, c.single_radius, c.rest,
               state_.drag_impulse, state_.rest, state_.first_contact, state_.walls);
  }
  bool carriers() const {
    const dem::Carriers& c = state_.carriers;
    for (std::size_t i = 0; i < size_; ++i) {
      if (c.id[i] < 0 || (i > 0 && c.id[i] <= c.id[i - 1]) || c.rest[i] > dem::Rest::held) return false;
      if (!(c.radius[i] > 0.0 && c.mass[i] > 0.0 && c.carriers[i] > 0.0 && c.single_radius[i] > 0.0)) return false;
      if (!c.position[i].allFinite() || !c.velocity[i].allFinite() || !std::isfinite(c.radius[i])) return false;
    }
    return true;
  }
  bool contacts() const {
    const auto place = [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < size_; };
    const auto next = [&](std::int32_t c) { return c >= -1 && c < static_cast<std::int32_t>(state_.contacts.size()); };
    for (const dem::Contact& c : state_.contacts) {
      if (c.phase > dem::ContactPhase::bonded || !next(c.next_a) || !next(c.next_b)) return false;
      if (c.phase == dem::ContactPhase::free) continue;
      if (!place(c.a) || c.a == c.b || (c.b < 0 ? c.b != -1 : !place(c.b))) return false;
    }
    for (const std::int32_t c : state_.free_contacts)
      if (c < 0 || !next(c) || state_.contacts[c].phase != dem::ContactPhase::free) return false;
    return std::all_of(state_.first_contact.begin(), state_.first_contact.end(), next);
  }
  /// Every chain ends, and holds contacts of its own carrier alone; together they hold every live contact.
  bool chains() const {
    std::size_t met = 0, ends = 0;
    for (const dem::Contact& c : state_.contacts)
      if (c.phase != dem::ContactPhase::free) ends += c.b >= 0 ? 2 : 1;
    for (std::size_t i = 0; i < size_; ++i)
      for (std::int32_t c = state_.first_contact[i]; c >= 0;) {
        const dem::Contact& contact = state_.contacts[c];
        const auto carrier = static_cast<std::int32_t>(i);
        if (contact.phase == dem::ContactPhase::free || (contact.a != carrier && contact.b != carrier)) return false;
        if (++met > ends) return false;
        c = contact.a == carrier ? contact.next_a : contact.next_b;
      }
    return met == ends;
  }
  bool neighbours() const {
    const dem::Neighbours& n = state_.neighbours;
    if (!n.valid) return true;
    if (n.begin.size() != size_ + 1 || n.built_at.size() != size_ || n.budget.size() != size_ || n.begin[0] != 0)
      return false;
    if (!std::is_sorted(n.begin.begin(), n.begin.end()) || n.begin.back() != static_cast<std::int32_t>(n.list.size()))
      return false;
    return std::all_of(n.list.begin(), n.list.end(),
                       [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < size_; });
  }

  const dem::State& state_;
  std::size_t size_;
};

}  // namespace

void save_carriers(const dem::State& carriers, std::vector<std::byte>& bytes) {
  ByteWriter writer(bytes);
  fields(writer, carriers);
}

void restore_carriers(const std::vector<std::byte>& bytes, dem::State& carriers) {
  ByteReader reader(bytes, "carriers");
  fields(reader, carriers);
  reader.finish();
  if (!Check(carriers).good()) reader.fail("contradicts itself");
}

}  // namespace puffin::coupling
