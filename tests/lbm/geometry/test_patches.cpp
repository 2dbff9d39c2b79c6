// Names for parts of the surface.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "lbm/geometry/patch_parts.hpp"
#include "lbm/geometry/patches.hpp"
#include "lbm/geometry/surface_check.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

TriangleMesh duct() { return shapes::step_duct(0.01, 0.02, 0.005, 0.004, 0.002); }

double area_of(const TriangleMesh& mesh, const Patches& patches, const std::string& name) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (patches.of_triangle[t] == patches.find(name)) area += mesh.area(static_cast<int>(t));
  }
  return area;
}

std::string complaint(const TriangleMesh& mesh, const std::vector<PatchSelection>& selections) {
  try {
    assign_patches(mesh, selections);
  } catch (const GeometryError& e) {
    return e.what();
  }
  return "";
}

TEST(Patches, SolidPlaneAndPointSelectTheSameInlet) {
  const TriangleMesh mesh = duct();
  TriangleMesh nameless = mesh;
  nameless.solids = {"all"};
  nameless.solid.assign(mesh.triangles.size(), 0);
  for (const std::string select : {"plane:x-min", "near:[0.0001, 0.001, 0.002]", "near:[ -0.0002 , 0.0025,0.002 ]"}) {
    const Patches p = assign_patches(nameless, {{"in", select}});
    EXPECT_EQ(p.names, (std::vector<std::string>{"in", "wall"}));
    EXPECT_NEAR(area_of(nameless, p, "in"), 0.005 * 0.004, 1e-15) << select;
  }
  EXPECT_NEAR(area_of(mesh, assign_patches(mesh, {{"in", "solid:inlet"}}), "in"), 0.005 * 0.004, 1e-15);
}

// Faces of 2 x 3, 3 x 4 and 2 x 4 in parts of a box: opposite ones do not touch; neighbours do, and air crosses their
// projection, here the hypotenuse of 2 and 3 times 4.
TEST(Patches, PartsHangTogetherOverEdges) {
  const TriangleMesh box = shapes::box({0, 0, 0}, {2, 3, 4}, 3);
  const auto parts = [&](const std::vector<int>& solids) {
    std::vector<int> of;
    for (const int solid : box.solid) of.push_back(std::find(solids.begin(), solids.end(), solid) == solids.end());
    return parts_of(box, of, 0);
  };
  const auto opposite = parts({2, 3});  // y-min, y-max
  ASSERT_EQ(opposite.size(), 2u);
  for (int p : {0, 1}) {
    EXPECT_NEAR(opposite[p].area, 8.0, 1e-12);
    EXPECT_LT((opposite[p].normal - Vec3(0, p == 0 ? -1 : 1, 0)).norm(), 1e-12);
    EXPECT_LT((opposite[p].centroid - Vec3(1, p == 0 ? 0 : 3, 2)).norm(), 1e-12);
  }
  const NearestPart nearest(box, opposite);
  EXPECT_EQ(nearest({1, 1, 1}), 0);
  EXPECT_EQ(nearest({1, 2, 1}), 1);
  EXPECT_EQ(nearest({9, 3.1, 5}), 1);
  const auto neighbours = parts({0, 2});  // x-min, y-min
  ASSERT_EQ(neighbours.size(), 1u);
  EXPECT_NEAR(neighbours[0].surface, 20.0, 1e-12);
  EXPECT_NEAR(neighbours[0].area, 4.0 * std::hypot(2.0, 3.0), 1e-12);
  const auto around = parts({0, 1, 2, 3});
  ASSERT_EQ(around.size(), 1u);
  EXPECT_TRUE(around[0].normal.isZero());
}

TEST(Patches, UntaggedSolidsKeepTheirNames) {
  const Patches p = assign_patches(duct(), {{"in", "solid:inlet"}});
  EXPECT_EQ(p.names.size(), 3u);
  EXPECT_EQ(p.names[0], "in");
  EXPECT_GE(p.find("outlet"), 1);
  EXPECT_GE(p.find("wall"), 1);
  EXPECT_EQ(p.find("inlet"), -1);
}

TEST(Patches, TheFeatureAtAPointEndsAtItsEdges) {
  const TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1}, 6);
  const Patches p = assign_patches(mesh, {{"top", "near:[0.5, 0.5, 0.99]"}});
  EXPECT_EQ(std::count(p.of_triangle.begin(), p.of_triangle.end(), 0), 72);
  EXPECT_NEAR(area_of(mesh, p, "top"), 1.0, 1e-12);
}

