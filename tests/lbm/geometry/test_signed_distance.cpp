// Signed distances: against formulas, brute force, and where normals mislead.

#include "lbm/geometry/signed_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lbm/geometry/triangle_distance.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

SignedDistance distance_to(const TriangleMesh& mesh) {
  return SignedDistance(std::make_shared<const TriangleTree>(mesh));
}

TEST(SignedDistance, OfABoxIsTheFormulaInsideAndOutsideOverFacesEdgesAndCorners) {
  const Vec3 low(-1, -2, -0.5), high(1.5, 1, 0.75);
  const Eigen::Matrix3d turn = shapes::rotation();
  const SignedDistance distance = distance_to(shapes::transformed(shapes::box(low, high, 2), turn));
  EXPECT_TRUE(distance.simple());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-3.0, 3.0);
  double worst = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const Vec3 p(unit(random), unit(random), unit(random));
    const Vec3 out = (low - p).cwiseMax(p - high);  // positive beyond a face
    const double expected = out.maxCoeff() > 0.0 ? -out.cwiseMax(0.0).norm() : -out.maxCoeff();
    worst = std::max(worst, std::abs(distance(turn * p) - expected));
  }
  EXPECT_LT(worst, 1e-12);  // rounding of coordinates of size 3
}

TEST(SignedDistance, HasTheSignOfTheWindingNumberAndTheSizeOfBruteForceOnACurvedSurface) {
  const TriangleMesh mesh = shapes::torus(1.0, 0.4, 40, 20);
  const auto tree = std::make_shared<const TriangleTree>(mesh);
  const SignedDistance distance(tree);
  EXPECT_TRUE(distance.simple());
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.6, 1.6);
  for (int n = 0; n < 400; ++n) {
    const Vec3 p(unit(random), unit(random), 0.5 * unit(random));
    double nearest = 1e300;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      const Vec3 q = nearest_on_triangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)).point;
      nearest = std::min(nearest, (p - q).norm());
    }
    EXPECT_NEAR(distance(p), tree->inside(p) ? nearest : -nearest, 1e-12);
  }
}

TEST(SignedDistance, OfBodiesThatOverlapIsThatOfTheirUnionAndNotOfTheNearestNormal) {
  const SignedDistance distance =
      distance_to(shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({0.5, 0.2, 0.2}, {1.5, 0.8, 0.8})));
  EXPECT_FALSE(distance.simple());
  EXPECT_GT(distance({0.45, 0.5, 0.5}), 0.0);  // before the second box's face, inside the first
  EXPECT_GT(distance({0.95, 0.5, 0.5}), 0.0);
  EXPECT_GT(distance({1.05, 0.5, 0.5}), 0.0);
  EXPECT_LT(distance({1.05, 0.9, 0.5}), 0.0);
}

TEST(SignedDistance, KnowsBodiesInTheFlowAndForgivesAHoleAndATurnedFacet) {
  const TriangleMesh outer = shapes::box({0, 0, 0}, {1, 1, 1}, 4);
  const SignedDistance with_body =
      distance_to(shapes::joined(outer, shapes::turned(shapes::sphere(0.2, 8, {0.5, 0.5, 0.5}))));
  EXPECT_TRUE(with_body.simple());
  EXPECT_LT(with_body({0.5, 0.5, 0.5}), 0.0);
  EXPECT_NEAR(with_body({0.25, 0.5, 0.5}), 0.05, 0.005);  // facets lie at most r (1 - cos(pi / 16)) = 0.004 within
  TriangleMesh damaged = outer;
  shapes::remove_triangle(damaged, 5);
  std::swap(damaged.triangles[20][0], damaged.triangles[20][1]);
  const SignedDistance forgiving = distance_to(damaged);
  EXPECT_FALSE(forgiving.simple());
  const Vec3 beside = (damaged.corner(20, 0) + damaged.corner(20, 1) + damaged.corner(20, 2)) / 3.0;
  const Vec3 inwards = (Vec3::Constant(0.5) - beside).normalized();
  EXPECT_GT(forgiving(beside + 0.1 * inwards), 0.0);
  EXPECT_LT(forgiving(beside - 0.1 * inwards), 0.0);
}

TEST(SignedDistance, BeyondItsLimitIsTheLimitWithTheSignOfTheSide) {
  const SignedDistance distance = distance_to(shapes::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(distance({0.5, 0.5, 0.5}, 0.2), 0.2);
  EXPECT_EQ(distance({2.0, 0.5, 0.5}, 0.2), -0.2);
}

TEST(SignedDistance, OfManyPointsAtOnceIsThatOfEachToTheLastBit) {
  const SignedDistance distance = distance_to(shapes::torus(1.0, 0.4, 40, 20));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-2.0, 2.0);
  std::vector<Vec3> points;
  points.reserve(6000);
  for (int n = 0; n < 6000; ++n) points.emplace_back(unit(random), unit(random), unit(random));
  for (const double limit : {std::numeric_limits<double>::infinity(), 0.3}) {
    const std::vector<double> all = distance.at(points, limit);
    for (std::size_t n = 0; n < points.size(); ++n) ASSERT_EQ(all[n], distance(points[n], limit)) << n;
  }
  EXPECT_TRUE(distance.at({}).empty());
}

TEST(SignedDistance, WithoutATreeIsRefused) { EXPECT_THROW(SignedDistance(nullptr), std::invalid_argument); }

}  // namespace
}  // namespace puffin::lbm::geometry
