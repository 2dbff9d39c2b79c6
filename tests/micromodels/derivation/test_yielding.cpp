// Contacts that yield, and the flight of fines to a wall through the air.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "micromodels/derivation/derive.hpp"
#include "micromodels/derivation/flight.hpp"

namespace puffin::micromodels::derivation {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Surface polymer(double yield) {
  Surface s;
  s.grains = {24e9, 0.3};
  s.wall = {2.5e9, 0.35, yield};
  s.surface_energy = 1e-9;  // nothing sticks
  s.restitution = 1.0;      // nothing but yielding loses energy
  return s;
}

/// Speed after over before an impact of one sphere on the wall.
double rebound(const Surface& surface, double radius, double mass, double speed) {
  Grain g;
  g.radius = radius, g.mass = mass;
  g.position = {0, 0, radius + 1e-9}, g.velocity = {0, 0, -speed};
  GrainSystem system({g}, surface, true);
  while (system.time() < 20.0 * radius / speed) {
    system.step(1e-4 * radius / speed);
    if (system.grains()[0].velocity.z() > 0.0 && !system.touch(0, -1)) break;
  }
  return system.grains()[0].velocity.z() / speed;
}

/// v_y and e(v): C. Thornton & Z. Ning, Powder Technol. 99, 154 (1998), a sphere on a flat.
double yield_speed(double yield, double modulus, double density) {
  return 1.56 * std::sqrt(std::pow(yield, 5) / (std::pow(modulus, 4) * density));
}
double thornton_ning(double x) {  // x = v_y/v
  return std::sqrt(6.0 * std::sqrt(3.0) / 5.0) * std::sqrt(1.0 - x * x / 6.0) *
         std::pow(x / (x + 2.0 * std::sqrt(1.2 - 0.2 * x * x)), 0.25);
}

TEST(Yielding, gives_the_restitution_of_Thornton_and_Ning) {
  // Their 1.56 is rounded (0.3 %), e ~ v_y^(1/4); explicit steps of 0.14/omega: 0.5 %.
  const double radius = 1e-6, mass = 4.0 / 3.0 * std::numbers::pi * 1e-18 * 1520.0, yield = 1.5e8;
  const double modulus = 1.0 / ((1 - 0.09) / 24e9 + (1 - 0.35 * 0.35) / 2.5e9);
  const double vy = yield_speed(yield, modulus, 1520.0);
  for (const double x : {0.5, 0.2, 0.1})
    EXPECT_NEAR(rebound(polymer(yield), radius, mass, vy / x), thornton_ning(x), 0.01) << x;
  EXPECT_NEAR(rebound(polymer(yield), radius, mass, 0.9 * vy), 1.0, 0.01);
  EXPECT_NEAR(rebound(polymer(infinite), radius, mass, 10.0 * vy), 1.0, 0.01);
}

TEST(Yielding, does_not_depend_on_the_unit_of_length) {
  // e depends on v/v_y alone, and v_y not on the size.
  const double small = rebound(polymer(1.5e8), 1e-6, 4.0 / 3.0 * std::numbers::pi * 1e-18 * 1520.0, 5.0);
  const double large = rebound(polymer(1.5e8), 1e-3, 4.0 / 3.0 * std::numbers::pi * 1e-9 * 1520.0, 5.0);
  EXPECT_LT(small, 0.9);
  EXPECT_NEAR(small, large, 1e-3);
}

TEST(Yielding, force_has_no_jump_at_the_yield_point_nor_when_it_turns_round) {
  const PairContact c = pair_contact(polymer(1.5e8), 1e-6, infinite, 1e-14, infinite, true, 1.0);
  const double at = std::pow(0.5 * std::numbers::pi * c.yield_pressure / c.modulus, 2) * c.radius;
  Flattened f;
  const double before = normal_force(c, at * (1 - 1e-9), f).load, after = normal_force(c, at * (1 + 1e-9), f).load;
  EXPECT_EQ(f.deepest > 0.0, true);
  EXPECT_NEAR(after / before, 1.0, 1e-7);
  const NormalForce deep = normal_force(c, 20.0 * at, f), back = normal_force(c, 20.0 * at * (1 - 1e-12), f);
  EXPECT_NEAR(back.load / deep.load, 1.0, 1e-9);
  EXPECT_NEAR(back.adhesion / deep.adhesion, 1.0, 1e-12);
  EXPECT_GT(deep.adhesion, c.pull);                           // flattened
  EXPECT_LT(normal_force(c, 0.5 * f.offset, f).load, 1e-30);  // parts before the undeformed sphere would
}

TEST(Flight, speed_lost_to_the_air_is_the_work_of_its_drag) {
  // d(speed)/dh = 6 pi mu R/m (1/C_c + R f/h) by the midpoint rule in ln h; error (d ln h)^2/24 of the film: 1e-5.
  const double r = 0.95e-6, m = 5.46e-15, mu = 1.82e-5, l = 0.067e-6, gap = 20e-6;
  const double cc = 1.0 + l / r * (1.257 + 0.4 * std::exp(-1.1 * r / l));
  double sum = 0.0;
  const int n = 4000;
  const double low = std::log(1e-14), step = (std::log(gap) - low) / n;
  for (int i = 0; i < n; ++i) {
    const double h = std::exp(low + (i + 0.5) * step);
    const double film = r / (3.0 * l) * ((1.0 + h / (6.0 * l)) * std::log1p(6.0 * l / h) - 1.0);
    sum += (1.0 / cc + film) * h * step;
  }
  EXPECT_NEAR(speed_lost_to_air(r, m, gap, mu, l) / (6.0 * std::numbers::pi * mu * r / m * sum), 1.0, 1e-4);
  EXPECT_EQ(speed_lost_to_air(r, m, 0.0, mu, l), 0.0);
  EXPECT_EQ(speed_lost_to_air(r, m, gap, 0.0, l), 0.0);
  // Metres to micrometres with the same speed: mass ~ length^3, viscosity ~ length.
  EXPECT_NEAR(speed_lost_to_air(r * 1e6, m * 1e18, gap * 1e6, mu * 1e6, l * 1e6) / speed_lost_to_air(r, m, gap, mu, l),
              1.0, 1e-12);
}

TEST(Flight, ends_on_the_wall_only_for_fines_that_arrive_slowly) {
  Scene s;
  s.surface.grains = {24e9, 0.3};
  s.surface.wall = {2.5e9, 0.35};
  s.surface.surface_energy = 3.6e-3;
  const double radius = 0.5 * s.fine_diameter, gap = 10e-6;
  const double lost = speed_lost_to_air(radius, fine_mass(s), gap, s.air_viscosity, s.mean_free_path);
  const Flight flight(s, 1.0, 0.0);
  const auto lands = [&](double down) {
    Outcome o;
    flight.land(-down, gap + radius, o);
    return o.to_wall;
  };
  EXPECT_EQ(lands(lost - 0.01), 0);  // stops in the air
  EXPECT_EQ(lands(lost + 0.01), 1);  // slower than the capture speed, 0.06 m/s
  EXPECT_EQ(lands(lost + 0.5), 0);   // bounces
}

TEST(Impact, the_air_brings_fines_to_rest_on_the_wall) {
  // In a vacuum only those let go slower than the capture speed stay there: a band of some 0.1 m/s; through the air
  // also those that it brakes to that speed on their way, a band of heights besides.
  Scene s;
  s.surface.grains = {24e9, 0.3, 0.9e9};
  s.surface.wall = {2.5e9, 0.35, 0.15e9};
  s.surface.surface_energy = 3.6e-3;
  const DerivedPoint air = derive_point(s, 2.5, 90.0, 8, 1);
  s.air_viscosity = 0.0;
  const DerivedPoint vacuum = derive_point(s, 2.5, 90.0, 8, 1);
  EXPECT_GT(air.attached - vacuum.attached, 3.0 * std::hypot(air.attached_error, vacuum.attached_error));
}

}  // namespace
}  // namespace puffin::micromodels::derivation
