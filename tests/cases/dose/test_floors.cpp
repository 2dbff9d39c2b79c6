// On what a dose stands: floors of any direction, under a gravity of any direction.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "cases/build.hpp"
#include "cases/fill.hpp"
#include "tests/cases/sample_case.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::cases {
namespace {

namespace shapes = lbm::geometry::shapes;

constexpr double degree = std::numbers::pi / 180.0;
const Vec3 upright_box(1.0, 1.0, 2.0);  // [mm]
const Vec3 downwards(0.0, 0.0, -9.81);  // [m/s^2]

/// A box in which nothing but carriers of 100 um is.
Case dose_in_box(const Vec3& size, const Vec3& gravity, const std::string& fill) {
  char text[800];
  std::snprintf(text, sizeof text,
                "schema = 1\nname = \"floor\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\nx = \"%g mm\"\n"
                "y = \"%g mm\"\nz = \"%g mm\"\n[air]\nmodel = \"none\"\n[carriers]\ncount = 27\ndensity = 1520\n"
                "diameter = \"100 um\"\ngravity = [%.17e, %.17e, %.17e]\nfill = { %s }\n[stop]\ntime = \"1 ms\"\n",
                size[0], size[1], size[2], gravity[0], gravity[1], gravity[2], fill.c_str());
  return test::parse(text);
}

Dose placed(const Case& c, const Surface& surface) {
  return dose_of(c, surface, lbm::geometry::TriangleTree(surface.mesh));
}
Dose placed(const Case& c) { return placed(c, load_surface(c)); }

/// 27 carriers on z-min, under gravity turned from -z towards x.
Dose under_slanting_gravity(double angle) {
  return placed(dose_in_box(upright_box, 9.81 * Vec3(std::sin(angle), 0.0, -std::cos(angle)),
                            "shape = \"cylinder\", at = \"z-min\""));
}

/// The same under gravity along -z, with the box turned about y.
Dose on_a_slope(double angle, const Vec3& gravity) {
  const Case c = dose_in_box(upright_box, gravity, "shape = \"cylinder\", at = \"z-min\"");
  Surface surface = load_surface(c);
  surface.mesh =
      shapes::transformed(surface.mesh, Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix(), Vec3::Zero());
  return placed(c, surface);
}

}  // namespace

TEST(Floors, TheAxesOfALevelFloorAreThoseOfSpaceToTheLastBit) {
  EXPECT_EQ(axes_on_floor(Vec3::UnitZ()), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(axes_on_floor(-Vec3(downwards.normalized())), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  for (const Vec3& up : {Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0.3, -0.5, 0.8), Vec3(0.95, 0.1, -0.2)}) {
    const Eigen::Matrix3d axes = axes_on_floor(up);
    EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-14);  // a dozen roundings of 1e-16
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
    EXPECT_LT((axes.col(2) - up.normalized()).norm(), 1e-14);
  }
}

// Under gravity along -y a stack on y = 0 is that on z = 0 under gravity along -z, turned about x: height goes along y,
// what went along y goes along -z. Both stand in the middle of 1 mm x 1 mm. A dozen roundings of 1 mm: 1e-18 m each.
TEST(Floors, UnderGravityAlongYAStackStandsOnYMinAsOneOnZMinDoes) {
  const Vec3 lying_box(1.0, 2.0, 1.0), along_y(0.0, -9.81, 0.0);
  for (const auto& [upright, lying] :
       {std::pair{"shape = \"cylinder\", at = \"z-min\"", "shape = \"cylinder\", at = \"y-min\""},
        {"shape = \"cube\", at = \"z-min\"", "shape = \"cube\", at = \"y-min\""},
        {"shape = \"cylinder\", at = [5e-4, 5e-4, 0.0]", "shape = \"cylinder\", at = [5e-4, 0.0, 5e-4]"}}) {
    const Dose expected = placed(dose_in_box(upright_box, downwards, upright));
    const Dose dose = placed(dose_in_box(lying_box, along_y, lying));
    ASSERT_EQ(dose.positions.size(), 27U) << lying;
    for (std::size_t n = 0; n < dose.positions.size(); ++n) {
      const Vec3& p = expected.positions[n];
      EXPECT_LT((dose.positions[n] - Vec3(p.x(), p.z(), 1e-3 - p.y())).norm(), 1e-15) << lying << ' ' << n;
    }
    EXPECT_NEAR(dose.height, expected.height, 1e-15) << lying;
  }
}

// A single layer (45 have room in it) settles: every carrier touches y = 0, into which it may give by 2 % of its
// diameter (settle.cpp); one that moves by less than 2 mm/s, which counts as still, comes 0.2 um high.
TEST(Floors, UnderGravityAlongYABedSettlesOnYMin) {
  const auto s =
      build(dose_in_box({1.0, 2.0, 1.0}, {0.0, -9.81, 0.0}, "shape = \"settled\", at = \"y-min\", gap = 0.2"));
  ASSERT_EQ(s->state.carriers.carriers.size(), 27U);
  for (const Vec3& p : s->state.carriers.carriers.position) EXPECT_NEAR(p.y(), 50e-6, 0.02 * 100e-6);
}

