#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "cases/write_case.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

using test::parse;
using test::sample;

void expect_round_trip(const Case& c) {
  const std::string text = write_resolved(c);
  const Case again = parse(text);
  EXPECT_TRUE(again == c) << text << "\n---- read and written again ----\n" << write_resolved(again);
}

TEST(WriteCase, ReadingTheResolvedCaseGivesTheSameCase) { expect_round_trip(parse(sample)); }

TEST(WriteCase, NamesFilesSoThatTheyAreFoundFromAnyFolder) {
  Case c = parse(sample);
  c.fines.emplace().micromodels = "laws.toml";
  EXPECT_NE(write_resolved(c).find('"' + std::filesystem::absolute("laws.toml").string() + '"'), std::string::npos);
}

TEST(WriteCase, EveryShapeOfAValueComesBack) {
  for (const std::vector<Override>& overrides : std::vector<std::vector<Override>>{
           {{"air.boundary[0].flow_rate", "[['0 s', 0], ['1 ms', '3 L/min'], [0.3, 1e-3]]"}},
           {{"air.body_force", "[1, 2.5, -3e-9]"}, {"numerics.reference_speed", "63 m/s"}},
           {{"numerics.time_step", "2e-7 s"}},
           {{"numerics.time_step", "fixed"}, {"numerics.precision", "double"}, {"numerics.seed", "77"}},
           {{"carriers.fill.at", "[0.001, 0, 0.002]"},
            {"carriers.fill.shape", "cube"},
            {"carriers.fill.extent_of", "[1000, 1]"}},
           {{"carriers.contact.stiffness", "1000 N/m"}},
           {{"carriers.walls.adhesion.surface_energy", "1e-3"}},
           {{"geometry.patch", "[{name = 'a \"quoted\" patch', select = 'near:[1 mm, 0, 0.2]'}]"}},
           {{"output.fields",
             "[{what = ['velocity', 'pressure'], region = 'slice:z=2.2mm', every = '1 ms'},"
             " {what = 'velocity', region = 'box:[0,0,0,1 mm,2 mm,3 mm]', every = 1}]"}},
           {{"output.probe", "[{name = 'p', at = [1, 2, 3]}]"},
            {"output.line", "[{name = 'l', from = [0, 0, 0], to = ['1 mm', 0, 0], points = 7}]"},
            {"output.plane", "[{name = 's', normal = 'y', at = '3 mm'}]"},
            {"output.pressure_window", "['1 ms', '9 ms']"},
            {"output.carriers", "1 ms"},
            {"output.force", "['pocket']"}},
           {{"reference.FFE", "0.67"}, {"reference.thesis.span", "[0.1, 0.2]"}, {"reference.note", "'a word'"}},
           {{"fines.scalar",
             "[{name = 's', diffusion = '1e-6 kg/(m s)', initial = {shape = 'gaussian',"
             " center = [0, 0, 0], sigma = '1 mm', amount = 5}}]"}}})
    expect_round_trip(parse(sample, overrides));
}

// Any doubles survive: they are printed with the fewest digits that read back as the same number.
TEST(WriteCase, RandomNumbersComeBackBitForBit) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-9.0, 1.0);
  const auto number = [&] { return std::pow(10.0, exponent(random)); };
  for (int i = 0; i < 50; ++i) {
    Case c = parse(sample);
    c.air.density = number();
    c.air.initial_velocity = Vec3(number(), -number(), number());
    c.numerics.dx = number();
    c.stop.time = number();
    c.output.statistics = c.stop.time / 7.0;
    c.carriers->diameter = number();
    c.carriers->gravity = Vec3(number(), number(), -number());
    std::get<FlowRate>(c.air.boundaries[0].flow).table = {{0.0, number()}, {number(), number()}};
    const Case again = parse(write_resolved(c));
    EXPECT_EQ(again.air, c.air);
    EXPECT_EQ(again.numerics, c.numerics);
    EXPECT_EQ(again.stop, c.stop);
    EXPECT_EQ(again.carriers, c.carriers);
  }
}

TEST(WriteCase, AssumptionsAreListedWithTheirReason) {
  const Case c = parse(test::replaced(sample, "dx = \"0.4 mm\"", "# assumed: for trying out\ndx = \"0.4 mm\""));
  EXPECT_EQ(assumptions(c), std::vector<std::string>{"numerics.dx: for trying out"});
}

}  // namespace
}  // namespace puffin::cases
