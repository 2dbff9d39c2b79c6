// Shares of fluid in the cells that a surface cuts: against formulas, under symmetry, and where surfaces overlap.

#include "lbm/geometry/solid_fraction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lbm/geometry/surface_check.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

constexpr double rounding = 1e-9;  // stated by cut_cells

// Volume of the fluid: whole cells by their centre, cut cells by their share.
double volume(const Voxels& voxels, const std::vector<CutCell>& cut) {
  auto cells = static_cast<double>(voxels.cells());
  for (const CutCell& c : cut) {
    const auto [i, j, k] = voxels.place(c.cell);
    cells += c.fluid - voxels.is_fluid(i, j, k);
  }
  return cells * std::pow(voxels.dx, 3);
}

double relative_volume_error(const TriangleMesh& mesh, double dx) {
  const TriangleTree tree(mesh);
  const Voxels voxels = voxelize(tree, dx);
  return volume(voxels, cut_cells(tree, voxels)) / enclosed_volume(mesh) - 1.0;
}

TEST(SolidFraction, SharesAddUpToTheVolumeOfTheTrianglesWhateverTheirAngle) {
  // 1e-9 of a cell each, with random sign, over at most 1e4 cut cells and 1e4 full ones.
  EXPECT_NEAR(relative_volume_error(shapes::sphere(1.0, 20), 0.1), 0.0, 1e-9);
  EXPECT_NEAR(relative_volume_error(shapes::torus(1.0, 0.4, 30, 17), 0.07), 0.0, 1e-9);
  EXPECT_NEAR(relative_volume_error(shapes::transformed(shapes::box({0, 0, 0}, {1, 2, 1.5}), shapes::rotation()), 0.11),
              0.0, 1e-9);
  EXPECT_NEAR(relative_volume_error(shapes::step_duct(1.0, 3.0, 0.9, 1.0, 0.55), 0.0837), 0.0, 1e-9);
}

TEST(SolidFraction, ATiltedPlaneCutsACellInTheShareOfTheFormula) {
  // The half-space x + 2y + 3z < s below the cube's centre, as a large tetrahedron-like box turned so that its top face
  // has that normal. A plane n.x = a (n > 0) cuts from the unit cube the volume
  //   [a^3 - sum_i max(a - n_i, 0)^3 + sum_i max(a - n_j - n_k, 0)^3] / (6 n1 n2 n3)   (Scardovelli & Zaleski 2000).
  const Vec3 n(1.0, 2.0, 3.0);
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), n).toRotationMatrix();
  for (const double a : {0.7, 1.9, 2.6, 3.3, 4.4, 5.5}) {
    const double top = a / n.norm();
    const TriangleMesh mesh = shapes::transformed(shapes::box({-9, -9, top - 9.0}, {9, 9, top}), turn);
    const TriangleTree tree(mesh);
    Voxels cell;
    cell.dx = 1.0;
    cell.origin = Vec3::Constant(0.5);
    cell.size = {1, 1, 1};
    cell.fill([](int, int, int) { return true; });
    double expected = a * a * a;
    for (int i = 0; i < 3; ++i) {
      expected -= std::pow(std::max(a - n[i], 0.0), 3);
      expected += std::pow(std::max(a - n[(i + 1) % 3] - n[(i + 2) % 3], 0.0), 3);
    }
    expected /= 6.0 * n.prod();
    const auto cut = cut_cells(tree, cell);
    ASSERT_EQ(cut.size(), 1u) << a;
    EXPECT_NEAR(cut[0].fluid, expected, rounding) << a;
    EXPECT_NEAR(cut[0].solid(), 1.0 - expected, rounding) << a;
  }
}

TEST(SolidFraction, AFlushBoxCutsNoCell) {
  const TriangleMesh mesh = shapes::box({0, 0, 0}, {1.0, 0.5, 0.25}, 3);
  const TriangleTree tree(mesh);
  EXPECT_TRUE(cut_cells(tree, voxelize(tree, 0.125)).empty());
}

TEST(SolidFraction, AMirroredCopyHasTheMirroredShares) {
  const TriangleMesh mesh = shapes::torus(1.0, 0.45, 23, 11);
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(0, 0) = -1.0;
  const TriangleTree tree(mesh), mirrored(shapes::transformed(mesh, mirror));
  Voxels box = voxelize(tree, 0.125);
  // The same grid for both: symmetric about x = 0.
  box.origin = Vec3(-12.5 * 0.125, box.origin.y(), box.origin.z());
  box.size[0] = 26;
  box.fill([&](int i, int j, int k) { return tree.inside(box.centre(i, j, k)); });
  Voxels other = box;
  other.fill([&](int i, int j, int k) { return box.is_fluid(box.size[0] - 1 - i, j, k); });
  const auto cut = cut_cells(tree, box), reflected = cut_cells(mirrored, other);
  ASSERT_GT(cut.size(), 500u);
  std::vector<double> share, image;
  for (std::int64_t c = 0; c < box.index(0, 0, box.size[2]); ++c) {
    const auto [i, j, k] = box.place(c);
    share.push_back(box.is_fluid(i, j, k));
    image.push_back(other.is_fluid(i, j, k));
  }
  for (const CutCell& c : cut) share[static_cast<std::size_t>(c.cell)] = c.fluid;
  for (const CutCell& c : reflected) image[static_cast<std::size_t>(c.cell)] = c.fluid;
  double worst = 0.0;
  for (std::int64_t c = 0; c < static_cast<std::int64_t>(share.size()); ++c) {
    const std::int64_t i = c % box.size[0];
    worst = std::max(worst, std::abs(share[c] - image[c - i + box.size[0] - 1 - i]));
  }
  EXPECT_LT(worst, 2.0 * rounding);
}

