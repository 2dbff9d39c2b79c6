// Voxels stand for the surface: volumes converge, copies classify equally, pockets go.

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxel_report.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "tests/lbm/geometry/disagreements.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

std::size_t fluid_cells(const Voxels& v) { return v.cells(); }

double volume(const Voxels& v) { return static_cast<double>(fluid_cells(v)) * v.dx * v.dx * v.dx; }

TEST(Voxelize, ABoxOfWholeCellsIsExactAndFlushWithItsLowCorner) {
  const TriangleTree tree(shapes::box({0.001, 0.002, 0.003}, {0.011, 0.007, 0.006}));
  const Voxels v = voxelize(tree, 0.0005);
  EXPECT_EQ(v.size, (std::array<int, 3>{20, 10, 6}));
  EXPECT_LT((v.origin - Vec3(0.00125, 0.00225, 0.00325)).norm(), 1e-15);
  EXPECT_EQ(fluid_cells(v), 20u * 10u * 6u);
}

TEST(Voxelize, ABoxOfBrokenCellsCoversTheBoxAndKeepsTheCellsWithCentresInside) {
  const TriangleTree tree(shapes::box({0, 0, 0}, {1.0, 1.04, 1.06}));
  const Voxels v = voxelize(tree, 0.1);
  EXPECT_EQ(v.size, (std::array<int, 3>{10, 11, 11}));
  EXPECT_EQ(fluid_cells(v), 10u * 10u * 11u);  // centres at 1.05: outside 1.04, inside 1.06
}

TEST(Voxelize, CentresOnTheSurfaceGoToThePositiveSideSoThatWidthsStayRight) {
  // The small box's faces run through cell centres: it is 4 cells wide and must count 4, not 3 or 5.
  TriangleMesh mesh = shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}),
                                     shapes::turned(shapes::box({0.25, 0.25, 0.25}, {0.65, 0.65, 0.65})));
  const Voxels v = voxelize(TriangleTree(mesh), 0.1);
  EXPECT_EQ(fluid_cells(v), 1000u - 64u);
  EXPECT_TRUE(v.is_fluid(6, 6, 6));
  EXPECT_FALSE(v.is_fluid(2, 2, 2));
}

TEST(Voxelize, TheVolumeOfASphereAndATorusConvergesFasterThanFirstOrder) {
  // Counting lattice points: the error is a surface sum of independent roundings, so of order dx^2 relative to a
  // volume of order one (dx^3 sqrt(area/dx^2) = dx^2), and certainly far below the first-order bound area dx / 2.
  for (const TriangleMesh& mesh : {shapes::transformed(shapes::sphere(1.0, 60), shapes::rotation()),
                                   shapes::transformed(shapes::torus(1.0, 0.4, 90, 45), shapes::rotation())}) {
    const TriangleTree tree(mesh);
    const double exact = enclosed_volume(mesh), area = surface_area(mesh);
    for (const double dx : {0.1, 0.05, 0.025, 0.0125}) {
      const double rounding = dx * dx * dx * std::sqrt(area / (dx * dx) / 12.0);  // standard deviation
      EXPECT_LT(std::abs(volume(voxelize(tree, dx)) - exact), 4.0 * rounding) << dx;
    }
  }
}

TEST(Voxelize, EveryCellAgreesWithTheWindingNumber) {
  for (const TriangleMesh& mesh :
       {shapes::transformed(shapes::torus(1.0, 0.4, 24, 12), shapes::rotation()), shapes::torus(1.0, 0.4, 24, 12),
        shapes::transformed(shapes::step_duct(2, 4, 1, 1.6, 0.7), shapes::rotation()),
        shapes::turned(shapes::sphere(1.0, 8))}) {
    const TriangleTree tree(mesh);
    EXPECT_EQ(disagreements(tree, voxelize(tree, 0.07), 1e-6), 0u);
  }
}

TEST(Voxelize, TranslatedAndPermutedCopiesClassifyEqually) {
  const TriangleMesh mesh = shapes::transformed(shapes::torus(1.0, 0.4, 48, 24), shapes::rotation());
  const TriangleTree tree(mesh);
  const double dx = 0.0437;
  const Voxels v = voxelize(tree, dx);
  // The box starts at the copy's own low corner, so a shifted copy has the same cells. A centre on the surface to
  // within rounding could differ; this torus has none.
  const Voxels shifted =
      voxelize(TriangleTree(shapes::transformed(mesh, Eigen::Matrix3d::Identity(), {11, -7, 5})), dx);
  ASSERT_EQ(shifted.size, v.size);
  EXPECT_EQ(shifted.first, v.first);
  EXPECT_EQ(shifted.runs, v.runs);
  // x -> y -> z -> x
  Eigen::Matrix3d cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const Voxels cycled = voxelize(TriangleTree(shapes::transformed(mesh, cycle)), dx);
  ASSERT_EQ(cycled.size, (std::array<int, 3>{v.size[2], v.size[0], v.size[1]}));
  std::size_t different = 0;
  for (int k = 0; k < v.size[2]; ++k) {
    for (int j = 0; j < v.size[1]; ++j) {
      for (int i = 0; i < v.size[0]; ++i) different += v.is_fluid(i, j, k) != cycled.is_fluid(k, i, j);
    }
  }
  EXPECT_EQ(different, 0u);
}

