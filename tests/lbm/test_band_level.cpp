// The live band behind walls with markers: whose pressure it has, and what it is to an outlet.

#include "lbm/band_level.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "lbm/markers.hpp"
#include "lbm/mass_fluxes.hpp"
#include "lbm/scalars/face_fluxes.hpp"
#include "tests/lbm/box_scene.hpp"

using namespace puffin::lbm;
using namespace puffin::lbm::test;
using geometry::Vec3;

namespace {

constexpr double length = 32.0, height = 10.0, tau = 0.51, speed = 0.05;

/// A plane channel along x from an inlet with the parabola of mean `speed` to an outlet held at rho = 1, walls with
/// markers.
struct OpenChannel {
  OpenChannel() {
    Boundary in = wall(), out = wall();
    in.kind = BoundaryKind::velocity_inlet;
    in.exact_flow = true;
    in.profile = [](const Vec3& at) { return Vec3(6.0 * at.y() / height * (1.0 - at.y() / height), 0, 0); };
    out.kind = BoundaryKind::pressure_outlet;
    scene = make_box(Vec3(length, height, 4), 1.0, {in, out, wall(), wall(), periodic(), periodic()});
    AirOptions options;
    options.wall = WallScheme::ibm;
    options.markers.retraction = retraction_for(tau);
    options.smagorinsky = 0.0;
    air = make_air(scene, options);
    drive = at_rest(air);
    drive.speed[0] = speed;
  }
  double pressure(double x) const {  // [rho c_s^2], mean of the column of fluid cells
    double sum = 0.0;
    int cells = 0;
    for (const auto& run : air.rows.runs())
      for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
        if (air.is_fluid(s) && std::abs(air.rows.centre(s).x() - x) < 0.01)
          sum += moments_at(air, s).density_excess / 3.0, ++cells;
    return sum / cells;
  }
  BoxScene scene;
  Air air;
  Drive drive;
};

}  // namespace

TEST(BandLevel, EachCellOfTheBandHasTheFluidCellBeforeItAsItsRoot) {
  const OpenChannel c;
  const auto root = band_roots(c.air.rows, c.air.fluid, c.air.links);
  int behind = 0;
  for (const auto& run : c.air.rows.runs())
    for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s) {
      ASSERT_GE(root[s], 0);
      const Vec3 own = c.air.rows.centre(s), at = c.air.rows.centre(root[s]);
      EXPECT_EQ(at.x(), own.x());
      EXPECT_EQ(at.z(), own.z());
      EXPECT_NEAR(at.y(), std::clamp(own.y(), 0.5, height - 0.5), 1e-12);
      behind += c.air.is_fluid(s) ? 0 : 1;
    }
  EXPECT_EQ(behind, 2 * 2 * 32 * 4) << "two rows behind each wall";
}

TEST(BandLevel, MovesMassToWhereItIsMissingAndNoMomentum) {
  OpenChannel c;
  auto& p = std::get<Populations<float>>(c.air.populations);
  set_cells([](const Vec3& x) { return InitialCell{x.y() < 0.0 ? 0.02 : 0.0, {0.01, 0, 0}, {}}; }, c.air);
  const double mass = mass_excess(c.air);
  const auto moments = [&](double y) {
    for (const auto& run : c.air.rows.runs())
      for (std::ptrdiff_t s = run.first; s < run.first + run.count; ++s)
        if ((c.air.rows.centre(s) - Vec3(16.5, y, 1.0)).norm() < 0.8) return moments_at(c.air, s);
    throw std::logic_error("no such cell");
  };
  for (int n = 0; n < 200; ++n) level_band(c.air.markers->level, c.air.rows, p);
  // Two cells of the band at 0.02 and their root at 0: a third of 0.04 each. Single precision: 200 x 1e-7 at most.
  for (const double y : {-1.5, -0.5, 0.5}) {
    EXPECT_NEAR(moments(y).density_excess, 0.04 / 3.0, 2e-5) << y;
    const double momentum = moments(y).ux * (1.0 + moments(y).density_excess);
    EXPECT_NEAR(momentum, y < 0.0 ? 0.0102 : 0.01, 2e-5) << y << ": that of the start, 0.01 times rho";
  }
  EXPECT_NEAR(moments(1.5).density_excess, 0.0, 1e-7) << "a cell with nobody behind it";
  EXPECT_NEAR(mass_excess(c.air), mass, 1e-5 * mass);
}

// Exact: 12 nu U / H^2 a length. The wall acts up to 0.1 cells from where it is (docs/results/walls/ibm-channels.csv),
// which is 6 % of the gradient. What is left at the outlet's end and in the inlet's corner was found, not derived:
// below 0.02 and 0.1 of rho/2 U^2, of which the drop is 0.5 here. With a sealed band the drop past the inlet was 16 %
// too large, with an outlet that ends at the wall, too, 0.35 of rho/2 U^2 too little.
TEST(BandLevel, BetweenOpeningsAPlaneChannelLosesItsPressure) {
  OpenChannel c;
  const double nu = (tau - 0.5) / 3.0, gradient = 12.0 * nu * speed / (height * height);
  set_cells(
      [&](const Vec3& x) {
        const double s = x.y() / height;
        return InitialCell{3.0 * gradient * (length - x.x()), {std::max(0.0, 6.0 * speed * s * (1.0 - s)), 0, 0}, {}};
      },
      c.air);
  double drop = 0.0, later = 0.0;
  for (int t = 0; t < 9000; ++t) {
    ASSERT_FALSE(step(c.air, tau, c.drive).bad);
    if (t < 8000) continue;
    drop += (c.pressure(0.5) - c.pressure(length - 0.5)) / 1000.0;
    later += (c.pressure(8.5) - c.pressure(length - 0.5)) / 1000.0;
  }
  EXPECT_NEAR(later / (gradient * (length - 9.0)), 1.0, 0.06 + 0.04);
  EXPECT_NEAR(drop / (gradient * (length - 1.0)), 1.0, 0.06 + 0.04 + 0.2) << "with the inlet's corner";
  EXPECT_NEAR(c.pressure(length - 0.5), 0.5 * gradient, 0.02 * 0.5 * speed * speed) << "the outlet's own row";
}

// A band cell's link through the outlet is booked on the face of its root: what flows into a root and its part of the
// band is what its mass gains.
TEST(BandLevel, ScalarsSeeTheOutletsFlowOnTheFacesOfTheFluid) {
  OpenChannel c;
  for (int t = 0; t < 200; ++t) step(c.air, tau, c.drive);
  FaceFluxes fluxes;
  const FluxRoutes routes = find_routes(c.air, fluxes);
  std::set<std::ptrdiff_t> from;
  for (const auto& o : routes.openings) {
    from.insert(o.slot);
    const Vec3 at = c.air.rows.centre(o.sign > 0 ? o.face : o.slot);
    EXPECT_TRUE(at.y() > 0.0 && at.y() < height) << at.transpose();
  }
  const auto behind = [&](std::ptrdiff_t s) { return !c.air.is_fluid(s); };
  EXPECT_EQ(std::count_if(from.begin(), from.end(), behind), 2 * 4) << "the band's first row at the outlet";
  find_mass_fluxes(c.air, routes, 0.0, fluxes);
  double through = 0.0;
  for (std::size_t s = 0; s < fluxes.open[0].size(); ++s)
    if (fluxes.open[0][s] == 2 && c.air.rows.is_active(static_cast<std::ptrdiff_t>(s))) through += fluxes.mass[0][s];
  EXPECT_NEAR(through, -mass_through(c.air, 1), 1e-6 * std::abs(through));
}
