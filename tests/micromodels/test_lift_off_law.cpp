#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micromodels/law.hpp"

namespace puffin::micromodels {
namespace {

/// A 70 um carrier with fines of 1.9 um on a rigid wall.
LiftOffLaw::Constants lactose(double youngs_modulus, double surface_energy) {
  LiftOffLaw::Constants c;
  c.carrier_diameter = 70e-6;
  c.carrier_mass = 2.84e-10;
  c.fine_diameter = 1.9e-6;
  c.fine_density = 1520.0;
  c.youngs_modulus = youngs_modulus;
  c.poisson = 0.3;
  c.wall_youngs_modulus = std::numeric_limits<double>::infinity();
  c.surface_energy = surface_energy;
  return c;
}

LiftOffLaw::Constants polymer_wall(double surface_energy) {
  auto c = lactose(24e9, surface_energy);
  c.wall_youngs_modulus = 2.5e9;
  c.wall_poisson = 0.35;
  return c;
}

TEST(LiftOffLaw, has_the_published_threshold_speeds) {
  // Quoted for these moduli (of the carrier; rigid wall) to three digits, partly cut instead of rounded: one unit of
  // the last.
  const double table[3][3] = {{24e9, 0.54, 2.07}, {1e9, 1.56, 5.97}, {0.1e9, 3.36, 12.9}};
  const double digit[3][2] = {{0.01, 0.01}, {0.01, 0.01}, {0.01, 0.1}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(LiftOffLaw(lactose(table[i][0], 3.6e-3)).threshold(), table[i][1], digit[i][0]);
    EXPECT_NEAR(LiftOffLaw(lactose(table[i][0], 1.8e-2)).threshold(), table[i][2], digit[i][1]);
  }
}

TEST(LiftOffLaw, integrates_the_deceleration_of_a_hertz_impact) {
  // Independent of the closed form: m x'' = -(4/3) E* sqrt(R) x^(3/2) by small steps; the greatest deceleration at v =
  // v_c must be F/m_f. Symplectic Euler with 2e5 steps of the contact: error of the maximum of order (1e-5)^2 + 1e-5.
  const auto c = lactose(24e9, 3.6e-3);
  const LiftOffLaw law(c);
  const double k = 4.0 / 3.0 * (24e9 / 0.91) * std::sqrt(35e-6);
  double x = 0.0, v = law.threshold(), greatest = 0.0;
  const double dt = 2e-12;
  while (v > 0.0) {
    const double a = k * std::pow(x, 1.5) / c.carrier_mass;
    greatest = std::max(greatest, a);
    v -= dt * a;
    x += dt * v;
  }
  const double fine_mass = M_PI / 6.0 * 1520.0 * std::pow(1.9e-6, 3);
  EXPECT_NEAR(fine_mass * greatest / law.adhesion(), 1.0, 1e-4);
}

TEST(LiftOffLaw, lets_go_nothing_below_the_threshold_and_half_in_the_limit) {
  const LiftOffLaw law(polymer_wall(3.6e-3));
  EXPECT_EQ(law.value(0.0), 0.0);
  EXPECT_EQ(law.value(0.999 * law.threshold()), 0.0);
  EXPECT_EQ(law.value(law.threshold()), 0.0);
  EXPECT_NEAR(law.value(law.threshold() * 1e6), 0.5, 0.5 * std::pow(1e-6, 1.2) * 1.001);
  EXPECT_DOUBLE_EQ(law.value(law.threshold() * std::pow(2.0, 5.0 / 6.0)), 0.25);  // a = 2 F/m_f: half of the half
}

TEST(LiftOffLaw, has_a_threshold_that_scales_with_surface_energy_to_five_sixths_and_modulus_to_minus_a_third) {
  const double v = LiftOffLaw(lactose(24e9, 3.6e-3)).threshold();
  EXPECT_NEAR(LiftOffLaw(lactose(24e9, 3.6e-3 * 64.0)).threshold() / v, 32.0, 32.0 * 1e-13);
  EXPECT_NEAR(LiftOffLaw(lactose(8.0 * 24e9, 3.6e-3)).threshold() / v, 0.5, 1e-13);
}

TEST(LiftOffLaw, needs_about_twice_the_speed_on_a_polymer_wall) {
  // E* falls from 26.4 to 2.57 GPa: (26.37/2.571)^(1/3) = 2.172.
  const double rigid = LiftOffLaw(lactose(24e9, 3.6e-3)).threshold();
  EXPECT_NEAR(LiftOffLaw(polymer_wall(3.6e-3)).threshold() / rigid, 2.172, 0.001);
}

TEST(LiftOffLaw, needs_twice_the_speed_against_another_carrier_as_against_a_rigid_wall) {
  // Halving E*, R* and m* scales the peak force by 2^-(2/5 + 1/5 + 3/5) = 2^-1.2; v_c ~ force^(-5/6): exactly 2.
  auto c = lactose(24e9, 3.6e-3);
  const double wall = LiftOffLaw(c).threshold();
  c.partner = Partner::carrier;
  EXPECT_NEAR(LiftOffLaw(c).threshold() / wall, 2.0, 1e-13);
}

TEST(LiftOffLaw, does_not_depend_on_the_unit_of_length_mass_and_time) {
  // Micrometre, nanogram, microsecond: 1 m = 1e6, 1 kg = 1e12, 1 s = 1e6; so Pa = kg/(m s^2) = 1e-6, J/m^2 = kg/s^2 =
  // 1, kg/m^3 = 1e-6, m/s = 1.
  const auto si = polymer_wall(3.6e-3);
  auto c = si;
  c.carrier_diameter *= 1e6, c.fine_diameter *= 1e6, c.carrier_mass *= 1e12, c.fine_density *= 1e-6;
  c.youngs_modulus *= 1e-6, c.wall_youngs_modulus *= 1e-6;
  EXPECT_NEAR(LiftOffLaw(c).threshold() / LiftOffLaw(si).threshold(), 1.0, 1e-13);
}

TEST(LiftOffLaw, with_a_spread_is_the_mean_over_log_normal_adhesion) {
  // Against the sum over 20001 quantile-like points of the normal density on +-8 s: the trapezoidal rule on a smooth
  // density that vanishes at the ends; the kink of the sharp law costs O(h^2) = (16/20000)^2 times its jump in slope, <
  // 1e-6.
  auto c = polymer_wall(3.6e-3);
  const LiftOffLaw sharp(c);
  c.spread = 0.5;
  const LiftOffLaw spread(c);
  for (const double v : {0.4, 1.0, 1.5, 3.0, 10.0}) {
    double mean = 0.0;
    const int n = 20000;
    for (int i = 0; i <= n; ++i) {
      const double t = -8.0 + 16.0 * i / n;
      const double overload = std::pow(v / sharp.threshold(), 1.2) / std::exp(0.5 * t);
      mean += std::exp(-0.5 * t * t) / std::sqrt(2.0 * M_PI) * (overload > 1.0 ? 0.5 * (1.0 - 1.0 / overload) : 0.0) *
              16.0 / n;
    }
    EXPECT_NEAR(spread.value(v), mean, 1e-6) << v;
  }
}

TEST(LiftOffLaw, with_a_spread_tends_to_the_sharp_law_and_rises_with_speed) {
  auto c = polymer_wall(3.6e-3);
  const LiftOffLaw sharp(c);
  c.spread = 1e-3;
  const LiftOffLaw narrow(c);
  // The smearing moves f by at most limit x s.
  for (const double v : {0.5, 1.0, 1.3, 5.0}) EXPECT_NEAR(narrow.value(v), sharp.value(v), 0.5e-3);
  c.spread = 0.5;
  const LiftOffLaw wide(c);
  double last = 0.0;
  for (double v = 0.0; v < 30.0; v += 0.01) {
    EXPECT_GE(wide.value(v), last - 1e-15);
    last = wide.value(v);
  }
  EXPECT_LE(last, 0.5);
}

TEST(LiftOffLaw, refuses_nonsense) {
  const auto bad = [](auto change) {
    auto c = polymer_wall(3.6e-3);
    change(c);
    EXPECT_THROW(LiftOffLaw{c}, std::invalid_argument);
  };
  bad([](auto& c) { c.carrier_diameter = 0.0; });
  bad([](auto& c) { c.carrier_mass = -1.0; });
  bad([](auto& c) { c.youngs_modulus = NAN; });
  bad([](auto& c) { c.wall_youngs_modulus = 0.0; });
  bad([](auto& c) { c.poisson = 0.6; });
  bad([](auto& c) { c.surface_energy = 0.0; });
  bad([](auto& c) { c.spread = -0.1; });
  bad([](auto& c) { c.limit = 1.5; });
}

}  // namespace
}  // namespace puffin::micromodels
