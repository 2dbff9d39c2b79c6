#include <gtest/gtest.h>

#include <algorithm>

#include "cases/choices.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

using test::parse;
using test::problems_of;
using test::replaced;
using test::sample;

bool any_contains(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

TEST(ReadCase, ValuesAreInSI) {
  const Case c = parse(sample);
  EXPECT_EQ(c.name, "sample");
  EXPECT_EQ(*c.numerics.dx, 0.4e-3);
  EXPECT_EQ(c.carriers->diameter, 70e-6);
  EXPECT_DOUBLE_EQ(std::get<FlowRate>(c.air.boundaries[0].flow).table.at(1.0), 6e-4);
  EXPECT_EQ(std::get<std::string>(c.carriers->fill->at), "pocket");
  EXPECT_FALSE(c.fines.has_value());
}

TEST(ReadCase, ThreeMistakesAreAllReportedWithLineAndColumn) {
  std::string text = replaced(sample, "surface_energy", "surface_enrgy");
  text = replaced(text, "\"1.2 kg/m^3\"", "\"3 s\"");
  text = replaced(text, "\"pressure-outlet\"", "\"presure-outlet\"");
  const std::vector<std::string> lines = problems_of(text);
  EXPECT_TRUE(any_contains(lines, "folder/case.toml:6:11: error: air.density = \"3 s\"")) << lines[0];
  EXPECT_TRUE(any_contains(lines, "folder/case.toml:14:8: error: air.boundary[1].type"));
  EXPECT_TRUE(any_contains(lines, "did you mean 'pressure-outlet'?"));
  EXPECT_TRUE(any_contains(lines,
                           "folder/case.toml:27:1: error: unknown key 'surface_enrgy' in [carriers.adhesion]; "
                           "did you mean 'surface_energy'?"));
}

TEST(ReadCase, AMissingKeyIsReportedAtItsTable) {
  EXPECT_EQ(problems_of(replaced(sample, "diameter = \"70 um\"\n", "")),
            std::vector<std::string>{"folder/case.toml:17:1: error: missing key 'diameter' in [carriers]"});
}

TEST(ReadCase, ASyntaxErrorHasItsPlace) {
  const std::vector<std::string> lines = problems_of(replaced(sample, "[stop]", "[stop"));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].find("folder/case.toml:28:"), 0u) << lines[0];
}

TEST(ReadCase, AModelOfAnotherVersionIsRefusedByName) {
  const auto words = choices<Collision>();
  const auto refused = std::find_if(words.begin(), words.end(), [](const Choice& w) { return !w.offered; });
  if (refused == words.end()) GTEST_SKIP() << "every collision operator is offered";
  const auto lines = problems_of(sample, {{"numerics.collision", std::string(refused->name)}});
  EXPECT_TRUE(any_contains(lines, "not part of this version; it offers"));
}

TEST(ReadCase, UnknownPatchesAreFoundWithoutReadingTheGeometry) {
  EXPECT_TRUE(any_contains(problems_of(replaced(sample, "\"pocket\"", "\"poket\"")), "did you mean 'pocket'?"));
  EXPECT_TRUE(any_contains(problems_of(replaced(sample, "\"outlet\"", "\"exit\"")), "there is no patch 'exit'"));
}

TEST(ReadCase, AWrongGeneratorParameterIsReportedAtItsKey) {
  const auto lines = problems_of(sample + "[geometry.l-bend]\nstep_heigth = \"1 mm\"\n");
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(any_contains(lines, "step_height")) << lines[0];
}

TEST(ReadCase, AGeneratorParameterThatCannotBeReadIsToldOnce) {
  // Not as the 0 that would stand for it, which is too small; and what else is wrong is told all the same.
  const auto lines = problems_of(sample + "[geometry.l-bend]\nduct_width = \"foo\"\nstep_height = -1.0\n");
  EXPECT_EQ(lines.size(), 2u);
  EXPECT_TRUE(any_contains(lines, "'foo' does not begin with a number"));
  EXPECT_TRUE(any_contains(lines, "is -1; it must"));
}

// gamma = H/(24 pi d0^2): 3.6e-3 J/m^2 and 0.4 nm belong to H = 4.343e-20 J.
TEST(ReadCase, HamakerAndSurfaceEnergyMustAgree) {
  EXPECT_NEAR(parse(sample).carriers->adhesion.hamaker, 4.343e-20, 0.001e-20);
  EXPECT_TRUE(problems_of(sample, {{"carriers.adhesion.hamaker", "'4.3e-20 J'"}}).empty());  // 1 % off, rounded
  EXPECT_TRUE(any_contains(problems_of(sample, {{"carriers.adhesion.hamaker", "'2.2e-19 J'"}}), "24 pi d0^2"));
}

