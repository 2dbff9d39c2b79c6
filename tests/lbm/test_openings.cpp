// What comes back at outlets: parallel shear flow leaves through them as it came.

#include "lbm/openings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/lbm/box_scene.hpp"
#include "tests/lbm/prism_scene.hpp"

using namespace puffin::lbm;
using namespace puffin::lbm::test;
using geometry::Vec3;

namespace {

constexpr double lid_speed = 0.1, height = 12.0;

AirOptions laminar() {
  AirOptions options;
  options.double_precision = true;
  options.smagorinsky = 0.0;
  return options;
}

/// Plane Couette flow between an inlet and an outlet, already there at the start.
Air couette(double tau, int steps) {
  const auto shear = [](const Vec3& x) { return Vec3(2.0 * x[2] / height, 0, 0); };  // mean 1
  const Boundary inlet{"", BoundaryKind::velocity_inlet, shear, true};
  const Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
  const Boundary lid{"", BoundaryKind::wall, [](const Vec3&) { return Vec3(1, 0, 0); }, false, true};
  BoxScene scene = make_box(Vec3(30, 2, height), 1.0, {inlet, outlet, periodic(), periodic(), wall(), lid});
  Air air = make_air(scene, laminar());
  Drive drive = at_rest(air);
  drive.speed[0] = 0.5 * lid_speed;
  drive.speed[5] = lid_speed;
  set_cells([](const Vec3& x) { return InitialCell{0.0, {lid_speed * x[2] / height, 0, 0}, {}}; }, air);
  for (int t = 0; t < steps; ++t) step(air, tau, drive);
  return air;
}

/// Largest deviation of the velocity from the exact one over the lid's speed.
double largest_error(const Air& air) {
  double most = 0.0;
  for (const Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const auto m = moments_at(air, run.first + n);
      const double exact = lid_speed * air.rows.centre(run.first + n)[2] / height;
      most = std::max({most, std::abs(m.ux - exact), std::abs(m.uz)});
    }
  return most / lid_speed;
}

}  // namespace

// Couette flow solves the equations with one pressure everywhere, so an outlet at that pressure changes nothing, and
// the lid carries u/6 along in the links that it cuts, which the inlet's links need not bring. What is left (0.0005,
// 0.0004 and 0.0026 were measured) goes with the square of the lid's speed, 0.01, that the density answers; 0.005 is an
// eighth of the fault. With anti-bounce-back waves of the lid's own speed ran along the outlet at tau 0.504; while the
// links through the edge of lid and outlet were the outlet's, 0.084 and 0.066 were left at tau 0.503 and 0.52; 0.04
// while the inlet brought what the lid carries.
TEST(Outlets, ShearFlowLeavesAsItCame) {
  for (const double tau : {0.503, 0.52, 0.8}) EXPECT_LT(largest_error(couette(tau, 3000)), 0.005) << tau;
}

// Plates that slide, and an inlet: the flow between them, half a cell of each wall's links included, is what was asked
// for. The plates move with the stream (nothing rubs, so the speed is the inlet's everywhere), at a tenth of it, and
// beside a parabolic inlet, whose speed at the edge is none. The links hold floats.
TEST(Outlets, BesidePlatesThatSlideTheFlowIsWhatWasAskedFor) {
  constexpr double h = 6.0, speed = 0.02;
  const auto along = [](const Vec3&) { return Vec3(1, 0, 0); };
  const auto parabola = [](const Vec3& x) { return Vec3(6.0 * x[2] * (h - x[2]) / (h * h), 0, 0); };
  const Boundary outlet{"", BoundaryKind::pressure_outlet, {}}, plate{"", BoundaryKind::wall, along, false, true};
  for (const bool parabolic : {false, true})
    for (const double part : {1.0, 0.1}) {
      Boundary inlet{"", BoundaryKind::velocity_inlet, along};
      if (parabolic) inlet.profile = parabola, inlet.exact_flow = true;
      BoxScene scene = make_box(Vec3(24, 2, h), 1.0, {inlet, outlet, periodic(), periodic(), plate, plate});
      Air air = make_air(scene, laminar());
      Drive drive = at_rest(air);
      drive.speed[0] = speed;
      drive.speed[4] = drive.speed[5] = part * speed;
      set_cells([&](const Vec3&) { return InitialCell{0.0, {speed, 0, 0}, {}}; }, air);
      for (int t = 0; t < 3000; ++t) step(air, 0.8, drive);
      double flow = 0.0, off = 0.0;
      for (const puffin::lbm::Run& run : air.rows.runs())
        for (int n = 0; n < run.count; ++n) {
          const auto m = moments_at(air, run.first + n);
          off = std::max(off, std::abs(m.ux - speed));
          if (std::abs(air.rows.centre(run.first + n)[0] - 20.5) < 0.1) flow += (1.0 + m.density_excess) * m.ux;
        }
      EXPECT_NEAR(flow / (2.0 * h * speed), 1.0, 1e-4) << parabolic << ' ' << part;
      if (!parabolic && part == 1.0) EXPECT_LT(off, 1e-8);
    }
}

