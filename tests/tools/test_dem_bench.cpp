// The scenes and the counting of `puffin bench dem`.

#include <gtest/gtest.h>

#include <cmath>

#include "dem/advance.hpp"
#include "tools/bench/dem_bench.hpp"
#include "tools/bench/dem_scenes.hpp"

using namespace puffin::bench;
namespace dem = puffin::dem;

namespace {

double solid_volume(const DemScene& scene) {
  double sum = 0.0;
  for (const dem::Carrier& c : scene.carriers) sum += 4.0 / 3.0 * M_PI * std::pow(c.radius, 3);
  return sum;
}

}  // namespace

TEST(DemBench, TheDiluteCloudHasItsSolidFractionAndNobodyTouches) {
  const DemScene scene = dem_scene("dilute", 1000);
  EXPECT_NEAR(solid_volume(scene) / scene.walls.size().prod(), 1e-3, 1e-9);
  for (std::size_t i = 0; i < scene.carriers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((scene.carriers[i].position - scene.carriers[j].position).norm(), 70e-6);
}

// Eight neighbours each, each contact counted once: 4 a carrier inside, fewer at the surface. Of 8 x 8 x 8 cubes with
// two carriers 15 x 15 x 15 pairs of corner and centre are there, 3.30 a carrier; those that part at once may be missing.
TEST(DemBench, InTheDenseBedEverybodyTouchesAndIsAwake) {
  const DemRow row = measure_dem({"dense", 1024, 1}, 0.0, false);
  EXPECT_GT(row.contacts_per_carrier, 0.8 * 3.30);
  EXPECT_LT(row.contacts_per_carrier, 3.30);
  EXPECT_GT(row.substeps_per_second, 0.0);
}

// t_c = pi sqrt(m*/k)/sqrt(1 - zeta^2), m* = 1.365e-10 kg (70 um, 1520 kg/m^3), k = 100 N/m, e = 0.6: 3.718e-6 s.
TEST(DemBench, CountsByTheContactStepOfTheScene) {
  EXPECT_NEAR(dem_scene("dense", 2).contact_step, 3.718e-6 / 20.0, 1e-3 * 3.718e-6 / 20.0);
  const DemRow row = measure_dem({"dilute", 1000, 1}, 0.02, false);
  EXPECT_NEAR(row.particle_steps_per_second * row.nanoseconds_per_carrier, 1e9 * 1e-6 / (3.718e-6 / 20.0), 0.01e9);
  EXPECT_THROW(dem_scene("no-such-scene", 10), std::invalid_argument);
}
