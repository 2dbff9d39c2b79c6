// Faces inside the fluid, found without cells.

#include <gtest/gtest.h>

#include "lbm/geometry/buried_faces.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

std::size_t buried(const TriangleMesh& mesh) { return buried_places(TriangleTree(mesh)).where.size(); }

}  // namespace

// 0.6 x 0.6 of a surface of 6 + 2 (0.36 + 2 * 0.6 L) is buried twice where the boxes share a face; where they overlap
// by 0.38, that end and 4 * 0.6 * 0.38 of the sides. Places for equal parts of the area: 1 % of their number.
TEST(BuriedFaces, OverlapsAndSharedFacesAreMetInProportionToTheirArea) {
  const TriangleMesh one = shapes::box({0, 0, 0}, {1, 1, 1});
  const auto with = [&](double from) { return shapes::joined(one, shapes::box({from, 0.2, 0.2}, {1.8, 0.8, 0.8})); };
  const auto share = [](double area, double from) { return 20000.0 * area / (6.0 + 0.72 + 2.4 * (1.8 - from)); };
  EXPECT_NEAR(static_cast<double>(buried(with(1.0))), share(0.72, 1.0), 20.0);
  // the other box's face is buried too where the first reaches through it: 0.36
  EXPECT_NEAR(static_cast<double>(buried(with(0.62))), share(0.36 + 2.4 * 0.38 + 0.36, 0.62), 30.0);
  EXPECT_EQ(buried(one), 0u);
  try {
    refuse_buried(buried_places(TriangleTree(with(1.0))));
    FAIL();
  } catch (const GeometryError& e) {
    EXPECT_NE(std::string(e.what()).find("buried face"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("export the union"), std::string::npos);
  }
}

// A plate of a thousandth of its width in the fluid, a body that stands on the floor, a step, a curved wall.
TEST(BuriedFaces, ThinWallsAndBodiesInTheFluidAreNone) {
  const TriangleMesh duct = shapes::box({0, 0, 0}, {4, 1, 1});
  EXPECT_EQ(buried(shapes::joined(duct, shapes::turned(shapes::box({2, 0.1, 0.1}, {2.001, 0.9, 0.9})))), 0u);
  EXPECT_EQ(buried(shapes::joined(duct, shapes::turned(shapes::box({2, 0.3, 0.0}, {2.4, 0.7, 0.4})))), 0u);
  EXPECT_EQ(buried(shapes::step_duct(1.0, 3.0, 0.5, 1.0, 0.5625)), 0u);
  EXPECT_EQ(buried(shapes::torus(1.0, 0.3, 48, 24)), 0u);
}

TEST(BuriedFaces, OpeningsAreNotAsked) {
  const TriangleMesh two = shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 0, 0}, {2, 1, 1}));
  EXPECT_GT(buried(two), 0u);
  EXPECT_TRUE(buried_places(TriangleTree(two), std::vector<char>(two.triangles.size(), 1)).where.empty());
}

}  // namespace puffin::lbm::geometry
