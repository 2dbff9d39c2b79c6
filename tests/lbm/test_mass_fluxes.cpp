// The face fluxes carry exactly the mass that the links exchange.

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/mass_fluxes.hpp"
#include "lbm/wall_schemes.hpp"
#include "tests/lbm/box_scene.hpp"

using namespace puffin::lbm;
using namespace puffin::lbm::test;
using geometry::Vec3;

namespace {

/// Largest difference between the change of density in a step and the net flux through the faces.
double imbalance(BoxScene scene, const Drive* given, double speed) {
  AirOptions options;
  options.double_precision = true;
  Air air = make_air(scene, options);
  Drive drive = given ? *given : at_rest(air);
  drive.speed.assign(air.boundaries.size(), speed);
  set_cells(
      [&](const Vec3& x) {
        InitialCell cell;
        cell.velocity = {0.05 * std::sin(x[1]), 0.03 * std::cos(x[2]), 0.04 * std::sin(x[0])};
        return cell;
      },
      air);
  FaceFluxes fluxes;
  const FluxRoutes routes = find_routes(air, fluxes);
  double worst = 0.0;
  for (int t = 0; t < 7; ++t) {  // both parities
    step(air, 0.6, drive);
    find_mass_fluxes(air, routes, wall_speed(drive, air), fluxes);
    const auto before = fluxes.density;
    step(air, 0.6, drive);
    find_mass_fluxes(air, routes, wall_speed(drive, air), fluxes);
    for (const Run& run : air.rows.runs())
      for (int n = 0; n < run.count; ++n) {
        const std::ptrdiff_t s = run.first + n;
        double in = fluxes.mass[0][s - 1] - fluxes.mass[0][s];
        in += fluxes.mass[1][s + run.shift[0][1]] - fluxes.mass[1][s];
        in += fluxes.mass[2][s + run.shift[1][0]] - fluxes.mass[2][s];
        worst = std::max(worst, std::abs(fluxes.density[s] - before[s] - in));
      }
    step(air, 0.6, drive);
  }
  return worst;
}

}  // namespace

// Populations are of order 0.1 and 40 of them are added in double: round-off below 1e-15 x 40.
TEST(MassFluxes, BalanceTheDensityInAClosedBoxOffTheGrid) {
  EXPECT_LT(
      imbalance(make_box(Vec3(12, 10, 9), 1.0, {wall(), wall(), wall(), wall(), wall(), wall()}, Vec3(0.3, 0.2, 0.4)),
                nullptr, 0.0),
      4e-14);
}

TEST(MassFluxes, BalanceTheDensityAcrossPeriodicFaces) {
  EXPECT_LT(imbalance(make_box(Vec3(12, 10, 9), 1.0, {periodic(), periodic(), wall(), wall(), periodic(), periodic()}),
                      nullptr, 0.0),
            4e-14);
}

TEST(MassFluxes, BalanceTheDensityAtInletAndOutlet) {
  const Boundary inlet{"", BoundaryKind::velocity_inlet, [](const Vec3&) { return Vec3(1, 0, 0); }};
  const Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
  EXPECT_LT(imbalance(make_box(Vec3(12, 8, 8), 1.0, {inlet, outlet, wall(), wall(), wall(), wall()}), nullptr, 0.03),
            4e-14);
}

// What a sliding wall carries passes faces too, on the grid and off it.
TEST(MassFluxes, BalanceTheDensityBesideASlidingWall) {
  const Boundary lid{"", BoundaryKind::wall, [](const Vec3&) { return Vec3(0.8, 0.6, 0); }};
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(0.3, 0.2, 0.4)})
    EXPECT_LT(
        imbalance(make_box(Vec3(12, 10, 9), 1.0, {wall(), wall(), wall(), wall(), wall(), lid}, offset), nullptr, 0.05),
        4e-14);
}
