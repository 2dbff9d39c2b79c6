// Faults of surfaces: each is found, counted and placed; a clean surface has none.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lbm/geometry/point_windows.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

using shapes::box;
using shapes::joined;
using shapes::turned;

TriangleMesh cube() { return box({0, 0, 0}, {0.01, 0.01, 0.01}); }

std::optional<Defect> find(const std::vector<Defect>& defects, const std::string& kind) {
  const auto d = std::find_if(defects.begin(), defects.end(), [&](const Defect& x) { return x.kind == kind; });
  return d == defects.end() ? std::nullopt : std::optional<Defect>(*d);
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    require_closed(mesh);
  } catch (const GeometryError& e) {
    return e.what();
  }
  return "";
}

TEST(SurfaceCheck, CleanSurfacesHaveNoDefects) {
  for (const TriangleMesh& mesh : {cube(), shapes::torus(0.02, 0.005, 24, 12), shapes::sphere(0.01, 12),
                                   shapes::step_duct(0.01, 0.02, 0.005, 0.004, 0.002)}) {
    for (const Defect& d : check_surface(mesh)) ADD_FAILURE() << d.message;
    EXPECT_EQ(refusal(mesh), "");
  }
}

TEST(SurfaceCheck, VolumeAndAreaOfABoxAreThoseOfTheFormulaWhereverItStands) {
  // The corner products are about 1 m^3 x 6 if taken from the origin: 1e-16 of that would be all of the volume's digits
  // but three. Taken from a vertex they keep twelve.
  const TriangleMesh mesh = box({1, 1, 1}, {1.001, 1.002, 1.003});
  EXPECT_NEAR(enclosed_volume(mesh), 6e-9, 6e-9 * 1e-12 + 1e-16 * 6e-6);
  EXPECT_NEAR(surface_area(mesh), 22e-6, 22e-6 * 1e-11);
}

TEST(SurfaceCheck, AHoleIsNamedByItsEdges) {
  TriangleMesh mesh = cube();
  shapes::remove_triangle(mesh, 0);  // x-min: (0,0,0) (0,.01,.01) (0,.01,0)
  const auto hole = find(check_surface(mesh), "hole");
  ASSERT_TRUE(hole);
  EXPECT_TRUE(hole->fatal);
  EXPECT_EQ(hole->count, 3u);
  for (const Vec3& w : hole->where) EXPECT_EQ(w.x(), 0.0);
  EXPECT_NE(refusal(mesh).find("the edge from (0, 0, 0) m to (0, 0.01, 0.01) m belongs to one triangle only"),
            std::string::npos)
      << refusal(mesh);
}

TEST(SurfaceCheck, ATurnedFacetIsFoundByItsThreeEdges) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const auto defect = find(check_surface(mesh), "inconsistent orientation");
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->count, 3u);
  EXPECT_NE(refusal(mesh).find("different sides"), std::string::npos);
}

TEST(SurfaceCheck, AnInsideOutSurfaceIsRefused) {
  EXPECT_TRUE(find(check_surface(turned(cube())), "inside out"));
  EXPECT_NE(refusal(turned(cube())).find("inside out"), std::string::npos);
}

TEST(SurfaceCheck, DuplicateAndDegenerateFacetsAreCounted) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back(mesh.triangles[5]);
  mesh.triangles.push_back({mesh.triangles[5][2], mesh.triangles[5][0], mesh.triangles[5][1]});
  mesh.triangles.push_back({0, 0, 1});
  mesh.solid.insert(mesh.solid.end(), 3, 0);
  const auto defects = check_surface(mesh);
  ASSERT_TRUE(find(defects, "duplicate facet"));
  EXPECT_EQ(find(defects, "duplicate facet")->count, 2u);
  ASSERT_TRUE(find(defects, "degenerate facet"));
  EXPECT_EQ(find(defects, "degenerate facet")->count, 1u);
  EXPECT_TRUE(find(defects, "non-manifold edge")->fatal);  // the copies have no partner
}

TEST(SurfaceCheck, CollinearCornersAreADegenerateFacet) {
  TriangleMesh mesh = cube();
  const int n = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.5 * (mesh.vertices[0] + mesh.vertices[1]));
  mesh.triangles.push_back({0, n, 1});
  mesh.solid.push_back(0);
  EXPECT_EQ(find(check_surface(mesh), "degenerate facet")->count, 1u);
}

