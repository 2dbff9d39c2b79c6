// The wall model: its laws, and what walls get of them.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lbm/wall_model.hpp"
#include "tests/lbm/box_scene.hpp"

using namespace puffin::lbm;
using namespace puffin::lbm::test;
using geometry::Vec3;

// Werner & Wengle: the two branches meet at y+ = 11.81, where u+ = y+.
TEST(WallModel, ThePowerLawIsLaminarBelow) {
  const double nu = 1e-3, y = 2.0;
  for (const double y_plus : {1.0, 5.0, 11.0, 30.0, 100.0, 1000.0}) {
    const double u_tau = y_plus * nu / y, u_plus = y_plus < 11.81 ? y_plus : 8.3 * std::pow(y_plus, 1.0 / 7.0);
    const WallStress stress = werner_wengle(u_plus * u_tau, y, nu);
    EXPECT_NEAR(stress.over_rho, u_tau * u_tau, 2e-3 * u_tau * u_tau) << y_plus;
    EXPECT_NEAR(stress.y_plus, y_plus, 2e-3 * y_plus);
  }
}

// Reichardt's law put in gives its stress back: two steps of Newton's from 6 % (15 % at y+ of 12) leave 1e-4 of u_tau.
TEST(WallModel, ReichardtsLawIsInverted) {
  const double nu = 1e-3, y = 2.0;
  for (const double y_plus : {3.0, 5.0, 12.0, 30.0, 100.0, 1000.0}) {
    const double u_tau = y_plus * nu / y;
    const double u_plus = std::log(1.0 + 0.41 * y_plus) / 0.41 +
                          7.8 * (1.0 - std::exp(-y_plus / 11.0) - y_plus / 11.0 * std::exp(-y_plus / 3.0));
    const WallStress stress = reichardt(u_plus * u_tau, y, nu);
    EXPECT_NEAR(stress.over_rho, u_tau * u_tau, 2e-4 * u_tau * u_tau) << y_plus;
    EXPECT_NEAR(stress.y_plus, y_plus, 1e-4 * y_plus);
  }
}

// The channel of Moser, Kim & Mansour, Phys. Fluids 11, 943 (1999), Re_tau 178: speeds at six distances. 4 % in speed.
TEST(WallModel, ReichardtsLawIsThatOfAChannel) {
  const double table[6][2] = {{7.6698, 6.9892}, {13.5585, 10.311}, {21.0324, 12.52},
                              {30.0186, 13.87}, {49.1, 15.26},     {79.2, 16.52}};
  for (const auto& [y_plus, u_plus] : table) {
    const double nu = 1.0, y = y_plus;  // so u_tau = 1
    EXPECT_NEAR(std::sqrt(reichardt(u_plus, y, nu).over_rho), 1.0, 0.04) << y_plus;
  }
}

// A square duct turned by 45 degrees about its axis: every other cell of the staircase has a single cut link, across
// the flow. The areas for a stress along the flow add up to the walls'. 24 cells a side; a corner is off by a cell at
// most, 1/24.
TEST(WallModel, TheAreasOfAStaircaseAddUpToItsWall) {
  BoxScene scene = make_box(Vec3(4, 24, 24), 1.0, {periodic(), periodic(), wall(), wall(), wall(), wall()});
  const double s = std::sqrt(0.5);
  for (Vec3& x : scene.mesh.vertices) x = Vec3(x[0], 20.3 + s * (x[1] - x[2]), s * (x[1] + x[2]) + 2.2);
  auto& v = scene.voxels;
  v.size = {4, 41, 41};
  v.fill([&](int i, int j, int k) {
    const Vec3 x = v.centre(i, j, k);
    const double a = s * (x[1] - 20.3 + x[2] - 2.2), b = s * (x[2] - 2.2 - x[1] + 20.3);
    return a > 0.0 && a < 24.0 && b > 0.0 && b < 24.0;
  });
  AirOptions options;
  options.wall_model = true;
  const Air air = make_air(scene, options);
  double along = 0.0;
  for (const ModelledCell& cell : air.wall_model->cells) along += cell.area[0];
  EXPECT_NEAR(along, 4.0 * 96.0, 4.0 * 96.0 / 24.0);
}

// One step at rest but for a stream along the wall: the wall gets the stress of the law, to the rounding of float
// targets, and no mass is lost.
TEST(WallModel, TheWallGetsTheStressOfTheLaw) {
  BoxScene scene = make_box(Vec3(8, 12, 8), 1.0, {periodic(), periodic(), wall(), wall(), periodic(), periodic()});
  AirOptions options;
  options.double_precision = true;
  options.wall_model = true;
  Air air = make_air(scene, options);
  set_cells([](const Vec3&) { return InitialCell{0.0, {0.1, 0.0, 0.0}, {}}; }, air);
  const double before = mass_excess(air), nu = 1e-4;
  const Drive drive = at_rest(air);
  step(air, 0.5 + 3.0 * nu, drive);
  const WallStress law = reichardt(0.1, 2.5, nu);
  ASSERT_GT(law.y_plus, 15.0);
  EXPECT_NEAR(force_on_patch(air, 2)[0], 64.0 * law.over_rho, 1e-5 * 64.0 * law.over_rho);
  EXPECT_NEAR(mass_excess(air), before, 1e-12);
}

TEST(WallModel, LeavesLaminarFlowAlone) {
  std::vector<double> speed;
  for (const bool model : {false, true}) {
    BoxScene scene = make_box(Vec3(4, 9, 4), 1.0, {periodic(), periodic(), wall(), wall(), periodic(), periodic()});
    AirOptions options;
    options.smagorinsky = 0.0;
    options.double_precision = true;
    options.wall_model = model;
    Air air = make_air(scene, options);
    Drive drive = at_rest(air);
    drive.uniform_force = {1e-6, 0, 0};  // peak 1e-4 at nu = 0.1: y+ below 1
    for (int t = 0; t < 300; ++t) step(air, 0.8, drive);
    speed.push_back(moments_at(air, air.rows.active_slot(1, 5, 1)).ux);
  }
  EXPECT_EQ(speed[0], speed[1]);
}
