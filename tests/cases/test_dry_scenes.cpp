// The carriers' part of the validation catalogue, end to end from its case files: what the contacts' log and the
// carriers at the end say, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/build.hpp"
#include "cases/read_case.hpp"
#include "dem/open_contacts.hpp"

namespace puffin::cases {
namespace {

struct Outcome {
  std::unique_ptr<Simulation> s;
  std::vector<dem::ContactEnded> contacts;  // those open at the end too

  const Vec3& v(std::size_t i) const { return s->state.carriers.carriers.velocity[i]; }
  const Vec3& x(std::size_t i) const { return s->state.carriers.carriers.position[i]; }
  const Vec3& w(std::size_t i) const { return s->state.carriers.carriers.spin[i]; }
  /// True if the carrier touches something at the end.
  bool holds(std::int64_t id) const {
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](const auto& c) { return c.a == id && c.time_end == s->state.time; });
  }
};

Outcome run(const std::string& name, const std::vector<Override>& overrides = {}) {
  Outcome r;
  r.s = build(read_case(std::string(PUFFIN_SOURCE_DIR) + "/cases/verify/" + name + "/case.toml", overrides));
  while (r.s->state.time < r.s->description.stop.time * (1.0 - 1e-12)) {
    coupling::advance(r.s->models, r.s->description.stop.time, r.s->state);
    const auto& ended = r.s->state.events.ended;
    r.contacts.insert(r.contacts.end(), ended.begin(), ended.end());
  }
  const auto open = dem::open_contacts(r.s->state.carriers, r.s->state.time);
  r.contacts.insert(r.contacts.end(), open.begin(), open.end());
  return r;
}

}  // namespace

// The tolerances of the dem tests of the same laws (tests/dem/test_hertz.cpp): 1e-3.
TEST(DryScenes, D01AndD02ReachTheHertzPeaks) {
  for (const auto& [name, force, overlap] :
       {std::tuple{"d01", 7108.241, 3.68304e-4}, {"d01-glass", 10696.889, 2.74113e-4}, {"d02", 7232.681, 5.21233e-5}}) {
    const Outcome r = run(name);
    ASSERT_EQ(r.contacts.size(), 1u) << name;
    EXPECT_NEAR(r.contacts[0].max_force, force, 1e-3 * force) << name;
    EXPECT_NEAR(r.contacts[0].max_overlap, overlap, 1e-3 * overlap) << name;
  }
}

TEST(DryScenes, D01CountsAndWeighsItsContact) {
  const Outcome r = run("d01");
  EXPECT_EQ(r.s->state.collisions.particle, 2.0);  // one for each partner
  const double mass = 2500.0 * M_PI / 6.0 * std::pow(0.02, 3);
  EXPECT_NEAR(r.contacts[0].energy, 0.5 * mass * 400.0, 1e-9 * mass * 400.0);  // relative speed 20 m/s
  EXPECT_NEAR(r.contacts[0].normal_speed, 20.0, 1e-9);
  EXPECT_NEAR(r.contacts[0].time_start, 0.0004 / 20.0, 1e-9);
}

TEST(DryScenes, D03ReturnsTheRestitution) {
  for (const char* e : {"0.2", "0.6", "1.0"}) {
    const Outcome r = run("d03", {{"carriers.contact.restitution", e}});
    EXPECT_NEAR(r.v(0).z() / 3.9, std::stod(e), 0.01 * std::stod(e));
    const Outcome linear = run("d03-linear", {{"carriers.contact.restitution", e}});
    EXPECT_NEAR(linear.v(0).z() / 3.9, std::stod(e), 0.005 * std::stod(e));
  }
}

TEST(DryScenes, D04SlidesAndD05SlidesExactly) {
  const Outcome r = run("d04");
  EXPECT_NEAR(r.v(8).x() / (3.9 * std::sin(M_PI / 4)), 0.81784, 0.002);
  EXPECT_NEAR(r.v(11).x() / (3.9 * std::sin(M_PI / 3)), 0.89483, 0.001);
  EXPECT_NEAR(r.v(3).x() / (3.9 * std::sin(20.059 * M_PI / 180)), 0.6161, 0.02);
  const Outcome steel = run("d05");
  EXPECT_NEAR(steel.v(12).x(), 15.0 - 3.0, 0.01);
  EXPECT_NEAR(steel.v(11).x(), 12.0 - 3.0, 0.01);
}

