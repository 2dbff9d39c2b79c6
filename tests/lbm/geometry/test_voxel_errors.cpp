// What the staircase of cells loses: distances, orders, thin walls, buried faces.

#include "lbm/geometry/voxel_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/geometry/surface_check.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

TEST(SurfaceError, OfAFlushBoxIsNone) {
  const TriangleTree tree(shapes::box({0, 0, 0}, {1.0, 0.5, 0.75}));
  const SurfaceError error = surface_error(tree, voxelize(tree, 0.125));
  EXPECT_EQ(error.faces, 2u * (8 * 4 + 8 * 6 + 4 * 6));
  EXPECT_LT(error.largest, 1e-12);
}

TEST(SurfaceError, OfABoxThatEndsWithinACellIsThePartThatStandsOut) {
  // 8.25 cells along x: the ninth layer has its centres outside, and the last faces lie a quarter of a cell within.
  const TriangleTree tree(shapes::box({0, 0, 0}, {0.825, 0.4, 0.4}));
  const SurfaceError error = surface_error(tree, voxelize(tree, 0.1));
  EXPECT_NEAR(error.largest, 0.025, 1e-6);
  EXPECT_NEAR(error.mean, 0.025 * 16 / error.faces, 1e-6);
}

TEST(Convergence, TheStaircaseOfASphereApproachesItInFirstOrderAndItsVolumeFaster) {
  const TriangleTree tree(shapes::sphere(1.0, 60));
  const Convergence c = convergence(tree, voxelize(tree, 0.03));
  ASSERT_EQ(c.dx.size(), 5u);
  ASSERT_TRUE(c.surface_order && c.volume_order);
  // A face's distance is proportional to dx: order 1; 5 grids over two octaves scatter the slope by a few hundredths.
  EXPECT_NEAR(*c.surface_order, 1.0, 0.1);
  // Counted lattice points: error ~ dx^1.5 to dx^2 with random sign; the fit may lose a half.
  EXPECT_GT(*c.volume_order, 1.0);
}

TEST(Convergence, OfCellsThatFitHasNoOrder) {
  const TriangleTree tree(shapes::box({0, 0, 0}, {1, 1, 1}));
  const std::vector<double> dx{0.1, 0.2, 0.4};
  EXPECT_FALSE(order_of(dx, {1e-9, 1e-9, 0.1}, {1e-6, 1e-6, 1e-6}));
  EXPECT_NEAR(*order_of(dx, {0.03, 0.12, 0.48}, {1e-6, 1e-6, 1e-6}), 2.0, 1e-12);
}

TEST(HiddenFaces, TheTipOfAWedgeIsAThinWallHoweverThinItIsThere) {
  // A wedge hangs from the ceiling of a box, 0.2 wide there; its tip lies a ten-thousandth of a cell below the second
  // layer of centres, where the way between two cells is 8e-6 long in the solid.
  TriangleMesh mesh;
  mesh.solids = {"wall"};
  const std::vector<std::array<double, 2>> outline{{0, 0}, {4, 0}, {4, 4}, {2.1, 4}, {2, 1.4999}, {1.9, 4}, {0, 4}};
  const int n = static_cast<int>(outline.size());
  for (const double y : {0.0, 4.0})
    for (const auto& p : outline) mesh.vertices.emplace_back(p[0], y, p[1]);
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    mesh.triangles.push_back({k, next + n, next});
    mesh.triangles.push_back({k, k + n, next + n});
  }
  for (const auto& t : std::vector<std::array<int, 3>>{{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}}) {
    mesh.triangles.push_back(t);
    mesh.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  }
  mesh.solid.assign(mesh.triangles.size(), 0);
  const TriangleTree tree(mesh);
  const HiddenFaces faces = hidden_faces(tree, voxelize(tree, 1.0));
  EXPECT_EQ(faces.buried, 0u);
  EXPECT_EQ(faces.thin, 12u);  // the upper three layers, four cells deep
}

TEST(HiddenFaces, AWallThinnerThanACellIsFoundAndAThickOneIsNot) {
  // A duct with a plate across its middle, open to no side: 0.04 and 0.2 thick in cells of 0.1.
  for (const double thick : {0.04, 0.2}) {
    const TriangleMesh mesh = shapes::joined(shapes::box({0, 0, 0}, {1.0, 0.4, 0.4}),
                                             shapes::turned(shapes::box({0.5 - thick, 0.11, 0.11}, {0.5, 0.29, 0.29})));
    const TriangleTree tree(mesh);
    const HiddenFaces faces = hidden_faces(tree, voxelize(tree, 0.1));
    EXPECT_EQ(faces.buried, 0u);
    // Rows at y, z = 0.15, 0.25 meet the plate; the thin one lies between the centres 0.45 and 0.55.
    EXPECT_EQ(faces.thin, thick < 0.1 ? 4u : 0u);
    for (const Vec3& w : faces.thin_where) EXPECT_NEAR(w.x(), 0.46, 1e-9);
  }
}

TEST(HiddenFaces, FacesInsideBodiesThatOverlapOrTouchAreBuriedAndRefusedWithTheirPlace) {
  const TriangleMesh one = shapes::box({0, 0, 0}, {1, 1, 1});
  for (const double from : {0.62, 1.0}) {
    const TriangleTree tree(shapes::joined(one, shapes::box({from, 0.18, 0.18}, {1.8, 0.78, 0.78})));
    const HiddenFaces faces = hidden_faces(tree, voxelize(tree, 0.1));
    EXPECT_GT(faces.buried, 0u) << from;
    try {
      refuse_buried(faces);
      FAIL();
    } catch (const GeometryError& e) {
      EXPECT_NE(std::string(e.what()).find("export the union"), std::string::npos);
    }
  }
  const TriangleTree tree(one);
  EXPECT_NO_THROW(refuse_buried(hidden_faces(tree, voxelize(tree, 0.1))));
}

TEST(HiddenFaces, CentresInThePlaneOfAWallSeeNoneBetweenThem) {
  // A step in the floor at x = 1, 3.5 cells high: a layer of centres lies in the plane of its top, on the side
  // of the fluid, and its rows run through the edge.
  Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
  flip(2, 2) = -1.0;
  const TriangleTree tree(shapes::transformed(shapes::step_duct(1.0, 3.0, 0.5, 1.0, 0.5625), flip, {0, 0, 1}));
  const HiddenFaces faces = hidden_faces(tree, voxelize(tree, 0.125));
  EXPECT_EQ(faces.thin, 0u);
  EXPECT_EQ(faces.buried, 0u);
}

TEST(HiddenFaces, OpeningsAreNoWalls) {
  // A partition whose faces are openings (two ducts end to end, say) is not counted.
  const TriangleMesh mesh =
      shapes::joined(shapes::box({0, 0, 0}, {0.5, 0.4, 0.4}), shapes::box({0.52, 0, 0}, {1.0, 0.4, 0.4}));
  const TriangleTree tree(mesh);
  const Voxels voxels = voxelize(tree, 0.1);
  EXPECT_EQ(hidden_faces(tree, voxels).thin, 16u);
  EXPECT_EQ(hidden_faces(tree, voxels, std::vector<char>(mesh.triangles.size(), 1)).thin, 0u);
}

}  // namespace
}  // namespace puffin::lbm::geometry
