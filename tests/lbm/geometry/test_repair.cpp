// Mending: what can be mended is clean afterwards, and everything done is told.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lbm/geometry/repair.hpp"
#include "lbm/geometry/stl.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/weld.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

std::size_t count(const std::vector<Repair>& done, const std::string& what) {
  for (const Repair& r : done) {
    if (r.what == what) return r.count;
  }
  return 0;
}

TriangleMesh torus() { return shapes::transformed(shapes::torus(0.02, 0.006, 40, 20), shapes::rotation()); }

TEST(Repair, ACleanSurfaceIsLeftAlone) {
  TriangleMesh mesh = torus();
  EXPECT_TRUE(repair(mesh).empty());
  const TriangleMesh before = torus();  // vertices may be numbered anew
  ASSERT_EQ(mesh.triangles.size(), before.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(mesh.corner(t, k), before.corner(t, k));
  }
}

TriangleMesh soup_of(const TriangleMesh& whole) {
  TriangleMesh soup;
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    soup.triangles.push_back({static_cast<int>(3 * t), static_cast<int>(3 * t + 1), static_cast<int>(3 * t + 2)});
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(whole.corner(static_cast<int>(t), k));
  }
  soup.solid = whole.solid;
  soup.solids = whole.solids;
  return soup;
}

TEST(Repair, CornersOfItsOwnForEveryTriangleAreWelded) {
  const TriangleMesh whole = torus();
  TriangleMesh soup = soup_of(whole);
  EXPECT_EQ(count(repair(soup), "welded vertices"), 3 * whole.triangles.size() - whole.vertices.size());
  EXPECT_TRUE(check_surface(soup).empty());
}

TEST(Repair, CornersThatMissEachOtherBySomeNanometresAreOneAndNoTJunctions) {
  // A diagonal of 50 mm: reading welds up to 5 nm, and up to 50 nm from an edge a corner lies on it. Copies of a corner
  // are up to 20 sqrt(3) nm apart.
  const TriangleMesh whole = torus();
  TriangleMesh soup = soup_of(whole);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-1e-8, 1e-8);
  for (Vec3& v : soup.vertices) v += Vec3(jitter(random), jitter(random), jitter(random));
  weld(soup, weld_tolerance(soup));  // as read_stl does
  const auto done = repair(soup);
  EXPECT_EQ(count(done, "split facets"), 0u);
  EXPECT_EQ(count(done, "filled holes"), 0u);
  EXPECT_EQ(soup.triangles.size(), whole.triangles.size());
  EXPECT_TRUE(check_surface(soup).empty());
}

TEST(Repair, TurnedFacetsAreTurnedBackAndAnInsideOutSurfaceIsTurnedWhole) {
  TriangleMesh mesh = torus();
  for (const int t : {3, 100, 101, 555}) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  EXPECT_EQ(count(repair(mesh), "turned facets"), 4u);
  EXPECT_TRUE(check_surface(mesh).empty());
  TriangleMesh inside_out = shapes::turned(torus());
  EXPECT_EQ(count(repair(inside_out), "turned facets"), inside_out.triangles.size());
  EXPECT_GT(enclosed_volume(inside_out), 0.0);
}

TEST(Repair, ABodyInTheFlowStaysABody) {
  TriangleMesh mesh = shapes::joined(shapes::box({0, 0, 0}, {0.01, 0.01, 0.01}),
                                     shapes::turned(shapes::sphere(0.002, 12, {0.005, 0.005, 0.005})));
  const double volume = enclosed_volume(mesh);
  EXPECT_TRUE(repair(mesh).empty());
  EXPECT_EQ(enclosed_volume(mesh), volume);
}

TEST(Repair, ASurfaceTurnedInsideOutAsAWholeIsTurnedBackWithTheBodyInIt) {
  const TriangleMesh right = shapes::joined(shapes::box({0, 0, 0}, {0.01, 0.01, 0.01}),
                                            shapes::turned(shapes::sphere(0.002, 12, {0.005, 0.005, 0.005})));
  TriangleMesh mesh = shapes::turned(right);
  EXPECT_EQ(count(repair(mesh), "turned facets"), mesh.triangles.size());
  EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(right), 1e-18);
  for (const Defect& d : check_surface(mesh)) EXPECT_FALSE(d.fatal) << d.message;
}

TEST(Repair, DuplicateAndDegenerateFacetsGo) {
  TriangleMesh mesh = torus();
  const std::size_t before = mesh.triangles.size();
  for (const int t : {7, 7, 20}) mesh.triangles.push_back(mesh.triangles[t]);
  mesh.triangles.push_back({5, 5, 6});
  mesh.solid.insert(mesh.solid.end(), 4, 0);
  const auto done = repair(mesh);
  EXPECT_EQ(count(done, "removed duplicate facets"), 3u);
  EXPECT_EQ(count(done, "removed degenerate facets"), 1u);
  EXPECT_EQ(mesh.triangles.size(), before);
  EXPECT_TRUE(check_surface(mesh).empty());
}

