// Air, fines, ledgers and counts in a checkpoint: see checkpoint.hpp for what is left out. A member that is new in one
// of these structs makes a line here refuse to compile: add its name, and give it to the archive unless the next step
// makes it anew.

#include <algorithm>
#include <cmath>

#include "coupling/checkpoint/checkpoint.hpp"
#include "coupling/checkpoint/hash.hpp"

namespace puffin::coupling {

// Found through the archive's namespace, so not in an unnamed one.

void fields(auto& archive, Is<FirstMotion::Place> auto& place) {
  auto& [position, settled] = place;
  archive(position, settled);
}

void fields(auto& archive, Is<Departure> auto& departure) {
  auto& [id, time, patch, carriers] = departure;
  archive(id, time, patch, carriers);
}

void fields(auto& archive, Is<MomentumBooking> auto& momentum) {
  auto& [given, taken, rounding, exchanged] = momentum;
  archive(given, taken, rounding, exchanged);
}

void fields(auto& archive, Is<Effort> auto& effort) {
  auto& [air, links, exchange, carriers, fines, scalars, exchanges, exchanges_saved, scalar_steps, scalar_steps_off,
         rescalings, steps_at_reference_dt] = effort;
  archive(air, links, exchange, carriers, fines, scalars, exchanges, exchanges_saved, scalar_steps, scalar_steps_off,
          rescalings, steps_at_reference_dt);
}

void fields(auto& archive, Is<Extremes> auto& extremes) {
  auto& [max_speed_lu, min_dt, max_dt, min_tau] = extremes;
  archive(max_speed_lu, min_dt, max_dt, min_tau);
}

void fields(auto& archive, Is<lbm::MassBook> auto& book) {
  auto& [cells, booked, missing, returned, corrections] = book;
  archive(cells, booked, missing, returned, corrections);
}

void fields(auto& archive, Is<Fines> auto& fines) {
  auto& [initial, left, emitted, stuck, placed, loaded, to_air, to_wall, regained, picked_up, without_air, slip] =
      fines;
  archive(initial, left, emitted, stuck, placed, loaded, to_air, to_wall, regained, picked_up, without_air,
          slip.seconds, slip.metres, slip.asked);
}

void fields(auto& archive, Is<Collisions> auto& collisions) {
  auto& [contacts, carriers, hits, energy, wall, particle, wall_energy, particle_energy] = collisions;
  archive(contacts, carriers, hits, energy, wall, particle, wall_energy, particle_energy);
}

void fields(auto& archive, Is<lbm::ScalarBudget> auto& budget) {
  auto& [left, entered, absorbed_at, air_mismatch, sub_steps, cells_computed, cells_skipped] = budget;
  archive(left, entered, absorbed_at, air_mismatch, sub_steps, cells_computed, cells_skipped);
}

void fields(auto& archive, Is<lbm::ScalarFields> auto& scalars) {
  auto& [amount, reversed, air, work] = scalars;
  archive(amount, reversed, air, work.computed);  // of the scratch, what the next update compares the air in
}

namespace {

/// What is neither air nor carriers nor fines.
void time_fields(auto& archive, Is<State> auto& state) {
  auto& [time, scale, step_factor, air, air_mass, drive, inlet_way, cells, touched, carriers, fines, collisions,
         first_motion, departures, events, stencils, stencils_at, forced, samples, gradients, spreader, impulse_on_air,
         force_on_air, exchange_seconds, load_rate, momentum, loads, pores, pressure_forces, release, scalars, budget,
         fluxes, routes, steps_since_scalars, steps_per_scalar_update, airborne, fines_drift, effort, extremes] = state;
  // Of the drive, what the fines read that are carried before the next air step, if the time step changes there.
  archive(time, scale.dt, step_factor, air_mass, drive.speed, drive.uniform_force, inlet_way, collisions, departures,
          pores.share, stencils_at.position, stencils_at.radius, impulse_on_air, force_on_air, exchange_seconds,
          load_rate, momentum, steps_since_scalars, steps_per_scalar_update, airborne, fines_drift, effort, extremes);
}

/// The lattice belongs to the case; of the air only what moves. What walls keep of their cells they find again from the
/// populations before each collision.
void air_fields(auto& archive, auto& air) {
  auto& [rows, links, boundaries, normal, options, populations, moments, force, run_flags, run_of_slot, les, gradients,
         fluid, fluid_cells, partial, markers, wall_model, steps, limited, backflow] = air;
  archive(steps, limited, backflow);
  std::visit([&](auto& p) { archive(p.next, p.f); }, populations);
}

/// Lengths of everything that a built state has and a restored one must have too.
struct Sizes {
  std::size_t populations = 0, runs = 0, triangles = 0, ids = 0, scalars = 0, slots = 0, patches = 0;
  explicit Sizes(const State& s)
      : triangles(s.collisions.hits.size()), ids(s.collisions.contacts.size()), scalars(s.scalars.amount.size()) {
    if (!s.air) {
      slots = s.scalars.air.size();  // the one place of fines without air, or none
      return;
    }
    populations = std::visit([](const auto& p) { return p.f.size(); }, s.air->populations);
    runs = s.air->rows.runs().size();
    slots = s.air->rows.slots();
    patches = s.budget.left.empty() ? 0 : s.budget.left.front().size();
  }

