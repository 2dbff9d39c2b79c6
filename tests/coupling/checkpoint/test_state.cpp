// A restored state goes on bit for bit as the one that was saved; altered bytes are refused, never believed.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <random>

#include "coupling/checkpoint/checkpoint.hpp"
#include "tests/coupling/checkpoint/coupled_scene.hpp"

namespace puffin::coupling {
namespace {

using cases::Simulation;

void run(Simulation& sim, double until) {
  while (sim.state.time < until * (1.0 - 1e-12)) advance(sim.models, until, sim.state);
}

/// All that a state is, without what it cost.
Checkpoint saved(const Simulation& sim) {
  Checkpoint checkpoint;
  State& state = const_cast<State&>(sim.state);
  const Effort effort = state.effort;
  state.effort.air = state.effort.links = state.effort.exchange = 0.0;
  state.effort.carriers = state.effort.fines = state.effort.scalars = 0.0;
  save(state, checkpoint);
  state.effort = effort;
  return checkpoint;
}

void expect_equal(const Checkpoint& a, const Checkpoint& b) {
  ASSERT_EQ(a.sections.size(), b.sections.size());
  for (std::size_t n = 0; n < a.sections.size(); ++n)
    EXPECT_TRUE(a.sections[n].bytes == b.sections[n].bytes) << a.sections[n].name;
}

TEST(Checkpoint, TheSceneHasWhatACheckpointMustKeep) {
  const auto sim = coupled_simulation();
  const State& s = sim->state;
  bool touching = false;
  for (int n = 1; n <= 200; ++n) {  // a contact lasts some 10 us
    run(*sim, 5e-6 * n);
    touching = touching || s.carriers.contacts.size() > s.carriers.free_contacts.size();
  }
  EXPECT_TRUE(s.airborne);
  double drift = 0.0;
  for (const double v : s.fines_drift[0]) drift = std::max(drift, std::abs(v));
  EXPECT_GT(drift, 0.0);
  EXPECT_GT(s.fines.to_wall.value(), 0.0);
  EXPECT_GT(s.collisions.wall, 0.0);
  EXPECT_FALSE(s.departures.empty());
  EXPECT_FALSE(s.impulse_on_air.empty());
  EXPECT_GT(s.effort.rescalings, 0);
  EXPECT_TRUE(touching);
  EXPECT_TRUE(s.first_motion.time().has_value());
}

TEST(Checkpoint, ARestoredStateGoesOnBitForBit) {
  const auto whole = coupled_simulation();
  std::vector<double> stops;  // a stop shortens an exchange, so the control makes the same ones
  // Odd numbers of steps and exchanges, before and after the first release, the first departure and a rescaling.
  for (const double at : {0.011e-3, 0.2e-3, 0.7e-3, 1.3e-3}) {
    run(*whole, at);
    stops.push_back(at);
    const Checkpoint middle = saved(*whole);
    const auto resumed = coupled_simulation();
    if (at == 0.7e-3) run(*resumed, 1e-3);  // restoring overwrites whatever was there, forces on the lattice too
    restore(middle, resumed->state);
    {
      SCOPED_TRACE("restored at " + std::to_string(1e3 * at) + " ms");
      expect_equal(saved(*resumed), middle);
    }
    const auto control = coupled_simulation();
    for (const double stop : stops) run(*control, stop);
    const double end = at + 0.25e-3;
    run(*control, end);
    {
      const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
      run(*resumed, end);
    }
    SCOPED_TRACE("gone on from " + std::to_string(1e3 * at) + " ms");
    expect_equal(saved(*resumed), saved(*control));
  }
}

/// A plug between walls that are let go along with it, driven faster and slower: each exchange has a time step of its
/// own, before which the fines are carried by the old one's fluxes and the walls' old speed.
constexpr const char* saw_scene = R"toml(
schema = 1
name = "saw"
[geometry]
generator = "duct"
[geometry.duct]
length = "10 mm"
width = "8 mm"
height = "8 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
profile = "plug"
flow_rate = [["0 s", "10 L/min"], ["1.5 ms", "40 L/min"], ["3 ms", "10 L/min"], ["4.5 ms", "40 L/min"], ["6 ms", "10 L/min"]]
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "1 mm"
lattice_speed = 0.03
[fines]
[[fines.scalar]]
name = "drug"
initial = { shape = "gaussian", center = ["5 mm", "4 mm", "4 mm"], sigma = "1.5 mm", amount = 1000.0 }
[stop]
time = "6 ms"
)toml";

TEST(Checkpoint, EveryExchangeOfARampCanBeGoneOnFrom) {
  const auto scene = cases::parse_case(saw_scene, "saw.toml");
  const auto whole = cases::build(scene);
  const double end = scene.stop.time;
  std::vector<Checkpoint> stops;
  int owing = 0;  // checkpoints that leave fines to be carried by air that has gone by
  while (whole->state.time < end * (1.0 - 1e-12)) {
    advance(whole->models, end, whole->state);
    stops.push_back(saved(*whole));
    owing += whole->state.steps_since_scalars > 0;
  }
  EXPECT_GT(whole->state.effort.rescalings, 20);
  EXPECT_GT(owing, 5);
  for (std::size_t n = 0; n + 1 < stops.size(); ++n) {
    const auto resumed = cases::build(scene);
    restore(stops[n], resumed->state);
    run(*resumed, end);
    SCOPED_TRACE("from exchange " + std::to_string(n + 1) + " of " + std::to_string(stops.size()));
    expect_equal(saved(*resumed), stops.back());
  }
}

TEST(Checkpoint, KeepsTheBookOfAClosedAirsMass) {
  const auto sim = coupled_simulation(), other = coupled_simulation();
  sim->state.air_mass = {3456, -0.5, 0.25, 0.125, 3};  // an open air has none; any will do
  const Checkpoint checkpoint = saved(*sim);
  restore(checkpoint, other->state);
  const lbm::MassBook& m = other->state.air_mass;
  EXPECT_EQ(m.cells, 3456);
  EXPECT_EQ(m.booked, -0.5);
  EXPECT_EQ(m.missing, 0.25);
  EXPECT_EQ(m.returned, 0.125);
  EXPECT_EQ(m.corrections, 3);
}

TEST(Checkpoint, AlteredBytesAreRefusedOrHarmless) {
  const auto sim = coupled_simulation();
  run(*sim, 0.7e-3);
  const Checkpoint sound = saved(*sim);
  const auto victim = coupled_simulation();
  std::mt19937 random(7);
  int refused = 0, cut = 0;
  for (int n = 0; n < 600; ++n) {
    const int before = refused;
    Checkpoint altered = sound;
    // Small sections are hit as often as large ones, and mostly near their lengths and indices.
    Section& section = altered.sections[random() % altered.sections.size()];
    const std::size_t reach = n % 2 ? section.bytes.size() : std::min<std::size_t>(section.bytes.size(), 400);
    const std::size_t at = random() % reach;
    if (n % 5 == 0)
      section.bytes.resize(at);
    else
      section.bytes[at] = static_cast<std::byte>(n % 3 ? random() : 0xFF);
    try {
      restore(altered, victim->state);
    } catch (const CheckpointDamaged&) {
      ++refused;
      cut += n % 5 == 0;
    }
    // However far the bad one got, the older one is taken.
    if (refused > before) {
      ASSERT_NO_THROW(restore(sound, victim->state)) << "after alteration " << n;
    }
  }
  EXPECT_EQ(cut, 120) << "every truncation";
  EXPECT_GT(refused, 120) << "and some of the altered bytes";
  restore(sound, victim->state);
  expect_equal(saved(*victim), sound);
}

TEST(Checkpoint, OneOfAnotherLatticeIsRefused) {
  const auto sim = coupled_simulation();
  const Checkpoint sound = saved(*sim);
  cases::Case other = sim->description;
  other.numerics.dx = 0.2e-3;
  const auto finer = cases::build(other);
  EXPECT_THROW(restore(sound, finer->state), CheckpointDamaged);
  EXPECT_NE(fingerprint(finer->state), fingerprint(sim->state));
  EXPECT_EQ(fingerprint(coupled_simulation()->state), fingerprint(sim->state));
}

}  // namespace
}  // namespace puffin::coupling
