// Cut links where cell centres lie in the plane of a wall: a centre belongs to the wall's +x, +y, +z side, and its
// links must see the same.

#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <set>

#include "lbm/geometry/voxelize.hpp"
#include "lbm/links.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::lbm {
namespace {

namespace shapes = geometry::shapes;
using geometry::TriangleMesh;
using geometry::Vec3;

struct Cut {
  Rows rows;
  Links links;
};

Cut cut(const TriangleMesh& mesh, double dx) {
  Cut c{Rows(geometry::voxelize(geometry::TriangleTree(mesh), dx)), {}};
  LinkGeometry surface;
  surface.mesh = &mesh;
  surface.patch_of_triangle.assign(mesh.triangles.size(), 0);
  surface.boundaries.resize(1);
  c.links = build_links(c.rows, surface, WallScheme::bouzidi);
  return c;
}

/// Which directions of which cells end at a wall.
std::map<std::array<int, 3>, std::uint32_t> walls_of(const Cut& c) {
  std::map<std::array<int, 3>, std::uint32_t> walls;
  for (const WallRun& w : c.links.walls)
    for (int n = 0; n < w.count; ++n) walls[c.rows.cell(w.first + n)] = w.directions;
  return walls;
}

/// Links with a wall between two cells of the fluid: cell and direction.
std::set<std::array<int, 4>> thin_of(const Cut& c) {
  std::set<std::array<int, 4>> thin;
  for (const auto& link : c.links.thin) {
    const auto cell = c.rows.cell(link.slot);
    thin.insert({cell[0], cell[1], cell[2], link.direction});
  }
  return thin;
}

const Eigen::Matrix3d half_turn = Vec3(-1, 1, -1).asDiagonal();  // about y: low walls become high ones

// A duct whose ceiling steps down: planes x = 4 + more, z = 2 + more are inner walls.
TriangleMesh step(double more, bool turned) {
  const TriangleMesh mesh = shapes::step_duct(4.0 + more, 9.0, 3.0, 5.0, 2.0 + more);
  return turned ? shapes::transformed(mesh, half_turn) : mesh;
}

TEST(Links, CentresInTheInnerPlanesOfAStepHaveTheLinksOfTheirSideOfTheWall) {
  for (const bool turned : {false, true}) {
    // Centres at 0.5, 1.5, ... from the low corner; the planes pass through them. In the other the walls lie a
    // thousandth of a cell from the centres, on the side where these belong: a centre in the plane of a wall goes with
    // +x and +z, which is the solid of the step and the fluid of the one turned round.
    const Cut in_plane = cut(step(0.5, turned), 1.0), beside = cut(step(0.5 + (turned ? 1e-3 : -1e-3), turned), 1.0);
    ASSERT_EQ(in_plane.rows.active_cells(), beside.rows.active_cells()) << turned;
    // Diagonals past the edge of the step cross its solid from fluid to fluid, and nothing else does.
    EXPECT_EQ(thin_of(in_plane), thin_of(beside)) << turned;
    EXPECT_EQ(in_plane.links.missed, 0u) << turned;
    EXPECT_EQ(walls_of(in_plane), walls_of(beside)) << turned;
  }
}

// A cube whose faces are faces of cells: diagonals between fluid cells touch its twelve edges and pass. Moved aside, as
// all links are, those beside half of the edges go through it; the cube had a side force of 7 % of its drag.
TEST(Links, DiagonalsThatTouchTheEdgesOfACubePassOnEverySide) {
  const TriangleMesh room = shapes::box(Vec3(0, 0, 0), Vec3(10, 10, 10)),
                     cube = shapes::turned(shapes::box(Vec3(3, 3, 3), Vec3(7, 7, 7)));
  const Cut c = cut(shapes::joined(room, cube), 1.0);
  ASSERT_EQ(c.rows.active_cells(), 936u);
  EXPECT_TRUE(c.links.thin.empty());
}

TEST(Links, CentresInAnInclinedWallHaveNoLinksThroughIt) {
  // x + z < 6 in a prism 3 wide: the hypotenuse passes through the centres (i + 1/2) + (k + 1/2) = 6.
  TriangleMesh prism;
  prism.vertices = {{0, 0, 0}, {6, 0, 0}, {0, 0, 6}, {0, 3, 0}, {6, 3, 0}, {0, 3, 6}};
  prism.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}};
  prism.solid.assign(prism.triangles.size(), 0);
  prism.solids = {"wall"};
  ASSERT_GT(geometry::TriangleTree(prism).winding_number({1, 1, 1}), 0.9);
  for (const bool turned : {false, true}) {
    const Cut c = cut(turned ? shapes::transformed(prism, half_turn) : prism, 1.0);
    // Per layer 1 + 2 + ... + 5 centres lie in the open triangle, and 6 in the hypotenuse: fluid where it faces +x, +z.
    EXPECT_EQ(c.rows.active_cells(), turned ? 3u * 21u : 3u * 15u);
    EXPECT_TRUE(c.links.thin.empty()) << turned;
    EXPECT_EQ(c.links.missed, 0u) << turned;
  }
}

TEST(Links, TheDistanceIsThatOfTheCentreNotOfThePlaceMovedAside) {
  // A box of 3 x 3 x 3.4 cells: its ceiling lies 0.9 of a link above the uppermost centres, the floor 0.5 below.
  const Cut c = cut(shapes::box({0, 0, 0}, {3, 3, 3.4}), 1.0);
  int ceiling = 0;
  for (const WallRun& w : c.links.walls)
    for (int n = 0; n < w.count; ++n) {
      if (c.rows.cell(w.first + n) != (std::array<int, 3>{1, 1, 2})) continue;
      ASSERT_EQ(std::popcount(w.directions), 5);  // the middle of a layer: up, and the four diagonals up
      for (int k = 0; k < 5; ++k)
        // q >= 1/2 interpolates with weight 1 - 1/(2q); single precision rounds at 6e-8.
        EXPECT_NEAR(c.links.partner[w.coefficient + static_cast<std::size_t>(k * w.count + n)], 1.0 - 1.0 / 1.8, 1e-7);
      ++ceiling;
    }
  EXPECT_EQ(ceiling, 1);
}

}  // namespace
}  // namespace puffin::lbm