  bool fit(const State& s) const {
    const Sizes now(s);
    if (now.populations != populations || now.triangles != triangles || now.ids != ids || now.scalars != scalars)
      return false;
    const auto by_id = [&](const auto&... arrays) { return ((arrays.size() == ids) && ...); };
    if (!by_id(s.collisions.carriers, s.fines.initial, s.fines.left, s.fines.emitted, s.first_motion.places(),
               s.fines.slip.asked))
      return false;
    if (s.fines.slip.seconds.size() != ids * SlipHistory::classes ||
        s.fines.slip.metres.size() != ids * SlipHistory::classes)
      return false;
    if (!s.pores.share.empty() && s.pores.share.size() != slots) return false;
    if (s.collisions.energy.size() != triangles || s.fines.stuck.size() != triangles) return false;
    if (!s.carriers.carriers.id.empty() && static_cast<std::size_t>(s.carriers.carriers.id.back()) >= ids) return false;
    for (const auto& drift : s.fines_drift)
      if (!drift.empty() && drift.size() != slots) return false;
    const std::size_t driven = s.air ? s.air->boundaries.size() : 0, first = s.air && s.air->steps > 0 ? driven : 0;
    if (s.drive.speed.size() != driven && s.drive.speed.size() != first) return false;
    if (s.stencils_at.position.size() != s.stencils_at.radius.size()) return false;
    for (const auto* owed : {&s.impulse_on_air, &s.force_on_air})
      if (!owed->empty() && owed->size() != s.stencils_at.position.size()) return false;
    if (s.impulse_on_air.size() != s.force_on_air.size()) return false;
    return scalars_fit(s);
  }

  /// Into a state that was only half restored: an older checkpoint is measured by what it was built with.
  void put_back(State& s) const {
    s.collisions.hits.resize(triangles);
    s.collisions.contacts.resize(ids);
    s.scalars.amount.resize(scalars);
    if (!s.air) {
      s.scalars.air.resize(slots);
      return;
    }
    std::visit([&](auto& p) { p.f.resize(populations); }, s.air->populations);
    s.budget.left.assign(scalars, std::vector<lbm::CompensatedSum>(patches));
  }

