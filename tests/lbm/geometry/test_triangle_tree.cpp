// Queries of the triangle tree against brute force and against geometry.

#include <gtest/gtest.h>

#include <random>

#include "lbm/geometry/triangle_distance.hpp"
#include "lbm/geometry/triangle_tree.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

class Points {
 public:
  explicit Points(unsigned seed) : engine_(seed) {}
  Vec3 operator()(const Vec3& low, const Vec3& high) {
    Vec3 p;
    for (int d = 0; d < 3; ++d) p[d] = std::uniform_real_distribution<>(low[d], high[d])(engine_);
    return p;
  }

 private:
  std::mt19937 engine_;
};

double brute_distance(const TriangleMesh& m, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const int t = static_cast<int>(i);
    best = std::min(best, (nearest_on_triangle(p, m.corner(t, 0), m.corner(t, 1), m.corner(t, 2)).point - p).norm());
  }
  return best;
}

TEST(TriangleTree, NearestPointEqualsBruteForceNearAndFar) {
  const TriangleMesh mesh = shapes::transformed(shapes::torus(0.02, 0.006, 60, 30), shapes::rotation(), {5, -3, 1});
  const TriangleTree tree(mesh);
  Points random(1);
  for (int n = 0; n < 1000; ++n) {
    const double far = n % 3 == 0 ? 1.0 : (n % 3 == 1 ? 3.0 : 1000.0);
    const Vec3 half = far * 0.5 * (tree.max() - tree.min()), middle = 0.5 * (tree.max() + tree.min());
    const Vec3 p = random(middle - half, middle + half);
    const double expected = brute_distance(mesh, p);
    const Closest found = tree.closest(p);
    // Both use the same arithmetic a triangle: equal but for ties.
    EXPECT_DOUBLE_EQ(found.distance, expected);
    EXPECT_NEAR((found.point - p).norm(), expected, 1e-15 * (1 + expected));
    EXPECT_EQ(tree.closest(p, 0.999 * expected).triangle, -1);
    EXPECT_EQ(tree.closest(p, 1.001 * expected).triangle, found.triangle);
  }
}

TEST(TriangleTree, AnswersScaleWithTheUnit) {
  const TriangleMesh mesh = shapes::torus(0.02, 0.006, 40, 20);
  const TriangleTree metres(mesh);
  const double small = std::ldexp(1.0, -20);  // exact, so every digit must agree
  const TriangleTree micro(shapes::transformed(mesh, small * Eigen::Matrix3d::Identity()));
  Points random(2);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = random(metres.min(), metres.max()), d = random({-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(micro.closest(small * p).distance, small * metres.closest(p).distance);
    EXPECT_NEAR(micro.winding_number(small * p), metres.winding_number(p), 1e-12);
    const auto a = metres.first_hit(p, d, 1.0), b = micro.first_hit(small * p, small * d, 1.0);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_EQ(a->triangle, b->triangle);
    }
  }
}

TEST(TriangleTree, WindingNumberIsOneInsideZeroOutsideAndTurnsSignWithTheSurface) {
  const double ring = 0.02, tube = 0.006;
  const int n = 120, m = 60;
  const Eigen::Matrix3d turn = shapes::rotation();
  const TriangleTree tree(shapes::transformed(shapes::torus(ring, tube, n, m), turn));
  const TriangleTree inside_out(shapes::turned(shapes::transformed(shapes::torus(ring, tube, n, m), turn)));
  // Facets lie inside the true torus by at most their sagitta.
  const double sagitta = (ring + tube) * (1 - std::cos(M_PI / n)) + tube * (1 - std::cos(M_PI / m));
  Points random(3);
  int in = 0, out = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec3 q = random({-0.027, -0.027, -0.007}, {0.027, 0.027, 0.007});
    const double s = std::hypot(std::hypot(q.x(), q.y()) - ring, q.z()) - tube;
    if (s < 0 && s > -sagitta) continue;
    const Vec3 p = turn * q;
    const double expected = s < 0 ? 1.0 : 0.0;
    (s < 0 ? in : out) += 1;
    EXPECT_NEAR(tree.winding_number(p), expected, 1e-2);  // the documented error
    EXPECT_NEAR(inside_out.winding_number(p), -expected, 1e-2);
    EXPECT_EQ(tree.inside(p), s < 0);
    EXPECT_EQ(inside_out.inside(p), s < 0);
  }
  EXPECT_GT(in, 500);
  EXPECT_GT(out, 500);
}

TEST(TriangleTree, WindingNumberLosesOnlyTheSolidAngleOfAHole) {
  TriangleMesh mesh = shapes::box({-1, -1, -1}, {1, 1, 1});
  // Both triangles of one side: the solid angle of a face of a cube from its centre is 1/6 of the sphere.
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
  EXPECT_NEAR(TriangleTree(mesh).winding_number(Vec3::Zero()), 5.0 / 6.0, 1e-12);
}

TEST(TriangleTree, ASmallHoleDoesNotChangeWhatIsInside) {
  TriangleMesh mesh = shapes::sphere(0.01, 40);
  for (int t = 1000; t < 1004; ++t) shapes::remove_triangle(mesh, t);
  const TriangleTree tree(mesh);
  Points random(4);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p = random({-0.011, -0.011, -0.011}, {0.011, 0.011, 0.011});
    // Within a few hole widths (0.8 mm) of the hole the answer is a matter of taste.
    if ((p - mesh.corner(1000, 0)).norm() < 2.5e-3 || std::abs(p.norm() - 0.01) < 1e-4) continue;
    EXPECT_EQ(tree.inside(p), p.norm() < 0.01);
  }
}