TEST(Voxelize, AMirroredCopyIsTheMirrorImage) {
  // A box of a whole number of cells mirrors onto itself; the pattern inside must mirror too.
  const TriangleMesh mesh =
      shapes::joined(shapes::box({-1, -1, -1}, {1, 1, 1}),
                     shapes::turned(shapes::transformed(shapes::torus(0.5, 0.2, 30, 15), shapes::rotation())));
  const Eigen::Matrix3d mirror = Vec3(-1, 1, 1).asDiagonal();
  const Voxels v = voxelize(TriangleTree(mesh), 0.05);
  const Voxels m = voxelize(TriangleTree(shapes::transformed(mesh, mirror)), 0.05);
  ASSERT_EQ(v.size, m.size);
  std::size_t different = 0;
  for (int k = 0; k < v.size[2]; ++k) {
    for (int j = 0; j < v.size[1]; ++j) {
      for (int i = 0; i < v.size[0]; ++i) different += v.is_fluid(i, j, k) != m.is_fluid(v.size[0] - 1 - i, j, k);
    }
  }
  EXPECT_EQ(different, 0u);
}

TEST(Voxelize, OverlappingBodiesAreTheirUnionAndNestedTurnedOnesAreCavities) {
  const Voxels both = voxelize(
      TriangleTree(shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({0.5, 0, 0}, {1.5, 1, 1}))), 0.1);
  EXPECT_EQ(fluid_cells(both), 1500u);
  const Voxels hollow =
      voxelize(TriangleTree(shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}),
                                           shapes::turned(shapes::box({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7})))),
               0.1);
  EXPECT_EQ(fluid_cells(hollow), 1000u - 64u);
}

TEST(Voxelize, ASmallHoleOrATurnedFacetChangesNoCellAwayFromIt) {
  const TriangleMesh whole = shapes::transformed(shapes::sphere(1.0, 40), shapes::rotation());
  const Voxels expected = voxelize(TriangleTree(whole), 0.1);
  TriangleMesh hole = whole, flipped = whole;
  const Vec3 place = whole.corner(2000, 0);
  shapes::remove_triangle(hole, 2000);
  std::swap(flipped.triangles[2000][0], flipped.triangles[2000][1]);
  for (const TriangleMesh& damaged : {hole, flipped}) {
    const Voxels v = voxelize(TriangleTree(damaged), 0.1);
    ASSERT_EQ(v.size, expected.size);
    for (std::int64_t c = 0; c < v.index(0, 0, v.size[2]); ++c) {
      const auto [i, j, k] = v.place(c);
      if (v.is_fluid(i, j, k) == expected.is_fluid(i, j, k)) continue;
      // The facet is 0.08 wide: farther than two of it its solid angle is below 1/50 of a half space.
      EXPECT_LT((v.centre(i, j, k) - place).norm(), 0.16);
    }
  }
}

TEST(Voxelize, AnOpenSurfaceIsClassifiedByItsGeneralisedWindingNumber) {
  // A box without lid and with a turned facet: cell by cell as the definition says.
  TriangleMesh mesh = shapes::transformed(shapes::box({0, 0, 0}, {1, 1, 1}, 2), shapes::rotation());
  for (int t = static_cast<int>(mesh.triangles.size()); t-- > 0;) {
    if (mesh.solid[t] == 5) shapes::remove_triangle(mesh, t);
  }
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const TriangleTree tree(mesh);
  const Voxels v = voxelize(tree, 0.05);
  std::size_t open_air = 0;
  for (int k = 0; k < v.size[2]; ++k) {
    for (int j = 0; j < v.size[1]; ++j) {
      for (int i = 0; i < v.size[0]; ++i) {
        const double w = tree.winding_number(v.centre(i, j, k));
        if (std::abs(std::abs(w) - 0.5) < 0.02) continue;  // twice the error of a winding number
        ASSERT_EQ(v.is_fluid(i, j, k), std::abs(w) > 0.5) << w;
        open_air += std::abs(w) > 0.1 && std::abs(w) < 0.9;
      }
    }
  }
  EXPECT_GT(open_air, 1000u);
}

TEST(Voxelize, PeriodicDirectionsNeedAWholeNumberOfCellsAndTheErrorNamesTheNearestDx) {
  const TriangleTree tree(shapes::box({0, 0, 0}, {0.010, 0.010, 0.010}));
  VoxelizeOptions options;
  options.periodic = {true, false, false};
  EXPECT_EQ(voxelize(tree, 0.0005, options).size[0], 20);
  try {
    voxelize(tree, 0.0006, options);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("the nearest dx is 0.588235 mm"), std::string::npos)
        << e.what();  // 10 mm / 17
  }
}

