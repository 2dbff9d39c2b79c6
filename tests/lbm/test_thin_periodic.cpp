// Periodic directions of any thickness, down to one cell, in any combination.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/lbm/box_scene.hpp"

namespace puffin::lbm::test {
namespace {

using geometry::Vec3;

/// A flow that does not depend on the coordinate `axis`: the velocities of the first layer after some steps.
std::vector<Vec3> flow(int axis, int thickness, bool walls) {
  Vec3 length(10, 10, 10);
  length[axis] = thickness;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::array<Boundary, 6> faces;
  faces.fill(periodic());
  if (walls) faces[2 * a] = faces[2 * a + 1] = wall();
  BoxScene scene = make_box(length, 1.0, faces);
  AirOptions options;
  options.smagorinsky = 0.0;
  options.double_precision = true;
  Air air = make_air(scene, options);
  set_cells(
      [&](const Vec3& x) {
        InitialCell cell;
        cell.velocity[a] = 0.05 * std::sin(0.2 * std::numbers::pi * x[b]);
        cell.velocity[b] = 0.04 * std::cos(0.2 * std::numbers::pi * x[a]);
        cell.velocity[axis] = 0.03 * std::sin(0.2 * std::numbers::pi * x[a]);
        return cell;
      },
      air);
  const Drive drive = at_rest(air);
  for (int t = 0; t < 61; ++t) step(air, 0.55, drive);
  std::vector<Vec3> u;
  for (const Run& run : air.rows.runs())
    for (int n = 0; n < run.count; ++n) {
      const std::ptrdiff_t s = run.first + n;
      if (air.rows.cell(s)[axis] != 0) continue;
      const auto m = moments_at(air, s);
      u.emplace_back(m.ux, m.uy, m.uz);
    }
  return u;
}

// The same arithmetic in every layer; lanes of a vector may contract it differently: 61 steps of 1e-16.
TEST(ThinPeriodic, OneCellIsAsGoodAsManyInEveryDirection) {
  for (const bool walls : {false, true})
    for (int axis = 0; axis < 3; ++axis) {
      const auto thick = flow(axis, 4, walls);
      for (const int cells : {1, 2}) {
        const auto thin = flow(axis, cells, walls);
        ASSERT_EQ(thin.size(), thick.size());
        double speed = 0.0;
        for (std::size_t n = 0; n < thin.size(); ++n) {
          EXPECT_LT((thin[n] - thick[n]).norm(), 1e-14) << "axis " << axis << ", cells " << cells;
          speed = std::max(speed, thin[n].norm());
        }
        EXPECT_GT(speed, 0.01);
      }
    }
}

// A slice of 10 x 10 cells between walls, periodic across: of the ten directions across it two stay in the column and
// eight lean by a cell, so 2 x 100 + 8 x 90 populations cross. They are copied by rows: ten rows in the six directions
// that do not lean across rows, nine in the other four.
TEST(ThinPeriodic, FacesAreCrossedRowByRow) {
  std::array<Boundary, 6> faces;
  faces.fill(wall());
  faces[2] = faces[3] = periodic();
  BoxScene scene = make_box(Vec3(10, 1, 10), 1.0, faces);
  const Air air = make_air(scene, {});
  std::ptrdiff_t crossing = 0;
  for (std::size_t k = 0; k < air.links.images.size(); k += 2)
    crossing += air.links.images[k + 1].ghost - air.links.images[k].ghost + 1;
  EXPECT_EQ(crossing, 2 * 100 + 8 * 90);
  EXPECT_EQ(air.links.images.size() / 2, 6u * 10u + 4u * 9u);
}

}  // namespace
}  // namespace puffin::lbm::test
