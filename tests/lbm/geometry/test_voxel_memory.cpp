// The memory of cells goes with the cells, not with their bounding box. A program of its own: the peak of a process
// never falls.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "lbm/geometry/voxel_errors.hpp"
#include "lbm/geometry/voxelize.hpp"
#include "lbm/rows.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool plain_memory = false;
#else
constexpr bool plain_memory = true;
#endif

double peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

TEST(VoxelMemory, OfAThinRodAcrossAHugeBoxGoesWithItsCellsAndRows) {
  if (!plain_memory) GTEST_SKIP() << "sanitizers keep freed memory";
  // A rod along the diagonal of a cube: the cube's edge is 600 cells, the rod 8 x 8.
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), Vec3::Ones()).toRotationMatrix();
  const TriangleMesh mesh = shapes::transformed(shapes::box({0, -4, -4}, {1000, 4, 4}, 40), turn);
  const TriangleTree tree(mesh);
  VoxelizeOptions options;
  for (const int s : mesh.solid) options.openings.push_back(mesh.solids[s] == "x-min" || mesh.solids[s] == "x-max");
  const double before = peak();
  const Voxels voxels = voxelize(tree, 1.0, options);
  EXPECT_EQ(hidden_faces(tree, voxels, options.openings).buried, 0u);
  const Rows rows(voxels);
  const double taken = peak() - before, box = static_cast<double>(voxels.index(0, 0, voxels.size[2]));
  const auto cells = static_cast<double>(voxels.cells());
  ASSERT_GT(box, 2000.0 * cells);
  // A row of the box: crossings, voxels and the lattice's rows keep an 8-byte place each, some twice while they are
  // counted: 48. A cell: of the lattice's 13 bytes a slot, in runs 11 cells long with ghosts at their ends and in four
  // rows around, at most 8 slots, doubled while the arrays grow; with runs, marks and crossings below 400.
  EXPECT_LT(taken, 48.0 * static_cast<double>(voxels.rows()) + 400.0 * cells + 4e6);  // 4 MB: threads, allocator
  EXPECT_LT(taken, 0.25 * box);  // one byte a cell of the box would be four times as much
}

}  // namespace
}  // namespace puffin::lbm::geometry
