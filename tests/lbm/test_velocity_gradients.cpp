// The velocity gradient at every cell, at walls and openings too, and the laws that live on it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lbm/vreman.hpp"
#include "tests/lbm/box_scene.hpp"

using namespace puffin::lbm;
using namespace puffin::lbm::test;
using geometry::Vec3;

namespace {

AirOptions hrr() {
  AirOptions options;
  options.law = Law::hrr;
  options.double_precision = true;
  options.smagorinsky = 0.0;
  return options;
}

/// Finds the strain rate of a velocity field in a box; wall_speed: of the boundaries with a profile.
Air strained(BoxScene& scene, AirOptions options, const std::function<Vec3(const Vec3&)>& u, double wall_speed = 0.0) {
  Air air = make_air(scene, options);
  set_cells(
      [&](const Vec3& x) {
        const Vec3 v = u(x);
        return InitialCell{0.0, {v[0], v[1], v[2]}, {}};
      },
      air);
  std::vector<double> speed(air.boundaries.size(), wall_speed);
  std::visit(
      [&]<class T>(const Populations<T>& p) {
        find_velocity_gradients(air.rows, p, speed, 0.51, air.options.isa, air.gradients, air.les);
      },
      air.populations);
  return air;
}

/// Largest error of one component of the strain rate over all cells.
double largest_error(const Air& air, int n, const std::function<double(const Vec3&)>& exact) {
  double error = 0.0;
  for (const Run& run : air.rows.runs())
    for (int k = 0; k < run.count; ++k)
      error = std::max(error, std::abs(air.gradients.strain[n][run.first + k] - exact(air.rows.centre(run.first + k))));
  return error;
}

constexpr double float_rounding = 1e-7;  // velocities of 0.1 in float (1e-8), a few of them subtracted

/// Viscosity of a decaying shear wave u_y = a sin(kx), as in test_air.cpp.
double shear_wave_viscosity(int n, double tau, AirOptions options) {
  BoxScene scene =
      make_box(Vec3(n, 4, 4), 1.0, {periodic(), periodic(), periodic(), periodic(), periodic(), periodic()});
  Air air = make_air(scene, options);
  const double k = 2.0 * std::numbers::pi / n, a = 1e-2, nu = (tau - 0.5) / 3.0;
  set_cells(
      [&](const Vec3& x) {
        InitialCell cell;
        cell.velocity[1] = a * std::sin(k * x[0]);
        cell.stress[3] = -2.0 / 3.0 * tau * 0.5 * a * k * std::cos(k * x[0]);
        return cell;
      },
      air);
  const auto amplitude = [&] {
    double sum = 0.0;
    for (const Run& run : air.rows.runs())
      for (int m = 0; m < run.count; ++m)
        sum += moments_at(air, run.first + m).uy * std::sin(k * air.rows.centre(run.first + m)[0]);
    return sum;
  };
  const Drive drive = at_rest(air);
  const double start = amplitude();
  const int steps = static_cast<int>(0.5 / (nu * k * k));
  for (int t = 0; t < steps; ++t) step(air, tau, drive);
  return std::log(start / amplitude()) / (k * k * steps);
}

}  // namespace

TEST(VelocityGradients, AreExactForAParabolaBetweenWallsWhereverTheyLie) {
  // Central and three-point differences are exact for second degree; walls nearer than half a cell give the slope half
  // way between wall and far neighbour, off by (h - 1)/2 u'' = at most u''/2: offset 0.2 has walls at 0.7 and 0.3.
  const double curvature = 2.0 * 0.4 / 100.0;  // u'' of 0.4 y (H - y)/H^2, H = 10
  for (const double offset : {0.0, 0.2}) {
    BoxScene scene = make_box(Vec3(4, 10, 4), 1.0, {periodic(), periodic(), wall(), wall(), periodic(), periodic()},
                              Vec3(0, offset, 0));
    const Air air =
        strained(scene, hrr(), [](const Vec3& x) { return Vec3(0.4 * x[1] * (10.0 - x[1]) / 100.0, 0, 0); });
    const double error = largest_error(air, 3, [](const Vec3& x) { return 0.5 * 0.4 * (10.0 - 2.0 * x[1]) / 100.0; });
    EXPECT_LT(error, float_rounding + (offset > 0.0 ? 0.5 * curvature / 2.0 : 0.0)) << offset;
  }
}

TEST(VelocityGradients, SeeTheSpeedOfAMovingWall) {
  // Couette: u_x = 0.08 y/H, the upper wall moves.
  Boundary lid{"", BoundaryKind::wall, [](const Vec3&) { return Vec3(1, 0, 0); }};
  BoxScene scene =
      make_box(Vec3(4, 8, 4), 1.0, {periodic(), periodic(), wall(), lid, periodic(), periodic()}, Vec3(0, 0.4, 0));
  const Air air = strained(
      scene, hrr(), [](const Vec3& x) { return Vec3(0.08 * x[1] / 8.0, 0, 0); }, 0.08);
  EXPECT_LT(largest_error(air, 3, [](const Vec3&) { return 0.5 * 0.08 / 8.0; }), float_rounding);
}

TEST(VelocityGradients, CrossPeriodicFacesAndLeaveOutTheTrace) {
  // u_x = sin(kx): central differences give k cos(kx) sinc(k), a third of it is taken out as trace.
  const int n = 16;
  const double k = 2.0 * std::numbers::pi / n;
  BoxScene scene =
      make_box(Vec3(n, 4, 4), 1.0, {periodic(), periodic(), periodic(), periodic(), periodic(), periodic()});
  const Air air = strained(scene, hrr(), [&](const Vec3& x) { return Vec3(0.1 * std::sin(k * x[0]), 0, 0); });
  const auto slope = [&](const Vec3& x) { return 0.1 * std::sin(k) * std::cos(k * x[0]); };
  EXPECT_LT(largest_error(air, 0, [&](const Vec3& x) { return 2.0 / 3.0 * slope(x); }), float_rounding);
  EXPECT_LT(largest_error(air, 1, [&](const Vec3& x) { return -1.0 / 3.0 * slope(x); }), float_rounding);
}

