// Patches lie where the thesis and the documentation put them, with the areas stated.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/cases/generators/shapes.hpp"

namespace puffin::cases {
namespace {

using lbm::geometry::TriangleMesh;
using lbm::geometry::Vec3;
constexpr double mm = 1e-3, mm2 = 1e-6, pi = std::numbers::pi;

struct Extent {
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
};
Extent extent(const TriangleMesh& mesh, const std::string& solid) {
  Extent e;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.solids[mesh.solid[t]] == solid)
      for (int k = 0; k < 3; ++k) {
        e.low = e.low.cwiseMin(mesh.corner(static_cast<int>(t), k));
        e.high = e.high.cwiseMax(mesh.corner(static_cast<int>(t), k));
      }
  return e;
}
/// Sum of the area vectors: for a plane patch its area times its normal.
Vec3 directed_area(const TriangleMesh& mesh, const std::string& solid) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.solids[mesh.solid[t]] == solid) sum += 0.5 * mesh.area_vector(static_cast<int>(t));
  return sum;
}
void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose();
}

TEST(LBend, has_the_inlet_of_the_thesis_at_x_min_facing_the_flow) {
  const TriangleMesh mesh = generate("l-bend");
  expect_near(directed_area(mesh, "inlet"), {-1.5 * 7.0 * mm2, 0, 0}, 1e-12 * mm2);
  const Extent e = extent(mesh, "inlet");
  EXPECT_NEAR(e.high.z() - e.low.z(), 1.5 * mm, 1e-15);
  EXPECT_NEAR(e.high.y() - e.low.y(), 7.0 * mm, 1e-15);
  for (const Vec3& v : mesh.vertices) ASSERT_GE(v.x(), e.low.x());
}

TEST(LBend, turns_its_outlet_towards_plus_y) {
  const TriangleMesh mesh = generate("l-bend");
  expect_near(directed_area(mesh, "outlet"), {0, 5.75 * 3.5 * mm2, 0}, 1e-12 * mm2);
}

TEST(LBend, has_the_pocket_of_the_thesis_close_behind_the_step_in_the_floor) {
  const TriangleMesh mesh = generate("l-bend");
  const Extent e = extent(mesh, "pocket");
  expect_near(e.low, {1.0 * mm, -2.5 * mm, -0.25 * mm}, 1e-12);
  expect_near(e.high, {6.0 * mm, 2.5 * mm, 0.0}, 1e-12);
  // Floor and cone of 64-sided pyramids: perimeters shrink by sin(pi/64)/(pi/64); the slant is sqrt 2 times the depth
  // for the circle and to 1e-3 for the polygon.
  const double circle = pi * 2.25 * 2.25 + pi * (2.25 + 2.5) * 0.25 * std::sqrt(2.0);
  EXPECT_NEAR(patch_areas(mesh).at("pocket") / (circle * mm2), 1.0, 2.0 * std::pow(pi / 64.0, 2));
}

TEST(LBend, opens_to_two_millimetres_before_the_step) {
  const TriangleMesh mesh = generate("l-bend");
  double at_lip = 0.0, before_lip = 0.0;  // highest point at the step, and upstream of the lip
  for (const Vec3& v : mesh.vertices) {
    if (v.x() > -1.9 * mm && v.x() < -0.1 * mm) at_lip = std::max(at_lip, v.z());
    if (v.x() < -2.1 * mm) before_lip = std::max(before_lip, v.z());
  }
  EXPECT_NEAR(at_lip, (1.5 + 2.0) * mm, 1e-12);
  EXPECT_NEAR(before_lip, (1.5 + 1.5) * mm, 1e-12);
}

TEST(OmegaBend, has_the_inlet_of_the_thesis_and_an_outlet_along_plus_x) {
  const TriangleMesh mesh = generate("omega-bend");
  expect_near(directed_area(mesh, "inlet"), {-2.5 * 7.0 * mm2, 0, 0}, 1e-12 * mm2);
  expect_near(directed_area(mesh, "outlet"), {4.5 * 7.0 * mm2, 0, 0}, 1e-12 * mm2);
}

TEST(OmegaBend, has_a_middle_part_four_millimetres_wide) {
  // The third leg runs along x at y = 18 mm: its walls are at 16 and 20 mm.
  const TriangleMesh mesh = generate("omega-bend");
  const Extent e = extent(mesh, "wall");
  EXPECT_NEAR(e.high.y(), 20.0 * mm, 1e-12);
  double inner = e.high.y();
  for (const Vec3& v : mesh.vertices)
    if (v.x() > 38.0 * mm && v.x() < 40.0 * mm) inner = std::min(inner, v.y());
  EXPECT_NEAR(inner, 16.0 * mm, 1e-12);
}

TEST(OmegaBend, has_a_path_of_about_131_mm) {
  EXPECT_NEAR(key_points("omega-bend").path_length, 131.0 * mm, 0.02 * 131.0 * mm);
}

