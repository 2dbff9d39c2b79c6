// Every generated surface can bound a fluid: closed, oriented, without degenerate or doubled facets.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/cases/generators/shapes.hpp"

namespace puffin::cases {
namespace {

using lbm::geometry::TriangleMesh;

class GeneratedSurface : public testing::TestWithParam<TestShape> {
 protected:
  TriangleMesh mesh = generate(GetParam().kind, GetParam().parameters);
  static double facet_size() { return std::get<double>(GetParam().parameters.at("facet_size")); }
};

/// Directed edges and how often each occurs.
std::map<std::array<int, 2>, int> directed_edges(const TriangleMesh& mesh) {
  std::map<std::array<int, 2>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  return edges;
}

bool is_closed_and_oriented(const TriangleMesh& mesh) {
  const auto edges = directed_edges(mesh);
  return std::all_of(edges.begin(), edges.end(), [&edges](const auto& edge) {
    const auto back = edges.find({edge.first[1], edge.first[0]});
    return edge.second == 1 && back != edges.end() && back->second == 1;
  });
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = 10.0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto u = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k),
                 v = mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k);
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
  return smallest;
}

TEST_P(GeneratedSurface, shares_each_edge_between_two_triangles_in_opposite_directions) {
  EXPECT_TRUE(is_closed_and_oriented(mesh));
}

TEST_P(GeneratedSurface, has_area_vectors_that_point_out_of_the_fluid) {
  EXPECT_GT(generators::enclosed_volume(mesh), 0.0);
}

TEST_P(GeneratedSurface, has_each_vertex_at_a_place_of_its_own) {
  std::set<std::array<double, 3>> places;
  for (const auto& v : mesh.vertices) places.insert({v.x(), v.y(), v.z()});
  EXPECT_EQ(places.size(), mesh.vertices.size());
}

TEST_P(GeneratedSurface, has_no_needle_or_flat_facets) {
  // A triangle with shortest edge e and circumradius R has the smallest angle asin(e / 2R). In a Delaunay triangulation
  // with edges of at most h no circle is much larger than h: angles are at least e / 2h, e the shortest edge at all.
  double shortest = 1e9;
  for (const auto& [edge, count] : directed_edges(mesh))
    shortest = std::min(shortest, (mesh.vertices[edge[0]] - mesh.vertices[edge[1]]).norm());
  EXPECT_GT(smallest_angle(mesh), 0.5 * shortest / facet_size());
}

TEST_P(GeneratedSurface, has_no_edge_longer_than_the_facet_size) {
  for (const auto& [edge, count] : directed_edges(mesh))
    ASSERT_LE((mesh.vertices[edge[0]] - mesh.vertices[edge[1]]).norm(), facet_size());
}

TEST_P(GeneratedSurface, names_a_solid_for_every_triangle_and_no_empty_one) {
  std::set<int> used(mesh.solid.begin(), mesh.solid.end());
  EXPECT_EQ(mesh.solid.size(), mesh.triangles.size());
  EXPECT_EQ(used.size(), mesh.solids.size());
  EXPECT_EQ(*used.begin(), 0);
  EXPECT_EQ(*used.rbegin(), static_cast<int>(mesh.solids.size()) - 1);
}

TEST_P(GeneratedSurface, is_the_same_from_its_resolved_parameters) {
  const auto again = generate(GetParam().kind, resolve_parameters(GetParam().kind, GetParam().parameters));
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.vertices, mesh.vertices);
}

INSTANTIATE_TEST_SUITE_P(all, GeneratedSurface, testing::ValuesIn(test_shapes()), [](const auto& shape) {
  std::string name = shape.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Generators, scale_with_their_lengths) {
  // A device twice as large has the same triangles at twice the coordinates (to rounding).
  const auto one = generate("step", {});
  Parameters doubled = resolve_parameters("step", {});
  for (auto& [name, value] : doubled)
    if (auto* number = std::get_if<double>(&value)) *number *= 2.0;
  const auto two = generate("step", doubled);
  ASSERT_EQ(one.triangles, two.triangles);
  for (std::size_t k = 0; k < one.vertices.size(); ++k)
    EXPECT_EQ(2.0 * one.vertices[k], two.vertices[k]) << "a factor of two is exact";
}

TEST(Generators, close_whatever_dimensions_pass_the_check) {
  // Random devices: those that are accepted must be closed and have their volume; most are accepted.
  std::mt19937_64 random(7);
  const auto pick = [&random](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random() >> 11), -53);
  };
  int accepted = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double mm = 1e-3;
    const Parameters p = {
        {"inlet_width", pick(4, 9) * mm},
        {"inlet_height", pick(1, 2) * mm},
        {"lip_height", pick(2, 2.5) * mm},
        {"step_height", pick(0.1, 2) * mm},
        {"duct_height", pick(3, 6) * mm},
        {"duct_width", pick(5, 9) * mm},
        {"leg_lengths", std::vector<double>{pick(15, 30) * mm, pick(10, 20) * mm, pick(10, 20) * mm, pick(10, 20) * mm,
                                            pick(10, 20) * mm}},
        {"leg_widths", std::vector<double>{0.0, pick(3, 7) * mm, pick(3, 7) * mm, pick(3, 7) * mm, 0.0}},
        {"bend_inner_radius", pick(0, 1.5) * mm},
        {"pocket_top_diameter", pick(4.6, 5.2) * mm},
        {"facet_size", 2.0 * mm}};
    if (!check_parameters("omega-bend", p).empty()) continue;
    ++accepted;
    EXPECT_TRUE(is_closed_and_oriented(generate("omega-bend", p))) << "trial " << trial;
  }
  EXPECT_GT(accepted, 20);
}

}  // namespace
}  // namespace puffin::cases
