#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "micromodels/fines_models.hpp"

namespace puffin::micromodels {
namespace {

FinesModels constant_fractions(double detach, double attach) {
  FinesModels m;
  m.wall_detach = PowerLaw({detach, 0.0, 0.0, detach, 0.0});
  m.wall_attach = PowerLaw({attach, 0.0, 0.0, attach, 0.0});
  m.particle_detach = PowerLaw({detach, 0.0, 0.0, detach, 0.0});
  m.drag_detach = PowerLaw({0.0, 1.0, 10.0, 0.2, 1.0});
  return m;
}

TEST(FinesModels, refer_to_the_initial_fines) {
  // Eq. 2.7: the second of two equal hits takes as many as the first.
  const FinesModels m = constant_fractions(0.3, 0.05);
  const Taken taken = impact_on_wall(m, 1.0, head_on, 2000.0, 1000.0);
  EXPECT_DOUBLE_EQ(taken.to_air, 600.0);
  EXPECT_DOUBLE_EQ(taken.to_wall, 100.0);
}

TEST(FinesModels, share_what_is_left_in_proportion) {
  const Taken taken = impact_on_wall(constant_fractions(0.6, 0.2), 1.0, head_on, 2000.0, 400.0);
  EXPECT_NEAR(taken.to_air, 300.0, 1e-12);
  EXPECT_NEAR(taken.to_wall, 100.0, 1e-12);
}

TEST(FinesModels, take_nothing_where_no_law_acts) {
  const FinesModels none;
  EXPECT_EQ(impact_on_wall(none, 5.0, head_on, 2000.0, 2000.0).to_air, 0.0);
  EXPECT_EQ(impact_on_wall(none, 5.0, head_on, 2000.0, 2000.0).to_wall, 0.0);
  EXPECT_EQ(impact_on_carrier(none, 5.0, head_on, 2000.0, 2000.0).to_air, 0.0);
  EXPECT_EQ(drag(none, 50.0, 1.0, 2000.0, 2000.0).to_air, 0.0);
}

TEST(FinesModels, carriers_and_air_put_nothing_on_the_wall) {
  const FinesModels m = constant_fractions(0.3, 0.2);
  EXPECT_EQ(impact_on_carrier(m, 5.0, head_on, 2000.0, 2000.0).to_wall, 0.0);
  EXPECT_EQ(drag(m, 50.0, 1e-3, 2000.0, 2000.0).to_wall, 0.0);
}

TEST(FinesModels, drag_is_a_rate_above_its_threshold) {
  const FinesModels m = constant_fractions(0.3, 0.2);
  EXPECT_DOUBLE_EQ(drag(m, 20.0, 1e-4, 2000.0, 2000.0).to_air, 0.2 * 20.0 * 1e-4 * 2000.0);
  EXPECT_EQ(drag(m, 9.9, 1e-4, 2000.0, 2000.0).to_air, 0.0);
  // Two half steps take what one step takes: two additions, each rounded once.
  const double once = drag(m, 20.0, 2e-4, 2000.0, 2000.0).to_air, half = drag(m, 20.0, 1e-4, 2000.0, 2000.0).to_air;
  EXPECT_NEAR(2.0 * half, once, 2.3e-16 * once);
}

TEST(FinesModels, never_take_more_than_is_left) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto law = [&]() -> Law {
    switch (random() % 3) {
      case 0:
        return PowerLaw({unit(random), 3.0 * unit(random), 10.0 * unit(random), unit(random), unit(random)});
      case 1:
        return TableLaw({0.0, 1.0 + unit(random), 5.0}, {}, {0.0, 0.5 * unit(random), 1.0 + unit(random)});
      default:
        return WeibullLaw({0.1 + 0.9 * unit(random), 0.1 + unit(random), 0.5 + unit(random), 1e-10, 1e-10});
    }
  };
  for (int n = 0; n < 100000; ++n) {
    FinesModels m;
    m.wall_detach = law();
    m.wall_attach = law();
    m.particle_detach = law();
    m.drag_detach = PowerLaw({unit(random), 2.0 * unit(random), 10.0 * unit(random), unit(random), unit(random)});
    const double initial = 2000.0 * unit(random), left = n % 7 ? initial * unit(random) : 0.0,
                 speed = 40.0 * unit(random);
    for (const Taken& t :
         {impact_on_wall(m, speed, 180.0 * unit(random), initial, left),
          impact_on_carrier(m, speed, head_on, initial, left), drag(m, speed, unit(random), initial, left)}) {
      ASSERT_GE(t.to_air, 0.0);
      ASSERT_GE(t.to_wall, 0.0);
      ASSERT_GE(left - t.to_wall - t.to_air, 0.0) << "to the bit, so that a carrier never owes fines";
    }
  }
}

TEST(FinesModels, refuse_nonsense) {
  const FinesModels m = constant_fractions(0.3, 0.2);
  EXPECT_THROW(impact_on_wall(m, -1.0, head_on, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(impact_on_wall(m, 1.0, NAN, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(impact_on_wall(m, 1.0, head_on, -1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(impact_on_carrier(m, 1.0, head_on, 1.0, NAN), std::invalid_argument);
  EXPECT_THROW(drag(m, 1.0, -1.0, 1.0, 1.0), std::invalid_argument);
  FinesModels bad;
  bad.drag_detach = WeibullLaw({1.0, 1.0, 1.0, 1.0, 1.0});
  EXPECT_THROW(check(bad), std::invalid_argument);
  bad = {};
  bad.surface_energy = -1.0;
  EXPECT_THROW(check(bad), std::invalid_argument);
  EXPECT_NO_THROW(check(m));
}

}  // namespace
}  // namespace puffin::micromodels
