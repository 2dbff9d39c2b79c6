#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "coupling/replay_fines.hpp"

namespace puffin::coupling {
namespace {

using micromodels::FinesModels;
using micromodels::PowerLaw;

FinesModels constant(double detach, double attach, double by_carrier) {
  FinesModels m;
  m.wall_detach = PowerLaw({detach, 0.0, 0.0, detach, 0.0});
  m.wall_attach = PowerLaw({attach, 0.0, 0.0, attach, 0.0});
  m.particle_detach = PowerLaw({by_carrier, 0.0, 0.0, by_carrier, 0.0});
  return m;
}

FinesRecord two_carriers() {
  FinesRecord r;
  r.end = 1.0;
  r.carriers = {{1000.0, true, 0.0}, {500.0, false, 0.0}};
  r.sets.resize(1);
  return r;
}

FinesRecord::Contact wall_hit(std::int64_t a, double time) {
  return {a, -1, time, 2.0, 0.0, 90.0, true, false, 0.0, 0.0};
}

TEST(Replay, asks_every_contact_in_its_order) {
  FinesRecord r = two_carriers();
  r.contacts = {wall_hit(0, 0.1), {0, 1, 0.2, 1.0, 1.0, 45.0, true, true, 0.0, 0.0}, wall_hit(1, 0.3)};
  const Replayed out = replay(r, constant(0.2, 0.1, 0.05));
  EXPECT_DOUBLE_EQ(out.to_air[0], 200.0 + 100.0);
  EXPECT_DOUBLE_EQ(out.to_wall, 100.0 + 50.0);
  EXPECT_DOUBLE_EQ(out.to_air[1], 50.0 + 25.0);
  ASSERT_EQ(out.sets.size(), 1U);
  EXPECT_DOUBLE_EQ(out.sets[0].on_emitted_carriers, 650.0);
  EXPECT_DOUBLE_EQ(out.sets[0].on_carriers, 325.0);
}

TEST(Replay, a_contact_that_could_release_nothing_releases_nothing) {
  FinesRecord r = two_carriers();
  r.contacts = {wall_hit(0, 0.1), {0, 1, 0.2, 1.0, 1.0, 45.0, false, true, 0.0, 0.0}};
  r.contacts[0].a_loses = false;  // settling, or no air in reach
  const Replayed out = replay(r, constant(0.2, 0.1, 0.05));
  EXPECT_EQ(out.to_air[0], 0.0);
  EXPECT_DOUBLE_EQ(out.to_air[1], 25.0);
}

TEST(Replay, the_runs_own_drag_law_returns_what_it_asked_for) {
  FinesRecord r = two_carriers();
  FinesModels m = constant(0.2, 0.0, 0.0);
  m.drag_detach = PowerLaw({0.0, 1.0, 10.0, 0.2, 1.0});
  r.rates = sample_rates(*m.drag_detach);
  r.slip = {{0, 40, 1.0, 1e9}};  // would ask for everything; must not be used
  r.contacts = {wall_hit(0, 0.1)};
  r.contacts[0].drag_a = 30.0;
  r.carriers[0].drag_rest = 5.0;
  const Replayed out = replay(r, m);
  EXPECT_DOUBLE_EQ(out.to_air[2], 35.0);
}

TEST(Replay, another_drag_law_is_asked_about_the_slip) {
  // Rate 0.2 v: exact in each class, as a class keeps its mean speed. Two classes: 0.2 (3 0.01 + 20 0.02) 1000 = 86.
  FinesRecord r = two_carriers();
  SlipHistory slip(2);
  slip.add(0, 3.0, 0.01);
  slip.add(0, 19.0, 0.01);
  slip.add(0, 21.0, 0.01);
  for (int k = 0; k < SlipHistory::classes; ++k)
    if (slip.seconds[static_cast<std::size_t>(k)] > 0.0)
      r.slip.push_back({0, k, slip.seconds[static_cast<std::size_t>(k)], slip.metres[static_cast<std::size_t>(k)]});
  FinesModels m;
  m.drag_detach = PowerLaw({0.2, 1.0, 0.0, 0.2, 1.0});
  r.contacts = {wall_hit(0, 0.25), wall_hit(0, 0.5)};
  EXPECT_NEAR(replay(r, m).to_air[2], 86.0, 1e-12 * 86.0);
  m.drag_detach.reset();
  EXPECT_EQ(replay(r, m).to_air[2], 0.0);
}

TEST(Replay, classes_of_slip_cover_all_speeds) {
  EXPECT_EQ(SlipHistory::class_of(0.0), 0);
  EXPECT_EQ(SlipHistory::class_of(SlipHistory::lowest), 1);
  EXPECT_EQ(SlipHistory::class_of(1e9), SlipHistory::classes - 1);
  EXPECT_EQ(SlipHistory::class_of(255.9), SlipHistory::classes - 2);
}

TEST(Replay, airborne_fines_share_the_fate_of_the_runs_own) {
  FinesRecord r = two_carriers();
  r.sets[0][0] = {400.0, 40.0, 300.0, 60.0};
  r.contacts = {wall_hit(0, 0.1), {0, 1, 0.2, 1.0, 1.0, 45.0, true, true, 0.0, 0.0}};
  const Ledger ledger = replay(r, constant(0.2, 0.1, 0.05)).sets[0];
  EXPECT_DOUBLE_EQ(ledger.by_mechanism[0].emitted, 150.0);
  EXPECT_DOUBLE_EQ(ledger.by_mechanism[1].emitted, 75.0 * 0.75) << "nothing of its own: as all together";
  EXPECT_DOUBLE_EQ(ledger.on_walls, 100.0 + (200.0 + 75.0) * 0.15);
}

// A scalar of which next to nothing was airborne rested where it was released: what the run says of it is no fate.
TEST(Replay, a_trace_of_a_mechanism_goes_where_all_together_went) {
  FinesRecord r = two_carriers();
  double dose = 0.0;
  for (const auto& carrier : r.carriers) dose += carrier.initial;
  r.sets[0][0] = {400.0, 40.0, 300.0, 60.0};
  r.contacts = {wall_hit(0, 0.1), {0, 1, 0.2, 1.0, 1.0, 45.0, true, true, 0.0, 0.0}};
  for (const double released : {0.9e-5 * dose, 1.1e-5 * dose}) {
    r.sets[0][1] = {released, released, 0.0, 0.0};  // all of it still in the air
    const bool trace = released < 1e-5 * dose;
    const double emitted = replay(r, constant(0.2, 0.1, 0.05)).sets[0].by_mechanism[1].emitted;
    EXPECT_DOUBLE_EQ(emitted, trace ? 75.0 * 300.0 / (400.0 + released) : 0.0);
  }
}

TEST(Replay, always_adds_up) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    FinesRecord r;
    r.end = 1.0;
    r.sets.resize(2);
    for (auto& set : r.sets)
      for (auto& s : set) {
        const double x = unit(random), y = unit(random) * (1.0 - x);
        s = {10.0, 10.0 * (1.0 - x - y), 10.0 * x, 10.0 * y};
      }
    for (int c = 0; c < 20; ++c)
      r.carriers.push_back({2000.0 * unit(random), unit(random) < 0.5, 100.0 * unit(random)});
    for (int n = 0; n < 400; ++n) {
      const auto a = static_cast<std::int64_t>(random() % 20), b = static_cast<std::int64_t>(random() % 20);
      r.contacts.push_back({a, a == b ? -1 : b, n / 400.0, 5.0 * unit(random), unit(random), 90.0 * unit(random),
                            unit(random) < 0.9, unit(random) < 0.9, 10.0 * unit(random), 10.0 * unit(random)});
      r.slip.push_back({a, 1, 1e-3, 1e-2 * unit(random)});
    }
    FinesModels m = constant(0.3 * unit(random), 0.1 * unit(random), 0.1 * unit(random));
    m.drag_detach = PowerLaw({unit(random), 1.0, 5.0, unit(random), 1.0});
    if (trial % 2) r.rates = sample_rates(*m.drag_detach);
    for (const Ledger& ledger : replay(r, m).sets) {
      // Some 1000 additions of numbers up to the dose, compensated, and products: far below 1e-12.
      EXPECT_LT(std::abs(ledger.error()), 1e-12);
      for (const double part : {ledger.FFE(), ledger.FFW(), ledger.FFCR(), ledger.FFCE()}) EXPECT_GE(part, 0.0);
    }
  }
}

TEST(Replay, refuses_a_contact_of_a_carrier_that_is_not_there) {
  FinesRecord r = two_carriers();
  r.contacts = {wall_hit(2, 0.1)};
  EXPECT_THROW(replay(r, constant(0.2, 0.1, 0.05)), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::coupling
