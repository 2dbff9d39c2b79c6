// Where the lattice lies within a surface.

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/geometry/voxelize.hpp"
#include "tests/lbm/geometry/disagreements.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm::geometry {
namespace {

// A duct of 3 x 0.5 with a pocket of 1 x 0.5 that is 0.53 deep, in cells of 0.1: the pocket's floor is the low end and
// would lie on faces of cells, the duct's floor and ceiling three tenths of a cell off. They are the larger ones.
TEST(Voxelize, MostOfTheFlatFacesAreFacesOfCells) {
  const Eigen::Matrix3d flip = Vec3(1, 1, -1).asDiagonal();
  const TriangleTree tree(shapes::transformed(shapes::step_duct(1.0, 3.0, 0.5, 1.03, 0.5), flip, {0, 0, 1.03}));
  const Voxels v = voxelize(tree, 0.1);
  const auto above_face = [&](double z) {
    const double place = (z - v.origin[2]) / v.dx + 0.5;
    return place - std::round(place);
  };
  EXPECT_NEAR(above_face(1.03), 0.0, 1e-12);  // ceiling
  EXPECT_NEAR(above_face(0.53), 0.0, 1e-12);  // floor of the duct
  EXPECT_LE(v.origin[2] - 0.5 * v.dx, 0.0);
  EXPECT_EQ(v.size, (std::array<int, 3>{30, 5, 11}));
  EXPECT_EQ(disagreements(tree, v, 1e-9), 0u);
  // What has to be flush decides alone: the floor of the pocket.
  VoxelizeOptions options;
  options.flush.assign(tree.mesh().triangles.size(), 0);
  for (std::size_t t = 0; t < options.flush.size(); ++t)
    options.flush[t] = std::abs(tree.mesh().area_vector(static_cast<int>(t)).normalized()[2]) > 0.5 &&
                       tree.mesh().corner(static_cast<int>(t), 0)[2] < 1e-9;
  EXPECT_NEAR(voxelize(tree, 0.1, options).origin[2], 0.05, 1e-12);
  // Along a periodic direction the ends are what matters.
  options.periodic[2] = true;
  EXPECT_THROW(voxelize(tree, 0.1, options), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::lbm::geometry
