// Parameters that make no sense are refused, by name and with a remedy.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "cases/generators/generators.hpp"
#include "cases/generators/surface.hpp"

namespace puffin::cases {
namespace {

constexpr double mm = 1e-3;

/// The first problem reported for a parameter, or "" if there is none.
std::string problem(const std::string& kind, const Parameters& p, const std::string& parameter) {
  for (const ParameterProblem& found : check_parameters(kind, p))
    if (found.parameter == parameter) return found.message;
  return "";
}

TEST(GeneratorParameters, misspelt_are_met_with_a_suggestion) {
  EXPECT_NE(problem("l-bend", {{"duct_hieght", 3.0 * mm}}, "duct_hieght").find("did you mean 'duct_height'?"),
            std::string::npos);
}

TEST(GeneratorParameters, of_an_unknown_kind_are_met_with_a_suggestion) {
  try {
    generate("l-bent");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'l-bend'?"), std::string::npos);
  }
}

TEST(GeneratorParameters, wrong_in_several_ways_are_all_reported) {
  EXPECT_EQ(
      check_parameters("duct", {{"width", -1.0}, {"height", 0.0}, {"depth", 1.0}, {"length", std::string("x")}}).size(),
      4U);
}

TEST(GeneratorParameters, that_are_no_finite_lengths_are_refused) {
  for (const std::string& kind : generator_kinds())
    for (const ParameterInfo& info : parameters_of(kind)) {
      if (!std::holds_alternative<double>(info.default_value)) continue;
      EXPECT_NE(problem(kind, {{info.name, -1.0 * mm}}, info.name), "") << kind << ' ' << info.name;
      EXPECT_NE(problem(kind, {{info.name, std::numeric_limits<double>::quiet_NaN()}}, info.name), "") << info.name;
    }
}

TEST(GeneratorParameters, have_units_meanings_and_accepted_defaults) {
  for (const std::string& kind : generator_kinds()) {
    EXPECT_TRUE(check_parameters(kind, {}).empty()) << kind;
    for (const ParameterInfo& info : parameters_of(kind)) {
      EXPECT_FALSE(info.meaning.empty()) << info.name;
      const bool is_number = info.default_value.index() < 2;
      EXPECT_EQ(info.unit.empty(), !is_number) << info.name;
    }
  }
}

TEST(GeneratorParameters, stated_by_the_thesis_are_marked_given) {
  std::vector<std::string> given;
  for (const ParameterInfo& info : parameters_of("l-bend"))
    if (info.provenance == Provenance::given) given.push_back(info.name);
  EXPECT_EQ(given, (std::vector<std::string>{"inlet_width", "inlet_height", "lip_height", "pocket_depth",
                                             "pocket_bottom_diameter", "pocket_top_diameter", "volume"}));
}

TEST(DeviceParameters, that_do_not_fit_together_are_refused) {
  using Numbers = std::vector<double>;
  EXPECT_NE(problem("l-bend", {{"pocket_top_diameter", 7.5 * mm}}, "pocket_top_diameter"), "") << "wider than the duct";
  EXPECT_NE(problem("l-bend", {{"pocket_bottom_diameter", 5.5 * mm}}, "pocket_bottom_diameter"), "") << "undercut";
  EXPECT_NE(problem("l-bend", {{"pocket_distance", 0.0}}, "pocket_distance"), "") << "touches the step";
  EXPECT_NE(problem("l-bend", {{"pocket_distance", 70.0 * mm}}, "pocket_distance"), "") << "beyond the bend";
  EXPECT_NE(problem("l-bend", {{"step_height", 2.0 * mm}}, "step_height"), "") << "lip above the ceiling";
  EXPECT_NE(problem("l-bend", {{"lip_height", 1.0 * mm}}, "lip_height"), "") << "lower than the inlet";
  EXPECT_NE(problem("l-bend", {{"lip_length", 9.0 * mm}}, "lip_length"), "") << "longer than the inlet";
  EXPECT_NE(problem("l-bend", {{"leg_lengths", Numbers{1.0 * mm, 2.0 * mm, 3.0 * mm}}}, "leg_lengths"), "") << "count";
  EXPECT_NE(problem("l-bend", {{"leg_lengths", Numbers{65.0 * mm, 2.0 * mm}}}, "leg_lengths"), "") << "inside the bend";
  EXPECT_NE(problem("omega-bend", {{"bend_inner_radius", 9.0 * mm}}, "leg_lengths"), "") << "arcs overlap";
  EXPECT_NE(problem("l-bend", {{"volume", 1500e-9}}, "volume"), "") << "less than the first leg";
}

TEST(DeviceParameters, with_a_forgotten_unit_are_refused_before_memory_runs_out) {
  EXPECT_NE(problem("l-bend",
                    {{"inlet_width", 7.0},
                     {"duct_width", 7.0},
                     {"leg_lengths", std::vector<double>{65.0, 50.0}},
                     {"leg_widths", std::vector<double>{0.0, 5.0}}},
                    "facet_size")
                .find("metres"),
            std::string::npos);
  EXPECT_NE(problem("box", {{"facet_size", 1e-9}}, "facet_size"), "");
}

TEST(GeneratorParameters, that_ask_for_too_many_facets_are_refused_on_the_way) {
  // Faces of 1 m^2 ask for 1/(sqrt(3)/4 0.75^2) = 4.1 triangles of 1 m each, and one a face: 780,000 of them are
  // enough.
  generators::Surface surface(1.0);
  const generators::Loop square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::size_t added = 0;
  try {
    for (; added < 1'000'000; ++added) surface.add("wall", square);
  } catch (const std::length_error&) {
  }
  EXPECT_NEAR(static_cast<double>(added), 4e6 / (1.0 + 16.0 / 9.0 * 4.0 / std::sqrt(3.0)), 1.0);
  for (const double facet : {1e-6, 1e-9, 1e-15})
    for (const std::string kind : {"pipe", "bend", "obstacle", "l-bend", "omega-bend"}) {
      Parameters p{{"facet_size", facet}};
      if (kind == "bend") p["diameter"] = 5.0 * mm, p["inner_radius"] = 5.0 * mm;
      EXPECT_NE(problem(kind, p, "facet_size").find("more than 4 million triangles"), std::string::npos) << kind;
    }
  EXPECT_NE(problem("pipe", {{"length", 500.0}}, "facet_size").find("metres"), std::string::npos);
}

TEST(BendParameters, that_cannot_be_built_are_refused) {
  EXPECT_NE(problem("bend", {{"angle", 90.0}}, "angle"), "") << "degrees for radians";
  EXPECT_NE(problem("bend", {{"inlet_length", 0.0}}, "inlet_length"), "");
}

TEST(ObstacleParameters, that_cannot_be_built_are_refused) {
  EXPECT_NE(problem("obstacle", {{"diameter", 10.0 * mm}}, "diameter"), "") << "touches the walls";
  EXPECT_NE(problem("obstacle", {{"center", std::vector<double>{1.0 * mm, 2.0 * mm}}}, "center"), "");
  EXPECT_NE(problem("obstacle", {{"shape", std::string("spehre")}}, "shape").find("'sphere'"), std::string::npos);
}

}  // namespace
}  // namespace puffin::cases
