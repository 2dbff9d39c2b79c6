// Contact places of a sphere with the surface: each once, none missed.

#include <gtest/gtest.h>

#include <random>

#include "lbm/geometry/triangle_tree.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

std::vector<Feature> features(const TriangleTree& tree, const Vec3& centre, double reach, Side side = Side::both,
                              const std::vector<char>* skip = nullptr) {
  std::vector<Feature> out;
  tree.near_features(centre, reach, skip, out, side);
  return out;
}

// Boxes of 1 with 1, 3 and 8 squares a side: the answer must not depend on how a face is cut into triangles.
class BoxFeatures : public ::testing::TestWithParam<int> {
 protected:
  TriangleTree tree_{shapes::box({0, 0, 0}, {1, 1, 1}, GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Cuts, BoxFeatures, ::testing::Values(1, 3, 8));

TEST_P(BoxFeatures, ASphereInsideTouchesOneFaceTwoAtAnEdgeThreeInACorner) {
  const double r = 0.1, gap = 0.09;
  std::mt19937 engine(GetParam());
  std::uniform_real_distribution<> free(0.2, 0.8);
  for (int n = 0; n < 300; ++n) {
    for (int touching = 0; touching <= 3; ++touching) {
      Vec3 centre;
      for (int d = 0; d < 3; ++d) centre[(d + n) % 3] = d < touching ? (n & (1 << d) ? gap : 1 - gap) : free(engine);
      const auto found = features(tree_, centre, r);
      ASSERT_EQ(static_cast<int>(found.size()), touching) << centre.transpose();
      for (const Feature& f : found) EXPECT_NEAR(f.distance, gap, 1e-15);
      EXPECT_EQ(features(tree_, centre, r, Side::inner).size(), found.size());
    }
  }
}

TEST_P(BoxFeatures, AFootExactlyOnAnEdgeOrVertexOfTheTriangulationCountsOnce) {
  // Multiples of 1/48 hit the diagonals, edges and vertices of all three cuts.
  for (int i = 6; i <= 42; ++i) {
    for (int j = 6; j <= 42; ++j) {
      ASSERT_EQ(features(tree_, {i / 48.0, j / 48.0, 0.05}, 0.1).size(), 1u) << i << ' ' << j;
      ASSERT_EQ(features(tree_, {0.95, i / 48.0, j / 48.0}, 0.1).size(), 1u) << i << ' ' << j;
    }
  }
}

TEST_P(BoxFeatures, ASphereOutsideTouchesAFaceAnEdgeOrAVertexOnceAndIsNotFeltByTheInnerSide) {
  for (const Vec3& centre : {Vec3(0.4, 0.3, 1.05), Vec3(0.3, 1.05, 1.05), Vec3(1.05, 1.05, 1.05),
                             Vec3(-0.02, -0.05, -0.03), Vec3(1.05, 0.5, -0.01)}) {
    const auto found = features(tree_, centre, 0.1);
    ASSERT_EQ(found.size(), 1u) << centre.transpose();
    const Vec3 foot = centre.cwiseMax(0.0).cwiseMin(1.0);
    EXPECT_LT((found[0].point - foot).norm(), 1e-15);
    EXPECT_TRUE(features(tree_, centre, 0.1, Side::inner).empty());
  }
}

TEST_P(BoxFeatures, SkippedTrianglesDoNotExistButTheirRimDoes) {
  std::vector<char> skip(tree_.mesh().triangles.size(), 0);
  for (std::size_t t = 0; t < skip.size(); ++t) skip[t] = tree_.mesh().solid[t] == 5;  // z-max is open
  EXPECT_TRUE(features(tree_, {0.5, 0.5, 0.95}, 0.1, Side::inner, &skip).empty());
  EXPECT_EQ(features(tree_, {0.05, 0.5, 0.95}, 0.1, Side::inner, &skip).size(), 1u);
  EXPECT_EQ(features(tree_, {0.05, 0.05, 0.95}, 0.1, Side::inner, &skip).size(), 2u);
  // The centre has left by the opening: the rim is an edge of the wall.
  const auto rim = features(tree_, {0.05, 0.5, 1.02}, 0.1, Side::inner, &skip);
  ASSERT_EQ(rim.size(), 1u);
  EXPECT_NEAR(rim[0].distance, std::hypot(0.05, 0.02), 1e-15);
}

TEST(NearFeatures, OverAConvexLipThereIsExactlyOneEdgeContact) {
  const TriangleTree tree(shapes::step_duct(0.01, 0.02, 0.005, 0.004, 0.002));
  // Around the lip at x = 0.01, z = 0.002 the air fills three quarters: x < 0.01 or z < 0.002.
  const Vec3 lip(0.01, 0.0025, 0.002);
  for (const double angle : {3.2, 3.5, 4.0, 4.6}) {  // between -x and -z
    const Vec3 centre = lip + 3e-4 * Vec3(std::cos(angle), 0, std::sin(angle));
    const auto found = features(tree, centre, 4e-4, Side::inner);
    ASSERT_EQ(found.size(), 1u) << angle;
    EXPECT_LT((found[0].point - lip).norm(), 1e-12);
  }
  // Before the step's face and under the lower ceiling: one face contact.
  EXPECT_EQ(features(tree, {0.0097, 0.0025, 0.003}, 4e-4, Side::inner).size(), 1u);
  EXPECT_EQ(features(tree, {0.015, 0.0025, 0.0017}, 4e-4, Side::inner).size(), 1u);
  // In the concave corner of step and ceiling: two.
  EXPECT_EQ(features(tree, {0.0097, 0.0025, 0.0037}, 4e-4, Side::inner).size(), 2u);
}

TEST(NearFeatures, AThinWallIsNotFeltThrough) {
  // Two channels a fiftieth apart.
  const TriangleTree tree(shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1.02, 0, 0}, {2, 1, 1})));
  EXPECT_EQ(features(tree, {0.95, 0.5, 0.5}, 0.1).size(), 2u);
  const auto found = features(tree, {0.95, 0.5, 0.5}, 0.1, Side::inner);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].point.x(), 1.0, 1e-15);
}

TEST(NearFeatures, ASphereOutsideAFineSphereTouchesItOnceWhereverItIs) {
  const TriangleTree tree(shapes::transformed(shapes::sphere(1.0, 64), shapes::rotation(), {3, 2, 1}));
  std::mt19937 engine(7);
  std::normal_distribution<> normal;
  for (int n = 0; n < 2000; ++n) {
    // A convex body has exactly one nearest point.
    const Vec3 direction = Vec3(normal(engine), normal(engine), normal(engine)).normalized();
    const auto found = features(tree, Vec3(3, 2, 1) + 1.05 * direction, 0.1);
    ASSERT_EQ(found.size(), 1u);
    // Facets lie up to 1 - cos(pi/64 * 1.5) = 2.7e-3 inside the sphere, so the distance is 0.05 to 0.0527.
    EXPECT_GE(found[0].distance, 0.05 - 1e-12);
    EXPECT_LE(found[0].distance, 0.0527);
  }
}

}  // namespace
}  // namespace puffin::lbm::geometry
