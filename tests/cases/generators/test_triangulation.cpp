// The parts below the generators: polygons with holes, plan outlines, subdivision.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/generators/ear_clipping.hpp"
#include "cases/generators/faces.hpp"
#include "cases/generators/outline.hpp"
#include "cases/generators/surface.hpp"

namespace puffin::cases::generators {
namespace {

constexpr double pi = std::numbers::pi;

double area(const std::vector<Vec2>& p, const std::vector<std::array<int, 3>>& triangles) {
  double sum = 0.0;
  for (const auto& t : triangles) {
    const Vec2 u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]];
    const double one = 0.5 * (u.x() * v.y() - u.y() * v.x());
    EXPECT_GT(one, 0.0);
    sum += one;
  }
  return sum;
}

TEST(EarClipping, covers_a_square_with_corners_inside_its_sides) {
  const std::vector<Vec2> p = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  const auto triangles = triangulate(p, {{0, 1, 2, 3, 4, 5, 6, 7}});
  EXPECT_EQ(triangles.size(), 6U);  // corners - 2: every corner used, none left hanging
  EXPECT_DOUBLE_EQ(area(p, triangles), 4.0);
}

TEST(EarClipping, leaves_two_holes_open) {
  const std::vector<Vec2> p = {{0, 0}, {6, 0}, {6, 3}, {0, 3}, {1, 1}, {1, 2},
                               {2, 2}, {2, 1}, {4, 1}, {4, 2}, {5, 2}, {5, 1}};
  const auto triangles = triangulate(p, {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}});
  EXPECT_EQ(triangles.size(), 14U);  // corners + 2 holes - 2
  EXPECT_NEAR(area(p, triangles), 16.0, 1e-12);
}

TEST(EarClipping, refuses_a_polygon_that_crosses_itself) {
  const std::vector<Vec2> p = {{0, 0}, {2, 2}, {2, 0}, {0, 1}, {1, 3}};
  EXPECT_THROW(triangulate(p, {{0, 1, 2, 3, 4}}), std::logic_error);
}

TEST(Outline, of_a_mitred_path_has_the_area_of_its_legs) {
  const auto plan = outline({{10, 2, pi / 2}, {8, 3, -pi / 2}, {7, 1, 0}}, 0.0, 1.0);
  EXPECT_NEAR(plan.area(), 10 * 2 + 8 * 3 + 7 * 1, 1e-12);
  EXPECT_NEAR((plan.end - Vec2(17, 8)).norm(), 0.0, 1e-12);
}

TEST(Outline, of_a_rounded_bend_is_concentric_between_equal_legs) {
  // Corners of both arcs lie on circles of radius 1 and 1 + 2 around the same centre (9, 1 + 1 + ...).
  const auto plan = outline({{10, 2, pi / 2}, {10, 2, 0}}, 1.0, 0.1);
  const Vec2 centre(10 - 2, 2);  // the crossing of the centre lines, less inner radius plus half the width
  int on_inner = 0, on_outer = 0;
  for (const Vec2& p : plan.left) on_inner += std::abs((p - centre).norm() - 1.0) < 1e-12;
  for (const Vec2& p : plan.right) on_outer += std::abs((p - centre).norm() - 3.0) < 1e-12;
  EXPECT_EQ(on_inner, static_cast<int>(plan.left.size()) - 2);
  EXPECT_EQ(on_outer, static_cast<int>(plan.right.size()) - 2);
}

TEST(Outline, tells_which_leg_is_too_short_for_its_bends) {
  const auto plan = outline({{10, 2, pi / 2}, {3, 2, -pi / 2}, {10, 2, 0}}, 1.0, 0.1);
  EXPECT_GT(plan.straight[0], 0.0);
  EXPECT_NEAR(plan.straight[1], 3.0 - 4.0, 1e-12);  // each bend takes inner radius plus half the width from the middle
  EXPECT_GT(plan.straight[2], 0.0);
}

TEST(Surface, inserts_corners_of_one_face_into_the_edges_of_another) {
  // Two cubes side by side, one half as high: the large one's side has a corner in the middle of its edge.
  Surface surface;
  const SideNames names{"a", "a", "a", "a"};
  const Section low{0, 1, 0, 1}, high{0, 1, 0, 2};
  add_end("a", 0.0, low, false, surface);
  add_sides(names, 0.0, 1.0, low, surface);
  add_section_change("a", 1.0, low, high, surface);
  add_sides(names, 1.0, 2.0, high, surface);
  add_end("a", 2.0, high, true, surface);
  EXPECT_NEAR(enclosed_volume(surface.close(10.0)), 3.0, 1e-14);
}

TEST(Surface, with_a_face_missing_is_refused) {
  Surface surface;
  add_sides({"a", "a", "a", "a"}, 0.0, 1.0, {0, 1, 0, 1}, surface);
  EXPECT_THROW(surface.close(1.0), std::logic_error);
}

TEST(Surface, is_subdivided_without_changing_its_area_or_volume) {
  Surface surface;
  const Section section{0, 1, 0, 1};
  add_end("a", 0.0, section, false, surface);
  add_sides({"a", "a", "a", "a"}, 0.0, 3.0, section, surface);
  add_end("a", 3.0, section, true, surface);
  const auto coarse = surface.close(10.0), fine = surface.close(0.1);
  EXPECT_EQ(coarse.triangles.size(), 12U);
  EXPECT_GT(fine.triangles.size(), 14.0 / (0.5 * 0.1 * 0.1));  // no triangle has more than half a square of that edge
  EXPECT_NEAR(enclosed_volume(fine), 3.0, 1e-12);
}

}  // namespace
}  // namespace puffin::cases::generators