TEST(DryScenes, D06SpinsDownByTheNormalImpulse) {
  const Outcome r = run("d06");
  for (const auto& [id, spin] : {std::pair{2, 10.0}, {4, 20.0}, {6, 40.0}}) {
    EXPECT_NEAR(r.w(id).y(), spin - 3.0, 0.03);
    EXPECT_NEAR(std::abs(r.v(id).x()), 0.12, 0.0012);
  }
  const Outcome pair = run("d06-pair");
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(pair.v(2 * i).y() - pair.v(2 * i + 1).y(), 0.0, 1e-12);
  const Outcome heavy = run("d06-heavy");
  EXPECT_NEAR(heavy.w(12).y(), 37.0, 0.03);
}

// Contact time is not zero here: max_overlap 0.5 % of 20 mm at 3 m/s is 1e-4 s a bounce of up to 0.6 s.
TEST(DryScenes, D07BouncesLowerByTheSquareOfRestitution) {
  const Outcome r = run("d07");
  ASSERT_GT(r.contacts.size(), 10u);
  const double g = 9.81, h = 0.5;
  double time = std::sqrt(2.0 * h / g);
  for (int n = 0; n < 8; ++n) {
    EXPECT_NEAR(r.contacts[n].normal_speed, std::pow(0.9, n) * std::sqrt(2.0 * g * h),
                0.005 * r.contacts[n].normal_speed);
    EXPECT_NEAR(r.contacts[n].time_start, time, 2e-3 * time);
    time += 2.0 * std::pow(0.9, n + 1) * std::sqrt(2.0 * h / g);
  }
  // At rest the weight takes a tenth of the allowed overlap of 1e-4 m (first_stiffness()); at most a tenth of that
  // still swings after the last bounces.
  EXPECT_NEAR(r.x(0).z(), 0.01 - 1e-5, 1e-6);
}

TEST(DryScenes, D08RollsAtFiveSeventhsAndD09RollsOrSlips) {
  const Outcome slide = run("d08");
  EXPECT_NEAR(slide.v(0).x(), 5.0 / 7.0, 0.003);
  EXPECT_NEAR(slide.x(0).x() - 0.1, 0.124820 + 5.0 / 7.0 * (0.25 - 0.145624), 5e-4);
  const Outcome roll = run("d09"), slip = run("d09-sliding");
  const double rolling = 5.0 / 7.0 * 9.81 * std::sin(20 * M_PI / 180);
  EXPECT_NEAR(roll.v(0).x() / 0.2, rolling, 0.01 * rolling);
  EXPECT_NEAR(slip.v(0).x() / 0.2, 5.55426, 0.01 * 5.55426);
  EXPECT_NEAR(slip.w(0).y() / 0.2, 187.87, 0.01 * 187.87);
}

TEST(DryScenes, D10HoldsUpToThePullOffForce) {
  for (const char* name : {"d10-jkr", "d10-dmt", "d10-hamaker"}) {
    const Outcome r = run(name);
    for (int id = 0; id < 6; ++id) EXPECT_EQ(r.holds(id) && r.x(id).z() > 1.9e-3, id < 3) << name << " " << id;
  }
}

TEST(DryScenes, D11ReboundsAsThorntonAndNing) {
  const Outcome r = run("d11");
  EXPECT_TRUE(r.holds(0));
  EXPECT_TRUE(r.holds(1));
  const double ratio[] = {1.1, 1.5, 2.0, 5.0}, e[] = {0.41660, 0.74536, 0.86603, 0.97980};
  for (int n = 0; n < 4; ++n)
    EXPECT_NEAR(r.v(n + 2).z() / (ratio[n] * 0.008342), e[n], 0.01 * (1 / e[n] - e[n]) + 0.002);
}

// The restitution is right within 0.5 % (D03): so is e^2 (v^2 + w) within 1 %, half of it over v_out for the speed.
TEST(DryScenes, D12LosesTheWellOnceAtEveryStiffness) {
  const double w =
      std::pow(2.0 * 4.0 * M_PI * 3.6e-3 * 35e-6 * 4e-10 / (1520.0 * 4.0 / 3.0 * M_PI * std::pow(35e-6, 3)), 1.0);
  const double vs = std::sqrt((1.0 / 0.36 - 1.0) * w);
  for (const char* k : {"\"auto\"", "\"100 N/m\"", "\"10 N/m\"", "\"1 N/m\""}) {
    const Outcome r = run("d12", {{"carriers.contact.stiffness", k}});
    EXPECT_TRUE(r.holds(0) && r.holds(1)) << k;
    for (const auto& [id, factor] : {std::pair{2, 1.1}, {3, 1.5}, {4, 3.0}, {5, 10.0}}) {
      const double v = factor * vs, out = std::sqrt(0.36 * (v * v + w) - w);
      EXPECT_NEAR(r.v(id).z(), out, 0.005 * 0.36 * (v * v + w) / out) << k << " " << id;
    }
  }
}