TEST(VelocityGradients, AreMirroredAtASlipWallAndOneSidedAtOpenings) {
  // u_x = 0.1 + 0.002 x, u_z free of y: openings at x, slip at y, walls would give other numbers.
  Boundary inlet{"", BoundaryKind::velocity_inlet, [](const Vec3&) { return Vec3(1, 0, 0); }};
  Boundary outlet{"", BoundaryKind::pressure_outlet, {}};
  Boundary slip{"", BoundaryKind::slip, {}};
  BoxScene scene = make_box(Vec3(9, 6, 4), 1.0, {inlet, outlet, slip, slip, periodic(), periodic()});
  const Air air = strained(scene, hrr(), [](const Vec3& x) { return Vec3(0.1 + 0.002 * x[0], 0, 0.05); });
  EXPECT_LT(largest_error(air, 0, [](const Vec3&) { return 2.0 / 3.0 * 0.002; }), float_rounding);
  EXPECT_LT(largest_error(air, 3, [](const Vec3&) { return 0.0; }), float_rounding);
  EXPECT_LT(largest_error(air, 5, [](const Vec3&) { return 0.0; }), float_rounding);
}

// As RR3 (test_air.cpp): error O(k^2) of second order, ratio 4 within the next order's share.
TEST(Hrr, HasTheViscosityAskedForAtSecondOrder) {
  const double coarse = std::abs(shear_wave_viscosity(16, 0.8, hrr()) / 0.1 - 1.0);
  const double fine = std::abs(shear_wave_viscosity(32, 0.8, hrr()) / 0.1 - 1.0);
  EXPECT_LT(fine, 5e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

// Vreman's model lets a shear wave alone, in which only one component of the gradient is there; Smagorinsky's does not.
// What float differences (1e-8) leave of nu_t: c |g| x (noise/|g|), below 1e-9 beside nu = 3e-3.
TEST(Vreman, LeavesAShearWaveAlone) {
  for (const Law law : {Law::rr3, Law::trt, Law::central_moments, Law::bgk, Law::hrr}) {
    AirOptions without = hrr(), with = hrr();
    without.law = with.law = law;
    with.smagorinsky = 0.17;
    const double bare = shear_wave_viscosity(16, 0.51, without);
    EXPECT_GT(shear_wave_viscosity(16, 0.51, with), 1.02 * bare);  // Smagorinsky: (0.17)^2 |S| adds some per cent
    with.eddy = Eddy::vreman;
    EXPECT_NEAR(shear_wave_viscosity(16, 0.51, with), bare, 1e-5 * bare) << static_cast<int>(law);
  }
}

TEST(Vreman, HasTheValueOfTheFormula) {
  // Strain along x and y, g = diag(a, -a, 0): B = Delta^4 a^4, nu_t = c Delta^2 sqrt(a^4/(2 a^2)) = c Delta^2 a/sqrt2.
  const double g[3][3] = {{2e-3, 0, 0}, {0, -2e-3, 0}, {0, 0, 0}};
  EXPECT_NEAR(vreman_viscosity(g, 0.025), 0.025 * 2e-3 / std::sqrt(2.0), 1e-18);
  const double nothing[3][3] = {};
  EXPECT_EQ(vreman_viscosity(nothing, 0.025), 0.0);
}

TEST(Vreman, IsPositiveInDisorderAndDoesNotChangeWhenTheAxesTurn) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1e-3);
  for (int sample = 0; sample < 100; ++sample) {
    Eigen::Matrix3d g;
    for (int k = 0; k < 9; ++k) g(k) = normal(random);
    const Eigen::Matrix3d r = Eigen::AngleAxisd(0.7 + sample, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Eigen::Matrix3d h = r * g * r.transpose();
    double a[3][3], b[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) a[i][j] = g(i, j), b[i][j] = h(i, j);
    const double nu = vreman_viscosity(a, 0.025);
    EXPECT_GT(nu, 0.0);
    EXPECT_NEAR(vreman_viscosity(b, 0.025), nu, 1e-12 * nu);  // some hundred roundings of 1e-16
  }
}

TEST(Vreman, ActsInTheAir) {
  // Strain as above, u = a (sin kx, -sin ky, 0) where both cosines are 1: les is that of nu_t there.
  const int n = 16;
  const double k = 2.0 * std::numbers::pi / n, a = 0.05;
  BoxScene scene =
      make_box(Vec3(n, n, 4), 1.0, {periodic(), periodic(), periodic(), periodic(), periodic(), periodic()});
  AirOptions options = hrr();
  options.law = Law::rr3;
  options.smagorinsky = 0.1;
  options.eddy = Eddy::vreman;
  const Air air =
      strained(scene, options, [&](const Vec3& x) { return Vec3(a * std::sin(k * x[0]), -a * std::sin(k * x[1]), 0); });
  const std::ptrdiff_t slot = air.rows.active_slot(3, 3, 1);
  const Vec3 x = air.rows.centre(slot);
  const double gx = a * std::sin(k) * std::cos(k * x[0]), gy = -a * std::sin(k) * std::cos(k * x[1]);
  const double nu_t = 0.025 * std::abs(gx * gy) / std::hypot(gx, gy);
  EXPECT_NEAR(air.les[slot], prescribed_les(nu_t, 0.51), 1e-5 * prescribed_les(nu_t, 0.51));  // float differences
}
