// Inlet profiles on patches in any position: exact shapes, exact section means.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "cases/generators/generators.hpp"
#include "cases/inlet_profile.hpp"

namespace puffin::cases {
namespace {

/// A shape of the generators, turned and moved; its patches are its solids.
Surface turned(const std::string& kind, const Parameters& parameters, const Eigen::Affine3d& motion) {
  Surface s;
  s.mesh = generate(kind, parameters);
  for (Vec3& v : s.mesh.vertices) v = motion * v;
  s.patches = lbm::geometry::assign_patches(s.mesh, {});
  return s;
}

Eigen::Affine3d tilt() {
  return Eigen::Translation3d(0.3, -0.1, 0.2) * Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized());
}

struct Inlet {
  Case c;
  Surface surface;
  Boundary boundary;
  Opening opening;
  InletProfile profile;
  Inlet(Surface s, Profile kind, Case given = {}) : c(std::move(given)), surface(std::move(s)) {
    boundary.patch = "inlet";
    boundary.type = BoundaryType::velocity_inlet;
    boundary.profile = kind;
    boundary.flow = MeanSpeed{1.0};
    find();
  }
  void find() {
    const int patch = surface.patches.find("inlet");
    opening = opening_of(c, surface, patch);
    profile = profile_of(boundary, surface, opening);
  }
  /// Speed into the domain over the mean at a place in the frame of the untilted shape.
  double at(const Vec3& x) const { return -profile.shape(tilt() * x).dot(opening.normal); }
  double mean() const {
    return integral_over(surface, opening, 0.1 * opening.half[1],
                         [&](const Vec3& x) { return -profile.shape(x).dot(opening.normal); }) /
           opening.area;
  }
};

const Parameters flat{{"length", 0.01}, {"width", 0.004}, {"height", 0.001}, {"facet_size", 0.0007}};

TEST(Opening, TheRectangleOfATiltedPatchIsFoundFromItsTriangles) {
  const Inlet inlet(turned("duct", flat, tilt()), Profile::plug);
  EXPECT_NEAR(inlet.opening.half[0], 0.002, 1e-9);
  EXPECT_NEAR(inlet.opening.half[1], 0.0005, 1e-9);
  EXPECT_NEAR(inlet.opening.area, 4e-6, 1e-12);
  EXPECT_LT((inlet.opening.centre - tilt() * Vec3(0, 0.002, 0.0005)).norm(), 1e-9);
  for (int d = 0; d < 2; ++d)
    for (int e = 0; e < 2; ++e) EXPECT_TRUE(inlet.opening.wall[d][e]);
}

// facts of laminar flow: plane channel 3/2, pipe 2, square duct 2.096256 (exact series) of the mean in the middle. The
// quadrature is of degree 5 and the shapes smooth: 1e-6; the pipe's polygon of 96 sides fills its circle but for 7e-4.
TEST(InletProfile, TheGreatestSpeedOverTheMeanIsThatOfTheExactSolution) {
  const Inlet plane(turned("duct", flat, tilt()), Profile::parabolic);
  EXPECT_NEAR(plane.at(Vec3(0, 0.002, 0.0005)), 1.5, 1e-6);
  EXPECT_NEAR(plane.at(Vec3(0, 0.0001, 0.0005)), 1.5, 1e-6) << "uniform along the longer side";
  EXPECT_NEAR(plane.at(Vec3(0, 0.003, 0.00025)), 1.5 * 0.75, 1e-6);
  Parameters square = flat;
  square["width"] = 0.001;
  const Inlet duct(turned("duct", square, tilt()), Profile::duct);
  EXPECT_NEAR(duct.at(Vec3(0, 0.0005, 0.0005)), 2.096256, 1e-5);
  EXPECT_NEAR(duct.at(Vec3(0, 0.0, 0.0003)), 0.0, 1e-12);
  const Inlet pipe(turned("pipe", {{"diameter", 0.002}, {"length", 0.01}}, tilt()), Profile::pipe);
  EXPECT_NEAR(pipe.at(Vec3(0, 0, 0)), 2.0, 3e-3);
  for (const Inlet* i : {&plane, &duct, &pipe}) EXPECT_NEAR(i->mean(), 1.0, 1e-6);
}

// The momentum equation itself: the Laplacian of the duct's shape is the same everywhere.
TEST(InletProfile, TheDuctSeriesSolvesThePoissonEquation) {
  const double h = 1e-3, a = 0.5, b = 1.25;
  const auto laplacian = [&](double y, double z) {
    return (duct_series(y + h, z, a, b) + duct_series(y - h, z, a, b) + duct_series(y, z + h, a, b) +
            duct_series(y, z - h, a, b) - 4.0 * duct_series(y, z, a, b)) /
           (h * h);
  };
  // Between plates 1 - (y/a)^2 has -2/a^2 = -8; differences of second order, h^2/12 times fourth derivatives of ~100.
  for (const auto& [y, z] : {std::pair(0.0, 0.0), std::pair(0.3, 1.0), std::pair(-0.2, -0.4)})
    EXPECT_NEAR(laplacian(y, z), -8.0, 1e-3);
}

TEST(InletProfile, BesidePeriodicAndSlipSidesTheAirDoesNotStick) {
  Case c;
  for (const char* side : {"y-min", "z-max"}) {
    Boundary b;
    b.patch = side;
    b.type = side[0] == 'y' ? BoundaryType::periodic : BoundaryType::slip;
    if (side[0] == 'y') b.with = "y-max";
    c.air.boundaries.push_back(b);
  }
  // A scene one cell wide in y: the parabola must span z although y is the shorter side; z-max slips: half a channel.
  Surface s = turned("duct", {{"length", 0.01}, {"width", 1e-4}, {"height", 1e-3}}, Eigen::Affine3d::Identity());
  s.patches = lbm::geometry::assign_patches(
      s.mesh, {{"y-min", "plane:y-min"}, {"y-max", "plane:y-max"}, {"z-max", "plane:z-max"}});
  for (const Profile kind : {Profile::parabolic, Profile::duct}) {
    const Inlet inlet(s, kind, c);
    const auto speed = [&](double z) { return -inlet.profile.shape(Vec3(0, 2e-5, z)).dot(inlet.opening.normal); };
    EXPECT_NEAR(speed(1e-3), 1.5, 1e-6);
    EXPECT_NEAR(speed(0.5e-3), 1.5 * 0.75, 1e-6);
    EXPECT_NEAR(speed(0.0), 0.0, 1e-12);
  }
}

TEST(InletProfile, AVectorTurnsTheShapeAndKeepsItsNormalMean) {
  Inlet inlet(turned("duct", flat, Eigen::Affine3d::Identity()), Profile::parabolic);
  inlet.boundary.flow = Velocity{Vec3(3.0, 4.0, 0.0)};
  inlet.find();
  const Vec3 middle = inlet.profile.shape(Vec3(0, 0.002, 0.0005));
  EXPECT_LT((middle - 1.5 * Vec3(1.0, 4.0 / 3.0, 0.0)).norm(), 1e-6);
}

TEST(InletProfile, AFileIsTakenAsItIsAndItsMeanIsThatOverThePatch) {
  const auto file = std::filesystem::temp_directory_path() / "puffin-profile-test.csv";
  std::ofstream(file) << "x,y,z,u,v,w\n0,0,0,1,0,0.5\n0,0.004,0,3,0,0.5\n0,0,0.001,1,0,0.5\n0,0.004,0.001,3,0,0.5\n";
  Inlet inlet(turned("duct", flat, Eigen::Affine3d::Identity()), Profile::plug);
  inlet.boundary.profile = Profile::file;
  inlet.boundary.profile_file = file.string();
  inlet.boundary.flow = {};
  inlet.find();
  EXPECT_NEAR(inlet.profile.mean, 2.0, 1e-12);
  EXPECT_LT((2.0 * inlet.profile.shape(Vec3(0, 0.001, 0.0005)) - Vec3(1.5, 0, 0.5)).norm(), 1e-12);
  inlet.c.air.boundaries = {inlet.boundary};
  complete_file_profiles(inlet.surface, inlet.c);
  EXPECT_NEAR(std::get<MeanSpeed>(inlet.c.air.boundaries[0].flow).value, 2.0, 1e-12);
  std::ofstream(file) << "x,y,z,u,v,w\n0,0,0,-1,0,0\n";
  EXPECT_THROW(inlet.find(), std::invalid_argument);
  std::filesystem::remove(file);
}

TEST(InletProfile, AShapeThatDoesNotFitThePatchIsRefused) {
  EXPECT_THROW(Inlet(turned("pipe", {{"diameter", 0.002}}, tilt()), Profile::duct), lbm::geometry::GeometryError);
  EXPECT_THROW(Inlet(turned("duct", flat, tilt()), Profile::pipe), lbm::geometry::GeometryError);
}

}  // namespace
}  // namespace puffin::cases