// The cell beside, along the link, or the own one at the end of the outlet; and the cell behind.
TEST(Outlets, LinksTakeWhatTheCellsBesideAndBehindThemHold) {
  const Air air = couette(0.6, 0);
  const auto sources = find_outlet_sources(air.rows, air.links.outlets);
  ASSERT_EQ(sources.size(), air.links.outlets.size());
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const OpeningLink& link = air.links.outlets[n];
    const auto own = air.rows.cell(link.slot), beside = air.rows.cell(air.links.outlets[sources[n].beside].slot);
    const auto& c = d3q19::velocity[link.direction];
    EXPECT_EQ(beside[0], own[0]);
    EXPECT_EQ(beside[1], c[1] == 0 ? own[1] : (own[1] == 0 ? 1 : 0));  // two cells across, periodic
    const int k = own[2] + c[2];
    EXPECT_EQ(beside[2], k < 1 || k > static_cast<int>(height) ? own[2] : k);
    ASSERT_GE(sources[n].behind, 0);
    EXPECT_EQ(air.rows.cell(sources[n].behind), (std::array{beside[0] - 1, beside[1], beside[2]}));
    const puffin::lbm::Run& run = air.rows.runs()[sources[n].run_behind];
    EXPECT_TRUE(sources[n].behind >= run.first && sources[n].behind < run.first + run.count);
  }
}

// A wall a tenth of a cell from the first centres reads the population of the cell behind, which beside an outlet lies
// beyond it. Channel of 7.6 cells at tau 0.51: friction takes 12 nu U/h^2 = 0.014 rho U^2 a cell, 0.021 from the second
// last cells to the outlet; as much again for the profile, which still grows. It was 0.60 below and 0.22 above the
// outlet's in the two cells at the wall while they took half of the reflection from themselves.
TEST(Outlets, WallsNearerThanHalfACellReadWhatComesBack) {
  const double h = 7.6, length = 40.0, speed = 0.05;
  const Boundary inlet{"", BoundaryKind::velocity_inlet, [](const Vec3&) { return Vec3(1, 0, 0); }, true};
  const Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
  BoxScene scene =
      make_box(Vec3(length, h, 1), 1.0, {inlet, outlet, wall(), wall(), periodic(), periodic()}, Vec3(0, -0.4, 0));
  Air air = make_air(scene, laminar());
  Drive drive = at_rest(air);
  drive.speed[0] = speed;
  for (int t = 0; t < 6000; ++t) step(air, 0.51, drive);
  for (const puffin::lbm::Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const Vec3 x = air.rows.centre(run.first + n);
      if (x[0] < length - 2.0) continue;
      const auto m = moments_at(air, run.first + n);
      EXPECT_NEAR(m.density_excess / 3.0 / (speed * speed), 0.0, 0.042) << x.transpose();
    }
}

// Two outlets that meet in an edge, air at rest at the pressure of the first: nothing goes through that one, and each
// link of the second, those in the cells of the edge too, lets 2 w (rho_out - rho) in. Rounding of doubles.
TEST(Outlets, TwoInACellHoldEachItsOwnPressure) {
  const Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
  BoxScene scene = make_box(Vec3(6, 2, 6), 1.0, {wall(), outlet, periodic(), periodic(), wall(), outlet});
  AirOptions options;
  options.double_precision = true;
  Air air = make_air(scene, options);
  set_cells([](const Vec3&) { return InitialCell{0.01, {0, 0, 0}, {}}; }, air);
  Drive drive = at_rest(air);
  drive.density_excess[1] = 0.01;
  drive.density_excess[5] = 0.004;
  step(air, 0.7, drive);
  double expected = 0.0;
  int in_edge = 0;
  for (const OpeningLink& link : air.links.outlets) {
    if (link.patch != 5) continue;
    expected += 2.0 * d3q19::weight[link.direction] * (0.004 - 0.01);
    in_edge += air.rows.cell(link.slot)[0] == 6 ? 1 : 0;
  }
  EXPECT_GE(in_edge, 6);  // two cells
  EXPECT_NEAR(mass_through(air, 1), 0.0, 1e-15);
  EXPECT_NEAR(mass_through(air, 5) / expected, 1.0, 1e-12);
}

