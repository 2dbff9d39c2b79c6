#pragma once
// The shapes that every claim about surfaces is checked on: each kind with its defaults, and the variants that take
// another way through its code.

#include <map>
#include <string>
#include <vector>

#include "cases/generators/generators.hpp"
#include "cases/generators/surface.hpp"

namespace puffin::cases {

struct TestShape {
  std::string name, kind;
  Parameters parameters;
};

inline std::vector<TestShape> test_shapes() {
  using Numbers = std::vector<double>;
  const double mm = 1e-3;
  std::vector<TestShape> shapes;
  std::vector<TestShape> variants = {
      {"l_no_pocket", "l-bend", {{"pocket_depth", 0.0}}},
      {"l_no_step", "l-bend", {{"step_height", 0.0}, {"duct_height", 2.0 * mm}}},
      {"l_low_ceiling_step", "l-bend", {{"duct_height", 4.2 * mm}}},
      {"l_rounded", "l-bend", {{"bend_inner_radius", 2.0 * mm}}},
      {"l_narrow_inlet", "l-bend", {{"inlet_width", 5.0 * mm}}},
      {"omega_mitred", "omega-bend", {{"bend_inner_radius", 0.0}}},
      {"omega_with_lip", "omega-bend", {{"lip_height", 2.4 * mm + 0.1 * mm}, {"inlet_height", 2.0 * mm}}},
      {"preliminary_omega",
       "omega-bend",
       {{"inlet_height", 2.25 * mm},
        {"inlet_width", 7.5 * mm},
        {"step_height", 2.25 * mm},
        {"pocket_depth", 0.0},
        {"leg_widths", Numbers{0.0, 4.5 * mm, 4.5 * mm, 4.5 * mm, 0.0}},
        {"leg_lengths", Numbers{45.0 * mm, 26.0 * mm, 26.0 * mm, 26.0 * mm, 54.0 * mm}}}},
      {"duct_periodic", "duct", {{"periodic", true}}},
      {"duct_fine", "duct", {{"facet_size", 0.4 * mm}}},
      {"pipe_periodic", "pipe", {{"periodic", true}}},
      {"bend_rounded", "bend", {{"inner_radius", 3.0 * mm}, {"angle", 1.0}}},
      {"bend_round_section", "bend", {{"diameter", 4.0 * mm}, {"inner_radius", 3.0 * mm}}},
      {"bend_torus_only",
       "bend",
       {{"diameter", 4.0 * mm}, {"inner_radius", 3.0 * mm}, {"inlet_length", 0.0}, {"outlet_length", 0.0}}},
      {"bend_round_mitre", "bend", {{"diameter", 4.0 * mm}, {"angle", 0.8}}},
      {"step_periodic", "step", {{"periodic", true}}},
      {"obstacle_cylinder", "obstacle", {{"shape", std::string("cylinder")}}},
      {"obstacle_cube", "obstacle", {{"shape", std::string("cube")}, {"periodic", true}}},
      {"simple_cubic_cell",
       "obstacle",
       {{"length", 1.0},
        {"width", 1.0},
        {"height", 1.0},
        {"diameter", 0.5},
        {"center", Numbers{0.5, 0.5, 0.5}},
        {"periodic", true}}},
  };
  for (const std::string& kind : generator_kinds()) variants.push_back({kind, kind, {}});
  for (TestShape& shape : variants) {  // coarse facets: the way through the code counts, not the number of triangles
    const Parameters complete = resolve_parameters(shape.kind, shape.parameters);
    shape.parameters.emplace("facet_size", 3.0 * std::get<double>(complete.at("facet_size")));
    shapes.push_back(shape);
  }
  return shapes;
}

inline std::map<std::string, double> patch_areas(const lbm::geometry::TriangleMesh& mesh) {
  std::map<std::string, double> area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area[mesh.solids[mesh.solid[t]]] += mesh.area(static_cast<int>(t));
  return area;
}

}  // namespace puffin::cases