TEST(Patches, AFeatureOfSliversIsFoundWhole) {
  // A round cap as a fan of 400 slivers from one corner of its rim, turned, in single precision: the normals of the
  // thinnest are rounding.
  constexpr int n = 402;
  TriangleMesh mesh;
  mesh.solids = {"s"};
  for (const double z : {0.0, 0.02})
    for (int k = 0; k < n; ++k) {
      const double a = 2.0 * std::numbers::pi * k / n;
      mesh.vertices.emplace_back(0.005 * std::cos(a), 0.005 * std::sin(a), z);
    }
  for (int k = 1; k + 1 < n; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    mesh.triangles.push_back({n, n + k, n + k + 1});
  }
  for (int k = 0; k < n; ++k) {
    mesh.triangles.push_back({k, (k + 1) % n, n + k});
    mesh.triangles.push_back({(k + 1) % n, n + (k + 1) % n, n + k});
  }
  mesh.solid.assign(mesh.triangles.size(), 0);
  mesh = shapes::transformed(mesh, shapes::rotation());
  for (auto& v : mesh.vertices) v = v.cast<float>().cast<double>();
  // Asked at the first sliver, at the rim, and in the middle.
  for (const Vec3& at : {Vec3(0.005, 1e-5, 0.0), Vec3(0.0049, 0.0, 0.0), Vec3(0, 0, 0)}) {
    const Vec3 p = shapes::rotation() * at;
    std::array<char, 120> text;
    std::snprintf(text.data(), text.size(), "near:[%.9g, %.9g, %.9g]", p.x(), p.y(), p.z());
    const Patches patches = assign_patches(mesh, {{"inlet", text.data()}});
    EXPECT_EQ(std::count(patches.of_triangle.begin(), patches.of_triangle.end(), 0), n - 2) << text.data();
  }
}

TEST(Patches, EveryMistakeIsToldAtOnceWithARemedy) {
  const std::string all = complaint(duct(), {{"a", "solid:inlett"},
                                             {"b", "plane:x-middle"},
                                             {"c", "near:[1, 2]"},
                                             {"d", "everything"},
                                             {"e", "solid:inlet"},
                                             {"f", "plane:x-min"},
                                             {"f", "plane:y-min"}});
  for (const std::string expected :
       {"patch 'a': there is no solid 'inlett'; did you mean 'inlet'? The solids of the file: 'inlet' 'outlet' 'wall'",
        "patch 'b': 'plane:x-middle' is no plane", "patch 'c': 'near:[1, 2]' is no point",
        "patch 'd': 'everything' selects nothing", "patch 'f': 'plane:x-min' overlaps patch 'e' in 2 triangles",
        "patch 'f': this name is used twice"}) {
    EXPECT_NE(all.find(expected), std::string::npos) << expected << "\n--- in ---\n" << all;
  }
}

TEST(Patches, APointFarFromTheSurfaceIsRefusedWithTheUnitThatWasMeant) {
  const auto box = shapes::box({0, 0, 0}, {0.04, 0.004, 0.003});
  // In mm, as the file may be: in metres x-max is nearest; y-max was meant.
  const std::string said = complaint(box, {{"in", "near:[20, 4, 1.5]"}});
  for (const std::string expected : {"lies 2.041e+04 mm from the surface", "its numbers are metres",
                                     "if they were meant in mm, write near:[0.02, 0.004, 0.0015]"})
    EXPECT_NE(said.find(expected), std::string::npos) << expected << "\n--- in ---\n" << said;
  // 1 % of the diagonal is 0.403 mm.
  EXPECT_EQ(complaint(box, {{"in", "near:[-0.0004, 0.002, 0.0015]"}}), "");
  const std::string beyond = complaint(box, {{"in", "near:[-0.00041, 0.002, 0.0015]"}});
  EXPECT_NE(beyond.find("lies 0.41 mm from the surface"), std::string::npos) << beyond;
  EXPECT_EQ(beyond.find("were meant in"), std::string::npos) << beyond;
}

TEST(Patches, AnEmptyPlaneIsRefused) {
  EXPECT_NE(complaint(shapes::sphere(0.01, 8), {{"in", "plane:z-max"}}).find("no triangle lies flat"),
            std::string::npos);
}

TEST(Patches, ASolidThatBearsASelectionsNameButReachesBeyondItIsRefused) {
  // The whole surface is "inlet": tagging a plane of it "inlet" must not make an opening of the rest.
  TriangleMesh mesh = duct();
  mesh.solid.assign(mesh.triangles.size(), 0);
  EXPECT_NE(complaint(mesh, {{"inlet", "plane:x-min"}}).find("triangles outside the selection"), std::string::npos);
}

TEST(Patches, OfASelectionThatFailedNothingElseIsSaid) {
  const std::string said = complaint(duct(), {{"inlet", "solid:inlett"}});  // the solid 'inlet' is in the file
  EXPECT_NE(said.find("there is no solid 'inlett'"), std::string::npos) << said;
  EXPECT_EQ(said.find("outside the selection"), std::string::npos) << said;
}

}  // namespace
}  // namespace puffin::lbm::geometry