TEST(FrozenScenes, P01RelaxesAndP02SpiralsOut) {
  const Outcome p01 = run("p01");
  const double tau = 1520.0 * 16e-12 / (18.0 * 1.82e-5), t = 0.4e-3, u = 1e-3;
  EXPECT_NEAR(p01.v(0).x(), u * (1.0 - std::exp(-t / tau)), 2e-3 * u);
  EXPECT_NEAR(p01.x(0).x() - 5e-4, u * (t - tau * (1.0 - std::exp(-t / tau))), 2e-3 * u * t);
  const Outcome p02 = run("p02");
  const double growth = 0.009538 / tau, turn = 0.098128 / tau, time = 0.01;
  const Vec3 r = p02.x(0) - Vec3(5e-4, 5e-4, 5e-4);
  EXPECT_NEAR(std::log(r.norm() / 1e-5) / time, growth, 5e-3 * growth);
  EXPECT_NEAR(std::atan2(r.y(), r.x()), std::remainder(turn * time, 2.0 * M_PI), 0.02);
}

// The same with 2 um, where a step of five times 10 us is 2.7 response times: r/r0 = exp(2.5696) = 13.06 after 5 ms by
// Stokes; Schiller and Naumann's drag, at Re up to 0.009 up to 0.6 % more, makes it 12.98, these steps 13.01. By the
// equations of one step of 50 us it was 15.4.
TEST(FrozenScenes, ALightCarrierSpiralsAsStokesSays) {
  const Outcome p02 = run(
      "p02", {{"air.omega", "5388.158"},
              {"carriers.list",
               "[{ position = [0.00051, 0.0005, 0.0005], velocity = [0.0051393, 0.05287296, 0.0], diameter = \"2 um\", "
               "density = \"1520 kg/m^3\" }]"},
              {"stop.time", "\"5 ms\""}});
  EXPECT_NEAR((p02.x(0) - Vec3(5e-4, 5e-4, 5e-4)).norm() / 1e-5, 13.06, 0.01 * 13.06);
}

// Held until 0.25 ms and let go for 0.5 ms, a carrier goes as far as in 0.5 ms from the start; rounding of times.
TEST(FrozenScenes, CarriersAreLetGoAtTheirMoment) {
  const Outcome held = run("p02", {{"carriers.start", "\"0.25 ms\""},
                                   {"stop.time", "\"0.75 ms\""},
                                   {"numerics.time_step", "\"10 us\""}}),
                free = run("p02", {{"stop.time", "\"0.5 ms\""}, {"numerics.time_step", "\"10 us\""}});
  EXPECT_NEAR((held.x(0) - free.x(0)).norm(), 0.0, 1e-12);
}

// A spinning carrier of 60 um across a wind of 8 m/s, 3e4 1/s, for 4 ms: Magnus, Schiller-Naumann and the air's torque
// on the spin, integrated by Runge-Kutta to 7 digits, move it 0.80128 mm aside. In 400 steps, with slip and spin taken
// at the start of a step, it was 0.87 % too far; with their means what is left is second order: 0.1 %.
TEST(FrozenScenes, MagnusLiftIsOfSecondOrderInTheStep) {
  const auto s = build(parse_case(R"toml(
schema = 1
name = "magnus"
geometry = { generator = "box", box = { x = "200 mm", y = "20 mm", z = "20 mm" } }
air = { model = "frozen", field = "uniform", velocity = [8.0, 0.0, 0.0] }
numerics = { time_step = "1e-5 s" }
stop = { time = "4 ms" }
[carriers]
list = [ { position = [0.05, 0.01, 0.01], velocity = [0.0, 0.0, 0.0], diameter = 6e-5, density = 1520, spin = [0.0, 3e4, 0.0] } ]
lift = "saffman-magnus"
gravity = [0.0, 0.0, 0.0]
)toml",
                                  "magnus.toml"));
  while (s->state.time < 4e-3 * (1.0 - 1e-12)) coupling::advance(s->models, 4e-3, s->state);
  EXPECT_NEAR(s->state.carriers.carriers.position[0].z() - 0.01, 8.012752e-4, 1e-3 * 8.0e-4);
}

}  // namespace puffin::cases