TEST(SurfaceCheck, TwoCubesThatTouchInAnEdgeAreNonManifoldButBoundAVolume) {
  TriangleMesh mesh = joined(cube(), box({0.01, 0.01, 0}, {0.02, 0.02, 0.01}));
  weld(mesh, 1e-9);
  const auto defect = find(check_surface(mesh), "non-manifold edge");
  ASSERT_TRUE(defect);
  EXPECT_FALSE(defect->fatal);
  EXPECT_EQ(refusal(mesh), "");
}

TEST(SurfaceCheck, SeparateAndNestedPartsAreToldApart) {
  const auto apart = check_surface(joined(cube(), box({0.02, 0, 0}, {0.03, 0.01, 0.01})));
  EXPECT_TRUE(find(apart, "disconnected part"));
  EXPECT_FALSE(find(apart, "nested shell"));
  // A body in the flow: inside, and pointing into itself.
  const auto body = check_surface(joined(cube(), turned(box({0.004, 0.004, 0.004}, {0.006, 0.006, 0.006}))));
  ASSERT_TRUE(find(body, "nested shell"));
  EXPECT_NE(find(body, "nested shell")->message.find("a body in the flow"), std::string::npos);
  EXPECT_FALSE(find(body, "inside out"));
  EXPECT_FALSE(find(body, "disconnected part"));
}

TEST(SurfaceCheck, PartsOfAnOpenSurfaceAreNotAskedWhetherOneLiesInAnother) {
  TriangleMesh mesh = joined(cube(), turned(box({0.004, 0.004, 0.004}, {0.006, 0.006, 0.006})));
  shapes::remove_triangle(mesh, 0);
  const auto defects = check_surface(mesh);
  EXPECT_TRUE(find(defects, "hole"));
  EXPECT_TRUE(find(defects, "disconnected part"));
  EXPECT_FALSE(find(defects, "nested shell"));
}

TEST(PointWindows, LookAtFewPointsOfASheetOrOfLongEdgesWhateverTheAxis) {
  // n points on a line across each axis in turn; boxes as long as another axis and 1/n wide hold one of them.
  constexpr int n = 1000;
  for (int along = 0; along < 3; ++along) {
    std::vector<Vec3> points(n, Vec3::Zero());
    std::vector<int> all(n);
    for (int k = 0; k < n; ++k) points[k][along] = k, all[k] = k;
    const PointWindows windows(points, all);
    for (int k = 0; k < n; ++k) {
      Vec3 low = Vec3::Constant(-1.0), high = Vec3::Constant(1e3);
      low[along] = k - 0.5;
      high[along] = k + 0.5;
      ASSERT_EQ(windows.candidates(low, high).size(), 1u);
      EXPECT_EQ(windows.candidates(low, high)[0], k);
    }
  }
}

TEST(SurfaceCheck, SelfIntersectionsAreFoundAndTouchingFacesAreNot) {
  const auto crossing = check_surface(joined(cube(), box({0.005, 0.002, 0.002}, {0.02, 0.008, 0.008})));
  const auto found = find(crossing, "self-intersection");
  ASSERT_TRUE(found);
  EXPECT_GE(found->count, 4u);  // the four long edges of the second box pass through the first
  for (const Vec3& w : found->where) EXPECT_NEAR(w.x(), 0.01, 1e-12);
  EXPECT_FALSE(
      find(check_surface(joined(cube(), box({0.01, 0.002, 0.002}, {0.02, 0.008, 0.008}))), "self-intersection"));
  EXPECT_FALSE(find(check_surface(shapes::transformed(shapes::torus(0.02, 0.005, 90, 40), shapes::rotation())),
                    "self-intersection"));
}

TEST(SurfaceCheck, BodiesWhoseEdgesPassThroughDiagonalsCross) {
  // The three edges of each box that enter the other do it in the middle or on the diagonal of a square.
  for (const double to : {0.006, 0.008}) {
    const auto found =
        find(check_surface(joined(box({0, 0, 0}, {0.004, 0.004, 0.004}), box({0.002, 0.002, 0.002}, {to, to, to}))),
             "self-intersection");
    ASSERT_TRUE(found) << to;
    EXPECT_GE(found->count, 3u);
  }
}