// A hole of 4 cells in the middle of an end wall of 10, Re 10: the flow quickens towards it, by 0.4 of the inlet's
// speed U over the last cell. At the same Reynolds number the pressure over rho U^2 knows nothing of U, in lattice
// units. What an outlet gets wrong in proportion to U is seen there as 1/U. Anti-bounce-back, which returns the stress
// of that cell with the wrong sign, changed the pressure by 0.195 from U = 0.02 to 0.005: 0.008 rho U in lattice units,
// a fiftieth of what the speed grows by. 0.25 leaves room over that, and tells it from the own cell's populations,
// which gave 0.55; what the cells beside hold, whose speed is another there, changed it 73 times.
TEST(Outlets, AHoleInAWallHoldsItsPressureAtEverySpeed) {
  const auto pressure = [](double speed) {
    const Boundary inlet{"", BoundaryKind::velocity_inlet, [](const Vec3&) { return Vec3(1, 0, 0); }, true};
    const Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
    BoxScene scene = make_prism({{0, 0}, {20, 0}, {20, 3}, {20, 7}, {20, 10}, {0, 10}},
                                {wall(), wall(), outlet, wall(), wall(), inlet}, 2);
    Air air = make_air(scene, laminar());
    Drive drive = at_rest(air);
    drive.speed[5] = speed;
    for (int t = 0; t < static_cast<int>(300.0 / speed); ++t) step(air, 0.5 + 3.0 * speed, drive);
    double inside = 0.0;  // mean of 10 x 2 cells, half way
    for (const puffin::lbm::Run& run : air.rows.runs())
      for (int n = 0; n < run.count; ++n)
        if (std::abs(air.rows.centre(run.first + n)[0] - 10.5) < 0.1)
          inside += moments_at(air, run.first + n).density_excess / 3.0 / 20.0;
    return inside / (speed * speed);
  };
  const double fast = pressure(0.02), slow = pressure(0.005);
  EXPECT_NEAR(slow / fast, 1.0, 0.25) << fast << ' ' << slow;
}

// Plates turned by 25 degrees between two outlets whose pressures balance a force along them: the air stays at rest.
// The outlets lie half way along the links that they cut, up to half a cell from their plane, so up to 1 of 24 cells of
// the force is not balanced, and drives that part of F h^2/(8 nu). What the cells beside held made 0.5 of it.
TEST(Outlets, AnObliqueOutletHoldsThePressureThatBalancesAForce) {
  const double length = 24.0, h = 10.0, force = 2e-6, tau = 0.6, turn = M_PI * 25.0 / 180.0;
  const Eigen::Vector2d along(std::cos(turn), std::sin(turn)), across(-along.y(), along.x());
  const Eigen::Vector2d origin(10.3, 5.7);
  const Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
  BoxScene scene =
      make_prism({origin, origin + length * along, origin + length * along + h * across, origin + h * across},
                 {wall(), outlet, wall(), outlet}, 2);
  Air air = make_air(scene, laminar());
  Drive drive = at_rest(air);
  drive.density_excess[1] = 3.0 * force * length;
  drive.uniform_force = {force * along.x(), force * along.y(), 0.0};
  for (int t = 0; t < 6000; ++t) step(air, tau, drive);
  double most = 0.0;
  for (const puffin::lbm::Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const Eigen::Vector2d x = air.rows.centre(run.first + n).head<2>() - origin;
      if (std::abs(x.dot(along) - 0.5 * length) > 4.0) continue;
      const auto m = moments_at(air, run.first + n);
      most = std::max(most, std::hypot(m.ux, m.uy));
    }
  EXPECT_LT(most, force * h * h / (8.0 * (tau - 0.5) / 3.0) / length);
}