 private:
  bool scalars_fit(const State& s) const {
    const auto each = [](const auto& lists, std::size_t size) {
      return std::all_of(lists.begin(), lists.end(), [&](const auto& list) { return list.size() == size; });
    };
    const std::size_t none = scalars == 0 ? 0 : slots;
    if (s.scalars.air.size() != none || s.scalars.work.computed.size() != (scalars == 0 ? 0 : runs)) return false;
    if (s.budget.left.size() != scalars || s.budget.entered.size() != scalars) return false;
    return s.budget.absorbed_at.size() == scalars && each(s.scalars.amount, slots) && each(s.budget.left, patches) &&
           each(s.budget.entered, patches) && each(s.budget.absorbed_at, slots);
  }
};

/// The stencils on which the reaction of the last interval will be laid, and a lattice without forces as before it.
void rebuild_stencils(State& s) {
  Spreader::clear(s.forced, s.air->force);
  s.forced.clear();
  std::vector<int> all(s.stencils_at.position.size());
  for (std::size_t p = 0; p < all.size(); ++p) all[p] = static_cast<int>(p);
  s.stencils.build(s.cells, s.stencils_at.position, s.stencils_at.radius, all);
}

/// The shared cells are those whose part of air is not one; what else belongs to them is made anew.
void rebuild_pores(State& s) {
  const std::vector<double> share = std::move(s.pores.share);
  s.pores = lbm::make_pore_space(*s.air);
  std::vector<std::int32_t> slots;
  for (std::size_t n = 0; n < share.size(); ++n) {
    if (share[n] == 1.0) continue;
    if (s.air->run_of_slot[n] < 0 || !(share[n] > 0.0) || !(share[n] < 1.0))
      throw CheckpointDamaged("its volume fractions make no sense");
    slots.push_back(static_cast<std::int32_t>(n));
  }
  s.pores.share = share;
  lbm::set_shared(slots, std::vector<double>(slots.size(), 0.0), *s.air, s.pores);
}

template <class T>
void hash_in(const std::vector<T>& values, std::uint64_t& hash) {
  hash = xxh64(std::as_bytes(std::span(values)), hash);
}

/// Throws CheckpointDamaged with a state that may have other sizes than it was built with.
void overwrite(const Checkpoint& checkpoint, const Sizes& sizes, State& state) {
  ByteReader time(checkpoint.at("time"), "time");
  time_fields(time, state);
  std::vector<FirstMotion::Place> places;
  std::optional<double> first_motion;
  time(places, first_motion);
  time.finish();
  state.first_motion.restore(std::move(places), first_motion);
  if (state.air) {
    ByteReader air(checkpoint.at("air"), "air");
    air_fields(air, *state.air);
    air.finish();
    if (state.air->parity() != lbm::Parity::even && state.air->parity() != lbm::Parity::odd)
      air.fail("names no step of the lattice");
  }
  restore_carriers(checkpoint.at("carriers"), state.carriers);
  ByteReader fines(checkpoint.at("fines"), "fines");
  fines(state.fines, state.scalars, state.budget);
  fines.finish();
  if (!sizes.fit(state)) throw CheckpointDamaged("its sections do not fit each other or this case");
  if (state.pores.share.empty())
    state.pores = lbm::PoreSpace{};
  else
    rebuild_pores(state);
  const auto sound = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!sound(state.scale.dt) || !sound(state.step_factor) || !(state.time >= 0.0) || !std::isfinite(state.time))
    throw CheckpointDamaged("its time or time step makes no sense");
  state.events.clear();
  if (state.air) try {
      rebuild_stencils(state);
    } catch (const std::invalid_argument& e) {
      throw CheckpointDamaged(std::string("its carriers make no sense: ") + e.what());
    }
}

}  // namespace

void save(const State& state, Checkpoint& checkpoint) {
  ByteWriter time(checkpoint.renew("time"));
  time_fields(time, state);
  time(state.first_motion.places(), state.first_motion.time());
  if (state.air) {
    ByteWriter air(checkpoint.renew("air"));
    air_fields(air, *state.air);
  }
  save_carriers(state.carriers, checkpoint.renew("carriers"));
  ByteWriter fines(checkpoint.renew("fines"));
  fines(state.fines, state.scalars, state.budget);
}

void restore(const Checkpoint& checkpoint, State& state) {
  const Sizes sizes(state);
  try {
    overwrite(checkpoint, sizes, state);
  } catch (const CheckpointDamaged&) {
    sizes.put_back(state);
    throw;
  }
}

std::uint64_t fingerprint(const State& state) {
  if (!state.air) return 0;
  const lbm::Air& air = *state.air;
  // Raised when the laws at walls or openings change, so that a program does not go on with another one's run.
  constexpr std::int64_t laws = 2;
  std::vector<std::int64_t> numbers{laws, static_cast<std::int64_t>(air.rows.slots()),
                                    static_cast<std::int64_t>(air.rows.active_cells())};
  for (const auto& run : air.rows.runs()) {
    numbers.insert(numbers.end(), {run.first, run.x, run.y, run.z, run.count});
  }
  for (const auto* list : {&air.links.inlets, &air.links.outlets})
    for (const auto& link : *list) numbers.insert(numbers.end(), {link.slot, link.direction, link.patch});
  std::uint64_t hash = 0;
  hash_in(numbers, hash);
  const auto& origin = air.rows.origin();
  hash_in(std::vector<double>(origin.data(), origin.data() + 3), hash);
  hash_in(air.links.partner, hash);
  hash_in(air.gradients.viscosity_wanted ? air.gradients.length2 : air.les, hash);  // what does not change with time
  return hash;
}

}  // namespace puffin::coupling