TEST(SurfaceCheck, EdgesThatTouchEdgesDoNotCross) {
  // A box on its edge, turned by 45 degrees, whose lower edge lies across the upper edge of another such box.
  const double h = 0.01 / std::sqrt(2.0);
  Eigen::Matrix3d about_x = Eigen::AngleAxisd(std::acos(-1.0) / 4, Vec3::UnitX()).toRotationMatrix();
  Eigen::Matrix3d about_y = Eigen::AngleAxisd(std::acos(-1.0) / 4, Vec3::UnitY()).toRotationMatrix();
  const TriangleMesh middle = box({-0.005, -0.005, -0.005}, {0.005, 0.005, 0.005});
  for (const double gap : {0.0, -1e-4}) {
    const auto found = find(check_surface(joined(shapes::transformed(middle, about_x),
                                                 shapes::transformed(middle, about_y, {1e-3, 2e-3, 2 * h + gap}))),
                            "self-intersection");
    EXPECT_EQ(found.has_value(), gap < 0.0) << gap;
  }
}

TEST(SurfaceCheck, FacesThatOverlapInAPlaneAreSelfIntersections) {
  // Two boxes whose floors lie in one plane and overlap in a quarter: crossing edges apart, the floors overlap.
  const auto boxes = joined(cube(), box({0.005, 0.005, 0.0}, {0.015, 0.015, 0.01}));
  const auto found = find(check_surface(boxes), "self-intersection");
  ASSERT_TRUE(found);
  const bool floor = std::any_of(found->where.begin(), found->where.end(), [](const Vec3& w) {
    return w.z() == 0.0 && w.x() > 0.005 && w.x() < 0.01 && w.y() > 0.005 && w.y() < 0.01;
  });
  EXPECT_TRUE(floor);
  // A facet folded back on its neighbour: two triangles that share an edge and lie on the same side of it.
  TriangleMesh fold;
  fold.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0.003, 0.01, 0}, {0.006, 0.005, 0}};
  fold.triangles = {{0, 1, 2}, {0, 1, 3}};
  fold.solid = {0, 0};
  fold.solids = {"s"};
  EXPECT_TRUE(find(check_surface(fold), "self-intersection"));
  fold.triangles[1] = {1, 0, 3};  // back to back: a wall without thickness, no overlap of one side with itself
  EXPECT_FALSE(find(check_surface(fold), "self-intersection"));
}

TEST(SurfaceCheck, CoordinatesFarFromTheOriginAreToldToBeCoarse) {
  const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
  EXPECT_FALSE(find(check_surface(shapes::transformed(cube(), same, {0.1, 0, 0})), "coarse coordinates"));
  // 1e6 mm away single precision resolves 0.06 mm: 0.6 % of the cube.
  const auto found = find(check_surface(shapes::transformed(cube(), same, {1e3, 0, 0})), "coarse coordinates");
  ASSERT_TRUE(found);
  EXPECT_NE(found->message.find("0.596"), std::string::npos) << found->message;
}

TEST(SurfaceCheck, TheLikelyUnitIsNamed) {
  const auto metres_as_mm = find(check_surface(box({0, 0, 0}, {3e-5, 1e-5, 1e-5})), "suspicious size");
  EXPECT_NE(metres_as_mm->message.find("unit may be m:"), std::string::npos) << metres_as_mm->message;
  const auto mm_as_metres = find(check_surface(box({0, 0, 0}, {30, 10, 10})), "suspicious size");
  EXPECT_NE(mm_as_metres->message.find("unit may be mm:"), std::string::npos) << mm_as_metres->message;
}

TEST(SurfaceCheck, AWrongUnitIsSuspected) {
  EXPECT_TRUE(find(check_surface(box({0, 0, 0}, {30, 10, 10})), "suspicious size"));
  EXPECT_TRUE(find(check_surface(box({0, 0, 0}, {3e-5, 1e-5, 1e-5})), "suspicious size"));
}

}  // namespace
}  // namespace puffin::lbm::geometry