TEST(ReadCase, WallsInheritWhatIsNotGiven) {
  const Case c = parse(sample, {{"carriers.contact.restitution", "0.7"}, {"carriers.walls.contact.friction", "0.1"}});
  EXPECT_EQ(c.carriers->wall_contact.restitution, 0.7);
  EXPECT_EQ(std::get<double>(c.carriers->wall_contact.friction), 0.1);
  EXPECT_EQ(std::get<double>(c.carriers->contact.friction), 0.3);
  EXPECT_EQ(c.carriers->wall_adhesion, c.carriers->adhesion);
}

TEST(ReadCase, FlowTimesMustIncrease) {
  const auto lines = problems_of(sample, {{"air.boundary[0].flow_rate", "[[0, 0], ['2 ms', 1e-4], ['1 ms', 2e-4]]"}});
  EXPECT_TRUE(any_contains(lines, "times must increase"));
}

TEST(ReadCase, AnInletNeedsAnOutlet) {
  EXPECT_TRUE(any_contains(problems_of(replaced(sample, "\"pressure-outlet\"", "\"wall\"")), "nowhere to go"));
}

TEST(ReadCase, RangesAreChecked) {
  EXPECT_TRUE(any_contains(problems_of(sample, {{"carriers.diameter", "-1e-5"}}), "must be positive"));
  EXPECT_TRUE(any_contains(problems_of(sample, {{"carriers.contact.restitution", "1.5"}}), "between 0 and 1"));
  EXPECT_TRUE(any_contains(problems_of(sample, {{"carriers.count", "2.5"}}), "whole number"));
  EXPECT_TRUE(any_contains(problems_of(sample, {{"carriers.count", "1001"}}), "no multiple"));
}

TEST(Overrides, TakeTomlValuesAndBareWords) {
  const Case c = parse(sample, {parse_override("numerics.dx=0.3mm"), parse_override("carriers.rotation = false"),
                                parse_override("air.boundary.0.flow_rate=20 L/min"), parse_override("name=other")});
  EXPECT_EQ(*c.numerics.dx, 0.3e-3);
  EXPECT_FALSE(c.carriers->rotation);
  EXPECT_DOUBLE_EQ(std::get<FlowRate>(c.air.boundaries[0].flow).table.value[0], 20e-3 / 60.0);
  EXPECT_EQ(c.name, "other");
}

TEST(Overrides, MistakesNameTheOption) {
  EXPECT_TRUE(
      any_contains(problems_of(sample, {{"numerics.dxx", "1"}}), "--set numerics.dxx: error: unknown key 'dxx'"));
  EXPECT_TRUE(any_contains(problems_of(sample, {{"air.boundary[7].patch", "x"}}), "no index of a list of 2"));
  EXPECT_TRUE(any_contains(problems_of(sample, {{"name.more", "x"}}), "not a table"));
  EXPECT_THROW(parse_override("no equals sign"), std::invalid_argument);
}

TEST(Presets, ScaleTheGridAndGiveWayToSet) {
  const Case quick = parse(replaced(sample, "0.4 mm", "0.25 mm"), {}, "quick");
  EXPECT_EQ(*quick.numerics.dx, 0.375e-3);
  EXPECT_EQ(quick.stop.time, 0.01);  // earlier than 121 ms already
  EXPECT_EQ(quick.provenance.at("numerics.dx").origin, Origin::derived);
  const Case longer = parse(sample, {{"stop.time", "1.0"}, {"numerics.dx", "1e-4"}}, "quick");
  EXPECT_EQ(longer.stop.time, 1.0);
  EXPECT_EQ(*longer.numerics.dx, 1e-4);
  EXPECT_EQ(parse(replaced(sample, "10 ms", "1 s"), {}, "quick").stop.time, 0.121);
  EXPECT_THROW(parse(sample, {}, "quickest"), std::invalid_argument);
  // A step in seconds goes with the cells, so that air crosses as much of one; a window after the new end is forgotten.
  const Case seconds = parse(replaced(sample, "[numerics]", "[numerics]\ntime_step = \"2e-7 s\""), {}, "accurate");
  EXPECT_DOUBLE_EQ(seconds.numerics.time_step_seconds, 2e-7 * 2.0 / 3.0);
  const std::string late = replaced(sample, "10 ms", "1 s") + "\n[output]\npressure_window = [\"0.5 s\", \"1 s\"]\n";
  EXPECT_FALSE(parse(late, {}, "quick").output.pressure_window);
  EXPECT_TRUE(parse(late).output.pressure_window);
}

TEST(Provenance, DistinguishesGivenDefaultDerivedAssumed) {
  const Case c = parse(replaced(sample, "diameter = \"70 um\"", "diameter = \"70 um\"  # assumed: from the mesh"));
  EXPECT_EQ(c.provenance.at("carriers.count").origin, Origin::given);
  EXPECT_EQ(c.provenance.at("carriers.drag").origin, Origin::defaulted);
  EXPECT_EQ(c.provenance.at("carriers.adhesion.hamaker").origin, Origin::derived);
  EXPECT_EQ(c.provenance.at("carriers.diameter"), (ValueSource{Origin::assumed, "from the mesh"}));
}

}  // namespace
}  // namespace puffin::cases
