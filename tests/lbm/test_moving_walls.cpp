// A wall that slides carries air from cell to cell, and none out of its ends.

#include "lbm/moving_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/mass_fluxes.hpp"
#include "lbm/plane_flux.hpp"
#include "lbm/wall_schemes.hpp"
#include "tests/lbm/box_scene.hpp"

using namespace puffin::lbm;
using namespace puffin::lbm::test;
using geometry::Vec3;

namespace {

constexpr double speed = 0.02;

/// A box whose z-max slides along x.
BoxScene cavity(double height, const Vec3& offset = Vec3::Zero()) {
  Boundary lid{"", BoundaryKind::wall, [](const Vec3&) { return Vec3(1, 0, 0); }};
  lid.slides = true;
  return make_box(Vec3(12, 2, height), 1.0, {wall(), wall(), periodic(), periodic(), wall(), lid}, offset);
}

Drive sliding(const Air& air) {
  Drive drive = at_rest(air);
  drive.speed[5] = speed;
  return drive;
}

double mass(const Air& air) {
  double sum = 0.0;
  for (const Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) sum += moments_at(air, run.first + n).density_excess;
  return sum;
}

Air run(BoxScene& scene, int steps) {
  AirOptions options;
  options.double_precision = true;
  Air air = make_air(scene, options);
  const Drive drive = sliding(air);
  for (int t = 0; t < steps; ++t) step(air, 0.8, drive);
  return air;
}

}  // namespace

// Steady flow in a closed box passes no plane. After 4000 steps a disturbance of the box, which decays as
// exp(-nu (pi/12)^2 t) with nu = 0.1 or faster, is below 1e-11 of the lid's speed; before, what the lid carries went on
// through the corners, speed/6 a column of cells.
TEST(MovingWalls, ALidDrivesNoFlowThroughACavity) {
  for (const double height : {10.0, 9.6}) {
    BoxScene scene = cavity(height, Vec3(0, 0, height == 10.0 ? 0.0 : 0.2));
    const Air air = run(scene, 4000);
    for (const int plane : {0, 3, 5, 9, 10})
      EXPECT_NEAR(plane_flux(air, speed, 0, plane).mass, 0.0, 1e-9) << height << " " << plane;
  }
}

// Every cell gains what it is given: the sum over the box changes by rounding alone, 2,880 links of size 0.1 a step in
// double for 4000 steps.
TEST(MovingWalls, TheMassOfACavityStays) {
  BoxScene scene = cavity(10.0);
  const Air air = run(scene, 4000);
  EXPECT_NEAR(mass(air), 0.0, 1e-9);
}

// The links of the lid, two diagonals for each of 12 x 2 cells along x: all but the two at each corner have partners.
TEST(MovingWalls, LinksAtTheEndsOfALidGainNothing) {
  BoxScene scene = cavity(10.0);
  AirOptions options;
  const Air air = make_air(scene, options);
  EXPECT_EQ(air.links.carried.size(), 2U * 11U);
  double gains = 0.0, most = 0.0;
  for (const float g : air.links.moving) {
    gains += g;
    most = std::max(most, std::abs(static_cast<double>(g)));
  }
  EXPECT_NEAR(gains, 0.0, 1e-6);
  EXPECT_NEAR(most, 1.0 / 6.0, 1e-6);
  for (const float r : air.links.returned) EXPECT_EQ(r, 0.0F);
}

// With openings every cell gives back what it gets, and their books close.
TEST(MovingWalls, WithOpeningsAllIsGivenBack) {
  const Boundary lid{"", BoundaryKind::wall, [](const Vec3&) { return Vec3(1, 0, 0); }};
  const Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
  BoxScene scene = make_box(Vec3(12, 2, 10), 1.0, {outlet, outlet, periodic(), periodic(), wall(), lid});
  AirOptions options;
  const Air air = make_air(scene, options);
  EXPECT_TRUE(air.links.carried.empty());
  EXPECT_FALSE(air.links.moving.empty());
  EXPECT_EQ(air.links.returned, air.links.moving);
}