TEST(SolidFraction, AnOpeningThatCutsACellIsNoWall) {
  // A duct whose far end, the opening, lies 0.3 dx before a cell's end: its cells have 0.7 fluid, 0.3 beyond, no solid
  // but what the side walls (flush) leave: none.
  const TriangleMesh mesh = shapes::box({0, 0, 0}, {2.07, 0.3, 0.4});
  const TriangleTree tree(mesh);
  const Voxels voxels = voxelize(tree, 0.1);
  std::vector<char> openings;
  for (const int s : mesh.solid) openings.push_back(mesh.solids[s] == "x-max");
  const auto cut = cut_cells(tree, voxels, openings);
  ASSERT_EQ(cut.size(), 12u);
  for (const CutCell& c : cut) {
    EXPECT_NEAR(c.fluid, 0.7, 1e-6);  // shapes are welded within 1e-9 of 2
    EXPECT_NEAR(c.beyond, 0.3, 1e-6);
    EXPECT_NEAR(c.solid(), 0.0, 1e-6);
  }
  for (const CutCell& c : cut_cells(tree, voxels)) EXPECT_NEAR(c.solid(), 0.3, 1e-6);
}

TEST(SolidFraction, OverlappingBodiesAreTheirUnionToOneThousandth) {
  // Two boxes that cross; the union by inclusion and exclusion, cell by cell.
  const Vec3 a0(0.0, 0.0, 0.0), a1(1.03, 1.07, 0.91), b0(0.37, 0.46, 0.23), b1(1.41, 0.83, 1.33);
  const TriangleMesh mesh = shapes::joined(shapes::box(a0, a1), shapes::box(b0, b1));
  const TriangleTree tree(mesh);
  const Voxels voxels = voxelize(tree, 0.1);
  const auto share = [&](const Vec3& low, const Vec3& high, const Vec3& centre) {
    const Vec3 l = low.cwiseMax(centre - Vec3::Constant(0.05)), h = high.cwiseMin(centre + Vec3::Constant(0.05));
    return (h - l).cwiseMax(0.0).prod() / 1e-3;
  };
  std::map<std::int64_t, double> found;
  for (const CutCell& c : cut_cells(tree, voxels)) found[c.cell] = c.fluid;
  double worst = 0.0;
  for (int k = 0; k < voxels.size[2]; ++k)
    for (int j = 0; j < voxels.size[1]; ++j)
      for (int i = 0; i < voxels.size[0]; ++i) {
        const Vec3 p = voxels.centre(i, j, k);
        const double expected = share(a0, a1, p) + share(b0, b1, p) - share(a0.cwiseMax(b0), a1.cwiseMin(b1), p);
        const auto at = found.find(voxels.index(i, j, k));
        const double is = at == found.end() ? static_cast<double>(voxels.is_fluid(i, j, k)) : at->second;
        bool fluid_near = false;
        for (int n = 0; n < 27; ++n) fluid_near |= voxels.is_fluid(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1);
        if (fluid_near) worst = std::max(worst, std::abs(is - expected));
      }
  EXPECT_LT(worst, 1e-3);
}

TEST(SolidFraction, DroppedPocketsHaveNoCutCells) {
  const TriangleMesh mesh = shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::sphere(0.3, 8, {3, 0.5, 0.5}));
  const TriangleTree tree(mesh);
  VoxelizeOptions options;
  for (const int s : mesh.solid) options.openings.push_back(s == 0);
  const Voxels voxels = voxelize(tree, 0.1, options);
  for (const CutCell& c : cut_cells(tree, voxels)) EXPECT_LT(c.cell % voxels.size[0], 12);
}

TEST(SolidFraction, OpenSurfacesAndForeignOpeningsAreRefused) {
  TriangleMesh open = shapes::box({0, 0, 0}, {1, 1, 1});
  const TriangleTree closed_tree(open);
  EXPECT_THROW(cut_cells(closed_tree, voxelize(closed_tree, 0.3), std::vector<char>(5)), std::invalid_argument);
  shapes::remove_triangle(open, 3);
  const TriangleTree tree(open);
  EXPECT_THROW(cut_cells(tree, voxelize(tree, 0.3)), GeometryError);
}

}  // namespace
}  // namespace puffin::lbm::geometry
