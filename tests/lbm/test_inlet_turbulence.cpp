// Synthetic turbulence on an inlet: the right strength, no net flow.

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/inlet_turbulence.hpp"
#include "tests/lbm/box_scene.hpp"

namespace puffin::lbm::test {
namespace {

using geometry::Vec3;

struct Scene {
  BoxScene box;
  Air air;
  explicit Scene(int edge)
      : box(make_box(Vec3(8, edge, edge), 1.0,
                     {Boundary{"", BoundaryKind::velocity_inlet, [](const Vec3&) { return Vec3(1, 0, 0); }},
                      Boundary{"", BoundaryKind::pressure_outlet, {}}, wall(), wall(), wall(), wall()})),
        air(make_air(box, AirOptions{})) {}
};

// The three components have variance I^2 exactly in the mean over phases. Over a way of 4000 cells, some 400 eddies of
// length 10, and 400 cells of the opening (about 4 eddies), the variance is known to sqrt(2/1600) = 3.5 %; three times
// that. Taking off the net flow costs the normal component the share of eddies larger than the opening, here with a
// length of a tenth of it a few per cent, which the bound covers.
TEST(InletTurbulence, EveryComponentHasTheIntensityAskedFor) {
  Scene scene(20);
  const double intensity = 0.1, speed = 0.05;
  const auto turbulence = make_inlet_turbulence(scene.air, 0, intensity, 2.0, 42);
  const auto& links = scene.air.links.inlets;
  // A link in direction c gains -6 w c.u: the axis link gives the normal component, differences of diagonals the
  // others.
  double normal = 0.0, across = 0.0;
  std::size_t samples = 0, pairs = 0;
  std::vector<float> gain;
  for (double way = 0.0; way < 4000.0; way += 5.0) {
    gain.assign(links.size(), 0.0F);
    add_fluctuation(turbulence, way, speed, gain);
    for (std::size_t k = 0; k < links.size(); ++k) {
      const auto& c = d3q19::velocity[links[k].direction];
      if (links[k].direction <= 6) {
        normal += std::pow(gain[k] / (6.0 * d3q19::weight[links[k].direction]), 2);
        ++samples;
      } else if (c[1] == 1) {
        for (std::size_t m = k > 4 ? k - 4 : 0; m < std::min(k + 5, links.size()); ++m) {
          const auto& o = d3q19::velocity[links[m].direction];
          if (links[m].slot != links[k].slot || o[1] != -1) continue;
          across += std::pow((gain[k] - gain[m]) / (12.0 * d3q19::weight[links[k].direction]), 2);
          ++pairs;
        }
      }
    }
  }
  EXPECT_NEAR(std::sqrt(normal / static_cast<double>(samples)) / speed, intensity, 0.1 * intensity);
  EXPECT_NEAR(std::sqrt(across / static_cast<double>(pairs)) / speed, intensity, 0.1 * intensity);
}

// Sums of 2000 floats of 1e-3: 1e-7.
TEST(InletTurbulence, TheFlowRateIsTheGivenOneInEveryStep) {
  Scene scene(12);
  const auto turbulence = make_inlet_turbulence(scene.air, 0, 0.2, 4.0, 7);
  Drive drive = at_rest(scene.air);
  drive.speed[0] = 0.05;
  for (int t = 0; t < 50; ++t) {
    drive.inlet_fluctuation.assign(scene.air.links.inlets.size(), 0.0F);
    add_fluctuation(turbulence, 0.05 * t, 0.05, drive.inlet_fluctuation);
    step(scene.air, 0.6, drive);
    EXPECT_NEAR(mass_through(scene.air, 0), 0.05 * 144.0, 1e-5 * 0.05 * 144.0);
  }
  const float most = *std::max_element(drive.inlet_fluctuation.begin(), drive.inlet_fluctuation.end());
  EXPECT_GT(most, 1e-4F) << "the inlet is meant to fluctuate";
}

TEST(InletTurbulence, EqualSeedsGiveEqualTurbulenceAndOthersOther) {
  Scene scene(6);
  const auto a = make_inlet_turbulence(scene.air, 0, 0.1, 2.0, 1), b = make_inlet_turbulence(scene.air, 0, 0.1, 2.0, 1),
             c = make_inlet_turbulence(scene.air, 0, 0.1, 2.0, 2);
  EXPECT_EQ(a.cosine, b.cosine);
  EXPECT_NE(a.cosine, c.cosine);
  EXPECT_THROW(make_inlet_turbulence(scene.air, 0, -0.1, 2.0, 1), std::invalid_argument);
  EXPECT_THROW(make_inlet_turbulence(scene.air, 0, 0.1, 0.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::lbm::test
