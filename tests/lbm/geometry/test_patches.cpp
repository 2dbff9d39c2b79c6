// Names for parts of the surface.

#include <gtest/gtest.h>

#include <algorithm>

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
  for (const std::string select : {"plane:x-min", "near:[0.0001, 0.001, 0.002]", "near:[ -1 , 0.0025,0.002 ]"}) {
    const Patches p = assign_patches(nameless, {{"in", select}});
    EXPECT_EQ(p.names, (std::vector<std::string>{"in", "wall"}));
    EXPECT_NEAR(area_of(nameless, p, "in"), 0.005 * 0.004, 1e-15) << select;
  }
  EXPECT_NEAR(area_of(mesh, assign_patches(mesh, {{"in", "solid:inlet"}}), "in"), 0.005 * 0.004, 1e-15);
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
  const Patches p = assign_patches(mesh, {{"top", "near:[0.5, 0.5, 0.9]"}});
  EXPECT_EQ(std::count(p.of_triangle.begin(), p.of_triangle.end(), 0), 72);
  EXPECT_NEAR(area_of(mesh, p, "top"), 1.0, 1e-12);
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

}  // namespace
}  // namespace puffin::lbm::geometry
