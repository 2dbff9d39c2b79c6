// Slip walls: no friction, nothing lost.

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/mass_fluxes.hpp"
#include "tests/lbm/box_scene.hpp"

namespace puffin::lbm::test {
namespace {

using geometry::Vec3;

Boundary slip() { return {"", BoundaryKind::slip, {}}; }

Air make(BoxScene& scene) {
  AirOptions options;
  options.smagorinsky = 0.0;
  options.double_precision = true;
  return make_air(scene, options);
}

// Specular reflection keeps the tangential momentum of every population: a uniform stream between slip walls is steady
// to rounding, 200 steps of 1e-16.
TEST(Slip, AUniformStreamAlongSlipWallsStaysWhatItIs) {
  for (const Vec3& u : {Vec3(0.05, 0, 0), Vec3(0.03, 0.04, 0)}) {
    // Periodic where the stream crosses, slip on the other sides: corners of slip walls among them.
    const bool across = u[1] != 0.0;
    const Boundary y = across ? periodic() : slip();
    BoxScene scene = make_box(Vec3(8, 6, 5), 1.0, {periodic(), periodic(), y, y, slip(), slip()});
    Air air = make(scene);
    set_cells([&](const Vec3&) { return InitialCell{0.0, {u[0], u[1], u[2]}, {}}; }, air);
    const Drive drive = at_rest(air);
    for (int t = 0; t < 200; ++t) step(air, 0.6, drive);
    for (const auto& run : air.rows.runs())
      for (int n = 0; n < run.count; ++n) {
        const auto m = moments_at(air, run.first + n);
        ASSERT_LT((Vec3(m.ux, m.uy, m.uz) - u).norm(), 1e-13);
        ASSERT_LT(std::abs(m.density_excess), 1e-13);
      }
  }
}

// Plane Poiseuille flow is symmetric: half a channel closed by a slip wall is the lower half of the whole channel, cell
// by cell, to rounding.
TEST(Slip, HalfAChannelWithASlipWallIsTheWholeChannel) {
  const auto run = [](double height, const Boundary& top) {
    BoxScene scene = make_box(Vec3(4, 3, height), 1.0, {periodic(), periodic(), periodic(), periodic(), wall(), top});
    Air air = make(scene);
    Drive drive = at_rest(air);
    drive.uniform_force = {1e-4, 2e-5, 0};
    for (int t = 0; t < 1500; ++t) step(air, 0.8, drive);
    std::vector<Vec3> u;
    for (int k = 0; k < 6; ++k) {
      const auto m = moments_at(air, air.rows.slot(1, 1, k + 1));
      u.emplace_back(m.ux, m.uy, m.uz);
    }
    return u;
  };
  const auto half = run(6.0, slip()), whole = run(12.0, wall());
  for (int k = 0; k < 6; ++k) EXPECT_LT((half[k] - whole[k]).norm(), 1e-13) << k;
  EXPECT_GT(half[5][0], 1e-3) << "the scene is meant to flow";
}

TEST(Slip, AStirredBoxOfSlipWallsKeepsItsMassAndItsWallsFeelPressureAlone) {
  BoxScene scene = make_box(Vec3(9, 8, 7), 1.0, {slip(), slip(), slip(), slip(), slip(), slip()});
  Air air = make(scene);
  set_cells(
      [&](const Vec3& x) {
        return InitialCell{
            0.01 * std::sin(x[1]), {0.05 * std::sin(x[1]), 0.03 * std::cos(x[2]), 0.04 * std::sin(x[0])}, {}};
      },
      air);
  const double before = mass_excess(air);
  const Drive drive = at_rest(air);
  for (int t = 0; t < 200; ++t) {
    step(air, 0.55, drive);
    const auto f = force_on_patch(air, 4);  // z-min
    EXPECT_EQ(f[0], 0.0);
    EXPECT_EQ(f[1], 0.0);
  }
  // 200 steps x 504 cells x 19 additions of 1e-17: random signs, 1e-14; bound 1e-12.
  EXPECT_NEAR(mass_excess(air), before, 1e-12);
}

// What slides along the wall from cell to cell is carried by the faces too: the fluxes balance each cell's density.
TEST(Slip, MassFluxesBesideSlipWallsBalanceTheChangeOfDensity) {
  for (const Boundary& x : {periodic(), slip()}) {
    BoxScene scene = make_box(Vec3(8, 6, 5), 1.0, {x, x, slip(), slip(), slip(), wall()});
    Air air = make(scene);
    set_cells(
        [&](const Vec3& at) {
          return InitialCell{0.0, {0.05 * std::sin(at[1]), 0.04 * std::cos(at[2]), 0.03 * std::sin(at[0])}, {}};
        },
        air);
    FaceFluxes fluxes;
    const FluxRoutes routes = find_routes(air, fluxes);
    const Drive drive = at_rest(air);
    for (int t = 0; t < 7; ++t) {
      std::vector<double> before(air.rows.slots(), 0.0);
      for (const auto& run : air.rows.runs())
        for (int n = 0; n < run.count; ++n) before[run.first + n] = moments_at(air, run.first + n).density_excess;
      step(air, 0.6, drive);
      find_mass_fluxes(air, routes, 0.0, fluxes);
      for (const auto& run : air.rows.runs())
        for (int n = 0; n < run.count; ++n) {
          const std::ptrdiff_t s = run.first + n;
          double in = 0.0;
          const auto c = air.rows.cell(s);
          for (int d = 0; d < 3; ++d) {
            auto low = c;
            --low[d];
            const std::ptrdiff_t below = air.rows.slot(low[0], low[1], low[2]);
            in += (below >= 0 ? fluxes.mass[d][below] : 0.0) - fluxes.mass[d][s];
          }
          // Sums of some 40 terms of up to 0.01.
          ASSERT_NEAR(moments_at(air, s).density_excess - before[s], in, 1e-15) << t;
        }
    }
  }
}

}  // namespace
}  // namespace puffin::lbm::test