// Up to 45 degrees from gravity the stack is the one on a level floor, to the last bit: it stands along the normal.
TEST(Floors, AFloorUpTo45DegreesFromGravityBearsTheStackOfALevelOne) {
  const Dose level = under_slanting_gravity(0.0);
  ASSERT_EQ(level.positions.size(), 27U);
  for (const double angle : {6.0, 9.0, 30.0, 45.0})
    EXPECT_EQ(under_slanting_gravity(angle * degree).positions, level.positions) << angle;
  EXPECT_EQ(placed(dose_in_box(upright_box, Vec3::Zero(), "shape = \"cylinder\", at = \"z-min\"")).positions,
            level.positions);
}

// The whole scene turned, but for gravity: the stack turns with the floor. Roundings of millimetres, 1e-18 m each.
TEST(Floors, AStackTurnsWithItsFloor) {
  const Dose level = on_a_slope(0.0, downwards);
  for (const double angle : {2.0, 7.0, 30.0, 44.0, -44.0}) {
    const Dose dose = on_a_slope(angle * degree, downwards);
    ASSERT_EQ(dose.positions.size(), level.positions.size()) << angle;
    const Eigen::AngleAxisd turn(angle * degree, Vec3::UnitY());
    for (std::size_t n = 0; n < dose.positions.size(); ++n)
      EXPECT_LT((dose.positions[n] - turn * level.positions[n]).norm(), 1e-15) << angle << ' ' << n;
  }
}

/// A shallow cup whose floor is a cone of 1.4 degrees within 2 mm of the axis and a flat ring beyond, in a box.
Surface shallow_cup(double above) {
  constexpr int n = 48;
  Surface s;
  const auto ring = [&](double r, double z) {
    for (int k = 0; k < n; ++k) {
      const double a = 2.0 * std::numbers::pi * k / n;
      s.mesh.vertices.emplace_back(1e-3 * r * std::cos(a), 1e-3 * r * std::sin(a), 1e-3 * (z + above));
    }
  };
  ring(2.0, 0.05), ring(4.0, 0.1), ring(4.0, 4.0);
  s.mesh.vertices.emplace_back(0.0, 0.0, 1e-3 * above);
  s.mesh.vertices.emplace_back(0.0, 0.0, 1e-3 * (4.0 + above));
  s.mesh.solids = {"z-min", "wall"};
  const auto add = [&](int solid, int a, int b, int c) {
    s.mesh.triangles.push_back({a, b, c});
    s.mesh.solid.push_back(solid);
  };
  for (int k = 0; k < n; ++k) {
    const int m = (k + 1) % n;
    add(0, 3 * n, m, k);
    for (const int r : {0, 1}) {
      add(r, r * n + k, r * n + m, (r + 1) * n + m);
      add(r, r * n + k, (r + 1) * n + m, (r + 1) * n + k);
    }
    add(1, 3 * n + 1, 2 * n + k, 2 * n + m);
  }
  s.patches = lbm::geometry::assign_patches(s.mesh, {});
  return s;
}

// The depths of the floor's faces, 33 to 83 um below and above each other, were compared within a thousandth of their
// z: at 100 mm all were one floor of 8 mm. Roundings of 2 m: 4e-16 m each, a dozen of them.
TEST(Floors, WhereTheOriginLiesChangesNothing) {
  const Case c = dose_in_box(upright_box, downwards, "shape = \"cylinder\", at = \"z-min\"");
  const Dose here = placed(c, shallow_cup(0.0));
  ASSERT_EQ(here.positions.size(), 27U);
  for (const double above : {100.0, -2000.0}) {
    const Dose there = placed(c, shallow_cup(above));
    ASSERT_EQ(there.positions.size(), here.positions.size());
    EXPECT_EQ(there.description, here.description);
    for (std::size_t n = 0; n < here.positions.size(); ++n)
      EXPECT_LT((there.positions[n] - here.positions[n] - Vec3(0, 0, 1e-3 * above)).norm(), 1e-14) << above << ' ' << n;
  }
}

TEST(Floors, ASteeperFloorIsNone) {
  for (const auto& too_steep :
       {+[] { under_slanting_gravity(46.0 * degree); }, +[] { on_a_slope(46.0 * degree, downwards); },
        +[] { on_a_slope(30.0 * degree, Vec3::Zero()); }}) {
    try {
      too_steep();
      ADD_FAILURE() << "nothing was said";
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find("has no face that carriers can lie on"), std::string::npos) << e.what();
    }
  }
}

}  // namespace puffin::cases
