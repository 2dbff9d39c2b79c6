#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/output/picture/streamlines.hpp"

namespace puffin::output {
namespace {

/// 40 x 40 x 3 cells of 0.1; a solid body that turns around the middle with 1 rad/s, or a stream along x.
FieldFrame field_of(bool turns) {
  FieldFrame f;
  f.dx = 0.1;
  f.size = {40, 40, 3};
  f.origin = {-1.95, -1.95, -0.1};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) {
        const double x = f.origin[0] + 0.1 * i, y = f.origin[1] + 0.1 * j;
        f.fluid.push_back(1);
        f.velocity.push_back(static_cast<float>(turns ? -y : 2.0));
        f.velocity.push_back(static_cast<float>(turns ? x : 0.0));
        f.velocity.push_back(0.0F);
      }
  return f;
}

TEST(Streamline, StaysOnItsCircleInASolidBody) {
  // The interpolation is exact for a linear field. The midpoint rule with steps h = 0.04 along a circle of radius 1
  // misses the arc by h^3/24 sideways a step, at most outward: over 2 pi/h steps 2 pi h^2/24 = 4.2e-4 a turn. 1.5 x 12
  // m of length are 3 turns each way at most; velocities are floats, 1e-7.
  const Streamline line = trace(field_of(true), Vec3(1.0, 0.0, 0.0), 1e-3, 2.0 * std::numbers::pi);
  ASSERT_GT(line.size(), 300u);  // one turn each way in steps of 0.04: 2 x 157 points
  for (const StreamPoint& p : line) {
    EXPECT_NEAR(p.place.norm(), 1.0, 4.5e-4);
    EXPECT_NEAR(p.speed, p.place.norm(), 1e-6);
  }
}

TEST(Streamline, EndsAtTheWall) {
  FieldFrame f = field_of(false);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 30; i < 40; ++i) f.fluid[i + 40 * (j + 40 * k)] = 0;
  const Streamline line = trace(f, Vec3(0.0, 0.0, 0.0), 1e-3, 100.0);
  ASSERT_FALSE(line.empty());
  EXPECT_LT(line.back().place.x(), 1.0);  // cells from x = 1 on are solid: it ends within a step of 0.04 before
  EXPECT_GT(line.back().place.x(), 1.0 - 2 * 0.04);
  EXPECT_LT(line.front().place.x(), -2.0 + 2 * 0.04);
  for (const StreamPoint& p : line) EXPECT_NEAR(p.place.y(), 0.0, 1e-12);
}

TEST(Streamlines, FillTheFluidAndKeepApart) {
  // Parallel lines through blocks of 0.4: 10 x 1 blocks across, one line each; a second in the same block is refused.
  const auto lines = even_streamlines(field_of(false), 0.4);
  EXPECT_GE(lines.size(), 9u);
  EXPECT_LE(lines.size(), 11u);
}

TEST(Streamlines, OfAirAtRestThereAreNone) {
  FieldFrame f = field_of(false);
  for (float& v : f.velocity) v = 0.0F;
  EXPECT_TRUE(even_streamlines(f, 0.4).empty());
  f.velocity.clear();
  EXPECT_THROW(even_streamlines(f, 0.4), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::output
