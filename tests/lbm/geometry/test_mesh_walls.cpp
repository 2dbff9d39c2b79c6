// The walls that carriers meet: triangles less openings.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "coupling/mesh_walls.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::coupling {
namespace {

using lbm::geometry::TriangleMesh;
using lbm::geometry::TriangleTree;
using lbm::geometry::Vec3;
namespace shapes = lbm::geometry::shapes;

class DuctWalls : public ::testing::Test {
 protected:
  DuctWalls() {
    for (std::size_t t = 0; t < tree_->mesh().triangles.size(); ++t) {
      if (tree_->mesh().solid[t] < 2) openings_.push_back(static_cast<int>(t));
    }
    walls_ = std::make_unique<MeshWalls>(tree_, openings_);
  }
  // Inlet at x = 0, 4 mm high; step at 10 mm down to 2 mm; outlet at 20 mm; 5 mm wide.
  std::shared_ptr<const TriangleTree> tree_ =
      std::make_shared<TriangleTree>(shapes::step_duct(0.01, 0.02, 0.005, 0.004, 0.002));
  std::vector<int> openings_;
  std::unique_ptr<MeshWalls> walls_;
  std::vector<dem::WallTouch> touches_;
};

TEST_F(DuctWalls, TouchesWallsAndNoOpenings) {
  walls_->near({0.0001, 0.0025, 0.002}, 2e-4, touches_);
  EXPECT_TRUE(touches_.empty());
  walls_->near({0.0001, 0.0001, 0.002}, 2e-4, touches_);
  ASSERT_EQ(touches_.size(), 1u);
  EXPECT_NEAR(touches_[0].distance, 1e-4, 1e-15);
  EXPECT_LT((touches_[0].point - Vec3(0.0001, 0, 0.002)).norm(), 1e-15);
  walls_->near({0.0099, 0.0001, 0.0039}, 2e-4, touches_);
  EXPECT_EQ(touches_.size(), 3u);
}

// Below the low ceiling, 0.1 mm from it and 0.5 mm behind its edge: what is not on its plane is the step's face, of
// which the edge is nearest. In the inner corner before the step both walls are planes that do not end within reach.
TEST_F(DuctWalls, SayHowFarTheRestOfTheWallIs) {
  const double edge = std::hypot(5e-4, 1e-4);
  const dem::RestOfWall beside = walls_->near({0.0105, 0.0025, 0.0019}, 1e-3, touches_);
  ASSERT_EQ(touches_.size(), 1u);
  EXPECT_NEAR(beside.distance, edge, 1e-12);
  EXPECT_NEAR(beside.lead, edge - 1e-4, 1e-12);
  const dem::RestOfWall corner = walls_->near({0.0099, 0.0025, 0.0039}, 2e-4, touches_);
  ASSERT_EQ(touches_.size(), 2u);
  EXPECT_EQ(corner.distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(corner.lead, std::numeric_limits<double>::infinity());
}

TEST_F(DuctWalls, ClearanceIsALowerBoundOfTheDistanceToTheWallsAndTightWithinAGridStep) {
  TriangleMesh wall = tree_->mesh();
  for (int t = static_cast<int>(wall.triangles.size()); t-- > 0;) {
    if (wall.solid[t] < 2) shapes::remove_triangle(wall, t);
  }
  const TriangleTree exact(wall);
  std::mt19937 engine(1);
  std::uniform_real_distribution<> x(-0.001, 0.021), y(-0.001, 0.006), z(-0.001, 0.005);
  // Half a million nodes in 400 mm^3: 0.093 mm apart; the nearest node is at most sqrt(3)/2 of that away, and the bound
  // loses twice that way. Outside the grid it is only a bound.
  for (int n = 0; n < 20000; ++n) {
    const Vec3 p(x(engine), y(engine), z(engine));
    const double distance = exact.closest(p).distance, bound = walls_->clearance(p, 1.0);
    ASSERT_LE(bound, distance);
    const bool in_box = (p.array() >= tree_->min().array()).all() && (p.array() <= tree_->max().array()).all();
    if (in_box) {
      ASSERT_GE(bound, distance - 1.733 * 0.094e-3);
    }
    ASSERT_LE(walls_->clearance(p, 1e-4), 1e-4);
  }
}

TEST_F(DuctWalls, InsideMeansInTheDuctOrBeyondAnOpening) {
  EXPECT_TRUE(walls_->inside({0.005, 0.002, 0.003}));
  EXPECT_TRUE(walls_->inside({0.0199, 0.002, 0.0019}));
  EXPECT_TRUE(walls_->inside({0.0201, 0.002, 0.001}));    // left by the outlet
  EXPECT_TRUE(walls_->inside({-0.0001, 0.002, 0.0039}));  // left by the inlet
  EXPECT_FALSE(walls_->inside({0.005, -1e-5, 0.003}));    // in the wall
  EXPECT_FALSE(walls_->inside({0.0101, 0.002, 0.003}));   // behind the step
  const auto outlet = walls_->beyond_opening({0.0201, 0.002, 0.001});
  ASSERT_TRUE(outlet);
  EXPECT_EQ(tree_->mesh().solids[tree_->mesh().solid[*outlet]], "outlet");
  EXPECT_FALSE(walls_->beyond_opening({0.005, 0.002, 0.003}));
  EXPECT_FALSE(walls_->beyond_opening({0.0101, 0.002, 0.003}));
}

// Under the outlet's lower edge and beside the inlet's upper one a wall is as near as the opening.
TEST_F(DuctWalls, BeyondAnEdgeOfWallAndOpeningIsBeyondTheOpening) {
  for (const auto& [place, solid] :
       {std::pair{Vec3(0.0201, 0.0025, -0.0002), "outlet"}, {Vec3(-0.0002, 0.0025, 0.0043), "inlet"}}) {
    const auto opening = walls_->beyond_opening(place);
    ASSERT_TRUE(opening) << solid;
    EXPECT_EQ(tree_->mesh().solids[tree_->mesh().solid[*opening]], solid);
    EXPECT_TRUE(walls_->inside(place)) << solid;
    EXPECT_FALSE(walls_->encloses(place)) << solid;
  }
}

// The way decides: what it crosses first, not what is nearest to its end.
TEST_F(DuctWalls, TheWayOutLeadsThroughTheFirstTriangleThatItCrosses) {
  const Vec3 within(0.0198, 0.0025, 0.0005);
  const auto outlet = walls_->left_through(within, {0.0203, 0.0025, -0.0002});  // crosses x = 20 mm at z = 0.22 mm
  ASSERT_TRUE(outlet);
  EXPECT_EQ(tree_->mesh().solids[tree_->mesh().solid[*outlet]], "outlet");
  EXPECT_FALSE(walls_->left_through(within, {0.0199, 0.0025, 0.001}));    // still inside
  EXPECT_FALSE(walls_->left_through(within, {0.0201, 0.0025, -0.0015}));  // z = 0 at x = 19.875 mm: through the floor
  // Through the floor, and on to where the outlet is nearest.
  const Vec3 under(0.0199, 0.0025, -0.0001), behind(0.0203, 0.0025, 0.001);
  EXPECT_FALSE(walls_->left_through(within, under));
  EXPECT_TRUE(walls_->beyond_opening(behind));
  EXPECT_FALSE(walls_->left_through({0.0202, 0.0025, -0.0001}, behind));  // outside all the way
}

TEST_F(DuctWalls, InsideAgreesWithTheWindingNumberEverywhere) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<> x(0.0, 0.02), y(0.0, 0.005), z(-0.001, 0.005);
  const MeshWalls closed(tree_);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 p(x(engine), y(engine), z(engine));
    ASSERT_EQ(closed.inside(p), tree_->inside(p));
  }
}