// From points inside, aims exactly at vertices and points of edges; returns the largest t of the first hits, infinity
// for a ray that leaves without a hit.
double farthest_hit(const TriangleMesh& mesh) {
  const TriangleTree tree(mesh);
  Points random(5);
  double farthest = 0.0;
  for (int k = 0; k < 100; ++k) {
    const Vec3 from = random(tree.min(), tree.max());
    if (!tree.inside(from)) continue;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const Vec3& a = mesh.corner(static_cast<int>(t), 0);
      const Vec3& b = mesh.corner(static_cast<int>(t), 1);
      for (const double s : {0.0, 0.25, 0.5, 0.7}) {
        const auto hit = tree.first_hit(from, a + s * (b - a) - from, 1e6);
        farthest = std::max(farthest, hit ? hit->t : std::numeric_limits<double>::infinity());
      }
    }
  }
  return farthest;
}

TEST(TriangleTree, RaysThroughEdgesAndVerticesNeverLeak) {
  // Seen from inside a convex body the target itself is the first hit: t = 1 but for rounding of the aim.
  for (const TriangleMesh& mesh :
       {shapes::box({0, 0, 0}, {0.01, 0.02, 0.03}, 4), shapes::sphere(0.01, 16),
        shapes::transformed(shapes::sphere(0.01, 16), shapes::rotation(), {0.1, 0.2, 0.3})}) {
    const double t = farthest_hit(mesh);
    EXPECT_GT(t, 0.99);
    EXPECT_LT(t, 1.0 + 1e-9);
  }
  // In a torus a ray may graze the inner rim and go on, but never leaves unseen.
  for (const TriangleMesh& mesh :
       {shapes::torus(0.02, 0.006, 24, 12),
        shapes::transformed(shapes::torus(0.02, 0.006, 24, 12), shapes::rotation(), {0.1, 0.2, 0.3})}) {
    EXPECT_LT(farthest_hit(mesh), 1e6);
  }
}

TEST(TriangleTree, RaysAlongTheAxesInFacesAndEdgesOfABoxAreHits) {
  const TriangleTree tree(shapes::box({0, 0, 0}, {1, 1, 1}, 4));
  for (const double y : {0.0, 0.25, 0.3, 1.0}) {
    for (const double z : {0.0, 0.5, 0.6, 1.0}) {
      const auto hit = tree.first_hit({-1, y, z}, {1, 0, 0}, 10.0);
      ASSERT_TRUE(hit) << y << ' ' << z;
      EXPECT_NEAR(hit->t, 1.0, 1e-12);
    }
  }
  EXPECT_FALSE(tree.first_hit({-1, 0.5, 0.5}, {1, 0, 0}, 0.999));
  EXPECT_FALSE(tree.first_hit({-1, 0.5, 0.5}, {-1, 0, 0}, 10.0));
  EXPECT_FALSE(tree.first_hit({-1, 1.0001, 0.5}, {1, 0, 0}, 10.0));
  EXPECT_FALSE(tree.first_hit({-1, 0.5, 0.5}, {0, 0, 0}, 10.0));
  EXPECT_NEAR(tree.first_hit({0.5, 0.5, 0.5}, {0, 0, 2}, 10.0)->t, 0.25, 1e-12);  // t in units of the direction
  EXPECT_NEAR(tree.first_hit({-1e6, 0.5, 0.5}, {1, 0, 0}, 1e7)->t, 1e6, 1e-6);    // from afar
}

TEST(TriangleTree, TheFirstHitIsTheFirstOfAllTriangles) {
  const TriangleMesh mesh = shapes::transformed(shapes::torus(0.02, 0.006, 60, 30), shapes::rotation());
  const TriangleTree tree(mesh);
  Points random(6);
  int hits = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 from = random(2 * tree.min(), 2 * tree.max());
    const Vec3 direction = random(tree.min(), tree.max()) - from;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      // Moeller & Trumbore, J. Graph. Tools 2(1), 21 (1997).
      const int t = static_cast<int>(i);
      const Vec3 e1 = mesh.corner(t, 1) - mesh.corner(t, 0), e2 = mesh.corner(t, 2) - mesh.corner(t, 0);
      const Vec3 h = direction.cross(e2), s = from - mesh.corner(t, 0), q = s.cross(e1);
      const double a = e1.dot(h), u = s.dot(h) / a, v = direction.dot(q) / a, along = e2.dot(q) / a;
      if (u >= 0 && v >= 0 && u + v <= 1 && along >= 0) best = std::min(best, along);
    }
    const auto hit = tree.first_hit(from, direction, 1e3);
    ASSERT_EQ(hit.has_value(), std::isfinite(best));
    if (hit) {
      EXPECT_NEAR(hit->t, best, 1e-9);
      ++hits;
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(TriangleTree, ManyTrianglesInOnePlaceAndDegenerateOnesAreNoTrouble) {
  TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
  for (int k = 0; k < 300; ++k) {
    mesh.triangles.push_back({0, 0, 0});
    mesh.triangles.push_back({0, 1, 0});
    mesh.triangles.push_back(mesh.triangles[0]);
  }
  const TriangleTree tree(mesh);
  EXPECT_DOUBLE_EQ(tree.closest({0.5, 0.5, 2.0}).distance, 1.0);
  EXPECT_TRUE(tree.first_hit({0.4, 0.3, 2.0}, {0, 0, -1}, 10.0));
  EXPECT_THROW(TriangleTree(TriangleMesh{}), std::invalid_argument);
  mesh.triangles.push_back({0, 1, 1000});
  EXPECT_THROW(TriangleTree{mesh}, std::invalid_argument);
}

}  // namespace
}  // namespace puffin::lbm::geometry