TEST(Repair, ANeedleGoesAndTheSeamThatItClosedIsShared) {
  // The facets on one side of an edge have a corner in its middle, those on the other have not: a facet with all
  // corners on the edge lies between.
  TriangleMesh mesh = shapes::box({0, 0, 0}, {0.04, 0.004, 0.003});
  const int a = mesh.triangles[0][0], c = mesh.triangles[0][1], apex = mesh.triangles[0][2];
  const int middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.5 * (mesh.vertices[a] + mesh.vertices[c]));
  mesh.triangles[0] = {a, middle, apex};
  for (const auto& t : {std::array{middle, c, apex}, std::array{a, c, middle}}) {
    mesh.triangles.push_back(t);
    mesh.solid.push_back(mesh.solid[0]);
  }
  const double volume = enclosed_volume(mesh);
  ASSERT_EQ(check_surface(mesh).size(), 1u);  // "degenerate facet ... --repair removes it"
  const auto done = repair(mesh);
  EXPECT_EQ(count(done, "removed degenerate facets"), 1u);
  EXPECT_EQ(count(done, "split facets"), 1u);
  EXPECT_TRUE(check_surface(mesh).empty());
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-12 * volume);
}

TEST(Repair, CopiesOfOneSenseGoAloneToo) {
  TriangleMesh mesh = torus();
  const std::vector<std::array<int, 3>> before = mesh.triangles;
  for (const int t : {7, 7, 20}) mesh.triangles.push_back(mesh.triangles[t]);
  mesh.solid.insert(mesh.solid.end(), 3, 0);
  EXPECT_EQ(remove_copies(mesh).count, 3u);
  EXPECT_EQ(mesh.triangles, before);
  EXPECT_EQ(remove_copies(mesh).count, 0u);
  const auto turned = std::array<int, 3>{before[4][1], before[4][0], before[4][2]};
  mesh.solids.emplace_back("another");
  mesh.triangles.push_back(before[9]);  // in another solid: to which patch it belongs is not ours to say
  mesh.solid.push_back(static_cast<int>(mesh.solids.size()) - 1);
  EXPECT_EQ(remove_copies(mesh).count, 0u);
  mesh.triangles.push_back(turned);  // both senses: which of them is meant is not ours to say
  mesh.solid.push_back(0);
  EXPECT_EQ(remove_copies(mesh).count, 0u);
}

TEST(Repair, TheCommonFaceOfTwoBodiesGoesSoThatTheyAreOne) {
  TriangleMesh mesh =
      shapes::joined(shapes::box({0, 0, 0}, {0.01, 0.01, 0.01}), shapes::box({0.01, 0, 0}, {0.02, 0.01, 0.01}));
  // Both boxes must cut their common square along the same diagonal for the facets to coincide.
  const auto done = repair(mesh);
  EXPECT_NEAR(enclosed_volume(mesh), 2e-6, 1e-15);
  for (const Defect& d : check_surface(mesh)) EXPECT_FALSE(d.fatal) << d.message;
}

TEST(Repair, SmallHolesAreFilledAndLargeOnesAreLeft) {
  TriangleMesh mesh = torus();
  const double volume = enclosed_volume(mesh);
  for (int k = 0; k < 6; ++k) shapes::remove_triangle(mesh, 200);  // three squares in a row
  shapes::remove_triangle(mesh, 900);
  TriangleMesh left = mesh;
  EXPECT_EQ(count(repair(left, {.largest_hole = 1e-4}), "filled holes"), 0u);
  const auto done = repair(mesh, {.largest_hole = 0.03});
  EXPECT_EQ(count(done, "filled holes"), 2u);
  EXPECT_TRUE(check_surface(mesh).empty());
  EXPECT_EQ(mesh.solids.back(), "filled-hole");
  // Filling cuts across seven facets of about (pi R/20)(2 pi r/20) with a sagitta of r (1 - cos(3 pi/20)) at most.
  EXPECT_NEAR(enclosed_volume(mesh), volume, 7 * 0.5 * 0.0041 * 0.0019 * 0.006 * 0.11);
}

TEST(Repair, AHolesNewFacetsDoNotFoldBackOnASingleTriangle) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.solid = {0};
  mesh.solids = {"a"};
  repair(mesh, {.largest_hole = 1.0});
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_THROW(require_closed(mesh), GeometryError);
}

}  // namespace
}  // namespace puffin::lbm::geometry