TEST(MeshWalls, ACurvedWallOfFacetsPushesOnce) {
  // Inside a fine torus: near the wall a sphere feels one contact wherever it is, although two facets may be in reach.
  const double ring = 0.02, tube = 0.006;
  const auto tree =
      std::make_shared<TriangleTree>(shapes::transformed(shapes::torus(ring, tube, 120, 60), shapes::rotation()));
  const MeshWalls walls(tree);
  std::mt19937 engine(3);
  std::uniform_real_distribution<> angle(0.0, 6.28);
  std::vector<dem::WallTouch> touches;
  for (int n = 0; n < 5000; ++n) {
    const double a = angle(engine), b = angle(engine), r = ring + (tube - 1e-4) * std::cos(b);
    walls.near(shapes::rotation() * Vec3(r * std::cos(a), r * std::sin(a), (tube - 1e-4) * std::sin(b)), 1.2e-4,
               touches);
    ASSERT_EQ(touches.size(), 1u);
  }
}

TEST(MeshWalls, NonsenseIsRefused) {
  EXPECT_THROW(MeshWalls(nullptr), std::invalid_argument);
  EXPECT_THROW(MeshWalls(std::make_shared<TriangleTree>(shapes::box({0, 0, 0}, {1, 1, 1})), {12}),
               std::invalid_argument);
}

}  // namespace
}  // namespace puffin::coupling
