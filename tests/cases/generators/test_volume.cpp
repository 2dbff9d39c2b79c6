// The enclosed volumes are those of the formulas. Plane shapes: to rounding. Round shapes: exactly those of the regular
// polygons inscribed in their circles, and the circle's to the facet error.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/cases/generators/shapes.hpp"

namespace puffin::cases {
namespace {

constexpr double mm = 1e-3, pi = std::numbers::pi;
constexpr double rounding = 1e-12;  // relative: 1e4 triangles, each term to 1e-16 of the size of the shape

double volume(const std::string& kind, const Parameters& p = {}) {
  return generators::enclosed_volume(generate(kind, p));
}

/// Area of a regular polygon of n corners inscribed in a circle, over the circle's.
double polygon_share(int n) { return std::sin(2.0 * pi / n) / (2.0 * pi / n); }

TEST(DeviceVolume, of_the_l_bend_is_that_of_the_thesis) { EXPECT_NEAR(volume("l-bend") / 2751.6e-9, 1.0, rounding); }

TEST(DeviceVolume, of_the_omega_bend_is_that_of_the_thesis) {
  EXPECT_NEAR(volume("omega-bend") / 3144.6e-9, 1.0, rounding);
}

TEST(DeviceVolume, does_not_depend_on_the_facet_size) {
  EXPECT_NEAR(volume("l-bend", {{"facet_size", 3.0 * mm}}) / 2751.6e-9, 1.0, rounding);
}

TEST(DeviceVolume, is_what_is_asked_for_when_legs_are_free) {
  EXPECT_NEAR(volume("omega-bend", {{"volume", 3500e-9}, {"bend_inner_radius", 0.0}}) / 3500e-9, 1.0, rounding);
}

TEST(DeviceVolume, of_a_mitred_device_is_the_sum_of_its_blocks) {
  // A mitre between legs of widths a and b holds a b, as much as half a leg's width of each centre line: the duct has
  // the plan area sum of length times width. Inlet 2 x 1.5 x 7, lip 2 x 2 x 7, no pocket.
  const double plan = 65.0 * 7.0 + 50.0 * 5.75;
  const double expected = (2.0 * 1.5 * 7.0 + 2.0 * 2.0 * 7.0 + 3.5 * plan) * 1e-9;
  const Parameters p = {{"leg_lengths", std::vector<double>{65.0 * mm, 50.0 * mm}}, {"pocket_depth", 0.0}};
  EXPECT_NEAR(volume("l-bend", p) / expected, 1.0, rounding);
}

TEST(DeviceVolume, gains_the_pocket_as_a_truncated_cone) {
  const Parameters with = {{"leg_lengths", std::vector<double>{65.0 * mm, 50.0 * mm}}};
  Parameters without = with;
  without["pocket_depth"] = 0.0;
  const double cone = pi / 3.0 * 0.25 * (2.25 * 2.25 + 2.25 * 2.5 + 2.5 * 2.5) * 1e-9;
  // 64 corners: the polygon lacks 0.16 % of the circle.
  EXPECT_NEAR((volume("l-bend", with) - volume("l-bend", without)) / (cone * polygon_share(64)), 1.0, 1e-8);
}

TEST(BlockVolume, of_duct_box_and_step_is_the_product_of_their_lengths) {
  EXPECT_NEAR(volume("duct") / (50.0 * 7.0 * 3.5e-9), 1.0, rounding);
  EXPECT_NEAR(volume("box", {{"x", 1.0}, {"y", 2.0}, {"z", 3.0}}) / 6.0, 1.0, rounding);
  EXPECT_NEAR(volume("step") / ((10.0 * 2.0 + 40.0 * 4.0) * 7.0e-9), 1.0, rounding);
}

TEST(RoundVolume, of_a_pipe_is_that_of_an_inscribed_prism) {
  EXPECT_NEAR(volume("pipe") / (pi * 2.5 * 2.5 * 50.0e-9 * polygon_share(96)), 1.0, rounding);
}

TEST(RoundVolume, of_a_pipe_approaches_the_cylinder_with_the_square_of_the_facets) {
  const double cylinder = pi * 2.5 * 2.5 * 5.0e-9;
  const auto lack = [cylinder](double corners) {
    const Parameters p = {{"length", 5.0 * mm}, {"facet_size", 2.0 * pi * 2.5 * mm / corners * 1.0001}};
    return 1.0 - volume("pipe", p) / cylinder;
  };
  EXPECT_NEAR(lack(128) / lack(256), 4.0, 0.01);  // next term: (2 pi / n)^2 / 20, 1e-4
}

TEST(BendVolume, of_a_mitre_is_section_times_length_of_the_centre_line) {
  const double angle = 1.1, length = 30.0 + 30.0 + 7.0 * std::tan(0.5 * angle);
  EXPECT_NEAR(volume("bend", {{"angle", angle}}) / (length * 7.0 * 3.5e-9), 1.0, rounding);
  EXPECT_NEAR(
      volume("bend", {{"angle", angle}, {"diameter", 7.0 * mm}}) / (length * pi * 3.5 * 3.5e-9 * polygon_share(96)),
      1.0, rounding);
}

TEST(BendVolume, of_a_rounded_bend_follows_pappus) {
  // Arcs of chords of at most 6 degrees: the sectors' areas are sin(a)/a of the arcs', a lack of at most a^2 / 6.
  const double facet_error = std::pow(pi / 30.0, 2) / 6.0, angle = 0.5 * pi;
  const double duct = (60.0 + angle * (4.0 + 3.5)) * 7.0 * 3.5e-9;
  EXPECT_NEAR(volume("bend", {{"inner_radius", 4.0 * mm}}) / duct, 1.0, facet_error);
  const double pipe = (60.0 + angle * (4.0 + 2.5)) * pi * 2.5 * 2.5e-9 * polygon_share(96);
  EXPECT_NEAR(volume("bend", {{"inner_radius", 4.0 * mm}, {"diameter", 5.0 * mm}}) / pipe, 1.0, facet_error);
}

TEST(BendVolume, of_a_torus_is_exact_for_its_facets) {
  // Each of m pieces is the section swept along a chord: sin(theta / m) R A.
  const Parameters p = {{"inner_radius", 4.0 * mm},
                        {"diameter", 5.0 * mm},
                        {"inlet_length", 0.0},
                        {"outlet_length", 0.0},
                        {"facet_size", 1.0}};
  const double area = pi * 2.5 * 2.5e-6 * polygon_share(96);
  EXPECT_NEAR(volume("bend", p) / (15.0 * std::sin(0.5 * pi / 15.0) * 6.5e-3 * area), 1.0, rounding);
}

TEST(ObstacleVolume, is_missing_from_the_duct) {
  const double duct = 40.0 * 10.0 * 10.0e-9;
  const auto solid = [duct](const char* shape) {
    return duct - volume("obstacle", {{"shape", std::string(shape)}, {"diameter", 4.0 * mm}});
  };
  EXPECT_NEAR(solid("cube") / 64.0e-9, 1.0, 1e-10);
  EXPECT_NEAR(solid("cylinder") / (pi * 4.0 * 10.0e-9 * polygon_share(96)), 1.0, 1e-10);
  // Sphere: an icosahedron's faces divided in 16 x 16. A facet with circumradius c (unit sphere) lies sqrt(1 - c^2)
  // from the centre, so the volume is between (1 - c^2)^(3/2) and 1; the largest edge is 0.0794, c = 0.0794 / sqrt 3.
  const double share = solid("sphere") / (4.0 / 3.0 * pi * 8.0e-9);
  EXPECT_LT(share, 1.0);
  EXPECT_GT(share, std::pow(1.0 - 0.0794 * 0.0794 / 3.0, 1.5));
}

}  // namespace
}  // namespace puffin::cases