TEST(Voxelize, SinglePrecisionCoordinatesDoNotAddACell) {
  TriangleMesh mesh = shapes::box({0, 0, 0}, {0.03, 0.007, 0.0035});
  for (auto& v : mesh.vertices) v = v.cast<float>().cast<double>();
  VoxelizeOptions options;
  options.periodic = {true, true, true};
  EXPECT_EQ(voxelize(TriangleTree(mesh), 0.0005, options).size, (std::array<int, 3>{60, 14, 7}));
}

class Openings : public ::testing::Test {
 protected:
  static std::vector<char> flags(const TriangleMesh& mesh, const std::vector<int>& solids) {
    std::vector<char> f(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < f.size(); ++t) f[t] = std::count(solids.begin(), solids.end(), mesh.solid[t]) > 0;
    return f;
  }
};

TEST_F(Openings, CellsThatNoOpeningReachesAreDroppedAndCounted) {
  const TriangleMesh mesh =
      shapes::joined(shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({2, 0, 0}, {3, 1, 1})),
                     shapes::box({4, 0, 0}, {4.5, 1, 1}));
  const TriangleTree tree(mesh);
  VoxelizeOptions options;
  options.openings = flags(mesh, {0, 1});  // x-min and x-max of the first box
  Pockets dropped;
  const Voxels v = voxelize(tree, 0.1, options, &dropped);
  EXPECT_EQ(fluid_cells(v), 1000u);
  EXPECT_EQ(dropped.count, 2u);
  EXPECT_EQ(dropped.cells, 1500u);
  ASSERT_EQ(dropped.where.size(), 2u);
  EXPECT_NEAR(dropped.where[0].x(), 2.05, 1e-9);  // the larger first
}

TEST_F(Openings, AnOpeningWithoutFluidCellsIsRefused) {
  const TriangleMesh mesh =
      shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({2, 0.5, 0.5}, {3, 0.501, 0.501}));
  VoxelizeOptions options;
  options.openings = flags(mesh, {6});
  EXPECT_THROW(voxelize(TriangleTree(mesh), 0.1, options), GeometryError);
}

// A slice one cell wide: its sides are as far from the cell beside the opening as the opening itself, and nearer than
// it in the narrower one.
TEST_F(Openings, AreFoundInASliceOneCellWide) {
  for (const double width : {0.1, 0.08}) {
    const TriangleTree tree(shapes::box({0, 0, 0}, {1.0, width, 0.5}));
    VoxelizeOptions options;
    options.periodic = {false, width == 0.1, false};
    for (const auto& t : tree.mesh().triangles) {
      bool flat = true;
      for (const int v : t) flat = flat && tree.mesh().vertices[v][0] == 0.0;
      options.openings.push_back(flat ? 1 : 0);
    }
    EXPECT_EQ(fluid_cells(voxelize(tree, 0.1, options)), 50u) << width;
  }
}

TEST(Voxelize, NonsenseIsRefused) {
  const TriangleTree tree(shapes::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_THROW(voxelize(tree, 0.0), std::invalid_argument);
  EXPECT_THROW(voxelize(tree, -1.0), std::invalid_argument);
  EXPECT_THROW(voxelize(tree, std::nan("")), std::invalid_argument);
  EXPECT_THROW(voxelize(tree, 1e-9), std::invalid_argument);
  VoxelizeOptions wrong;
  wrong.openings = {1};
  EXPECT_THROW(voxelize(tree, 0.1, wrong), std::invalid_argument);
}

TEST(VoxelReport, GapsWallsAreasAndVolumesAreThoseOfTheShape) {
  // Two channels 1 high, one of them stepping down to 0.4, with a wall of 0.05 between them.
  const TriangleMesh mesh =
      shapes::joined(shapes::step_duct(2, 4, 2, 1.0, 0.4), shapes::box({0, 0, -1.05}, {4, 2, -0.05}));
  const TriangleTree tree(mesh);
  const Patches patches = assign_patches(mesh, {});
  const Voxels v = voxelize(tree, 0.05);
  const VoxelReport report = voxel_report(tree, v, patches, {"inlet", "outlet", "x-min", "x-max"});
  EXPECT_NEAR(report.volume_stl, 2 * (2 * 1.0 + 2 * 0.4) + 4 * 2 * 1, 1e-9);
  EXPECT_NEAR(report.volume_voxels, report.volume_stl, report.volume_stl * 1e-9);  // every face is on a cell face
  EXPECT_NEAR(report.narrowest_gap, 0.4, 1e-6);
  EXPECT_NEAR(report.narrowest_gap_cells, 8.0, 1e-4);
  EXPECT_NEAR(report.recommended_dx, 0.05, 1e-6);
  EXPECT_NEAR(report.thinnest_wall, 0.05, 1e-6);
  EXPECT_NEAR(report.thinnest_wall_at.z(), -0.025, 1e-6);
  const int inlet = patches.find("inlet");
  EXPECT_NEAR(report.patches[inlet].area, 2.0, 1e-12);
  EXPECT_EQ(report.patches[inlet].triangles, 2u);
  EXPECT_TRUE(report.patches[inlet].opening);
  EXPECT_FALSE(report.patches[patches.find("wall")].opening);
}

}  // namespace
}  // namespace puffin::lbm::geometry