TEST(Devices, state_key_points_that_lie_on_their_patches) {
  for (const char* kind : {"l-bend", "omega-bend"}) {
    const TriangleMesh mesh = generate(kind);
    const KeyPoints points = key_points(kind);
    const Extent inlet = extent(mesh, "inlet"), outlet = extent(mesh, "outlet"), pocket = extent(mesh, "pocket");
    expect_near(*points.inlet, 0.5 * (inlet.low + inlet.high), 1e-12);
    expect_near(*points.outlet, 0.5 * (outlet.low + outlet.high), 1e-12);
    Vec3 middle = 0.5 * (pocket.low + pocket.high);
    middle.z() = pocket.low.z();
    expect_near(points.pocket->floor, middle, 1e-12);
    EXPECT_DOUBLE_EQ(points.pocket->bottom_diameter, 4.5 * mm);
  }
}

TEST(Devices, without_a_pocket_have_no_pocket_patch) {
  EXPECT_EQ(generate("l-bend", {{"pocket_depth", 0.0}}).solids, (std::vector<std::string>{"inlet", "outlet", "wall"}));
  EXPECT_FALSE(key_points("l-bend", {{"pocket_depth", 0.0}}).pocket.has_value());
}

TEST(Solids, are_known_without_building_the_surface) {
  for (const TestShape& shape : test_shapes())
    EXPECT_EQ(solids_of(shape.kind, shape.parameters), generate(shape.kind, shape.parameters).solids) << shape.name;
}

TEST(Devices, name_their_solids_in_order) {
  EXPECT_EQ(generate("l-bend").solids, (std::vector<std::string>{"inlet", "outlet", "wall", "pocket"}));
}

TEST(Boxes, and_periodic_ducts_name_six_faces_with_outward_normals) {
  for (const auto& [kind, size, p] :
       {std::tuple<std::string, Vec3, Parameters>{"box", Vec3(1, 2, 3), {{"x", 1.0}, {"y", 2.0}, {"z", 3.0}}},
        {"duct", Vec3(1, 2, 3), {{"length", 1.0}, {"width", 2.0}, {"height", 3.0}, {"periodic", true}}}}) {
    const TriangleMesh mesh = generate(kind, p);
    ASSERT_EQ(mesh.solids, (std::vector<std::string>{"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"}));
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 expected = size.prod() / size[axis] * Vec3::Unit(axis);
      expect_near(directed_area(mesh, mesh.solids[2 * axis]), -expected, 1e-12);
      expect_near(directed_area(mesh, mesh.solids[2 * axis + 1]), expected, 1e-12);
    }
  }
}

TEST(Boxes, stand_on_the_origin) {
  const Extent e = extent(generate("box"), "x-max");
  expect_near(e.low, {10.0 * mm, 0, 0}, 1e-15);
}

TEST(Pipes, have_their_axis_on_x) {
  const TriangleMesh mesh = generate("pipe");
  for (const Vec3& v : mesh.vertices) ASSERT_LE(std::hypot(v.y(), v.z()), 2.5 * mm * (1.0 + 1e-12));
  EXPECT_NEAR(directed_area(mesh, "outlet").x(), pi * 6.25 * mm2, pi * 6.25 * mm2 * std::pow(2 * pi / 96, 2) / 6.0);
}

TEST(Bends, turn_the_outlet_by_their_angle) {
  for (const double diameter : {0.0, 5.0 * mm})
    for (const double radius : {0.0, 3.0 * mm}) {
      const Parameters p = {{"angle", 1.0}, {"diameter", diameter}, {"inner_radius", radius}};
      const Vec3 normal = directed_area(generate("bend", p), "outlet").normalized();
      expect_near(normal, {std::cos(1.0), std::sin(1.0), 0.0}, 1e-10);
      const Extent e = extent(generate("bend", p), "outlet");
      expect_near(*key_points("bend", p).outlet, 0.5 * (e.low + e.high), 1e-10);
    }
}

TEST(Steps, drop_the_floor_by_their_height) {
  const TriangleMesh mesh = generate("step");
  expect_near(extent(mesh, "inlet").low, {0, 0, 2.0 * mm}, 1e-15);
  expect_near(extent(mesh, "outlet").low, {50.0 * mm, 0, 0}, 1e-15);
  const auto areas = patch_areas(generate("step", {{"periodic", true}}));
  EXPECT_NEAR(areas.at("y-min"), (10.0 * 2.0 + 40.0 * 4.0) * mm2, 1e-12);
}

TEST(Obstacles, keep_their_surface_a_patch_of_its_own) {
  const auto cube = generate("obstacle", {{"shape", std::string("cube")}, {"diameter", 2.0 * mm}});
  EXPECT_NEAR(patch_areas(cube).at("obstacle"), 24.0 * mm2, 1e-15);
  expect_near(directed_area(cube, "obstacle"), Vec3::Zero(), 1e-18);
  const auto cylinder = generate("obstacle", {{"shape", std::string("cylinder")}, {"diameter", 2.0 * mm}});
  EXPECT_NEAR(patch_areas(cylinder).at("obstacle") / (96 * 2.0 * std::sin(pi / 96) * 10.0 * mm2), 1.0, 1e-12);
}

}  // namespace
}  // namespace puffin::cases
