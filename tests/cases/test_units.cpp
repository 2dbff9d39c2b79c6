#include <gtest/gtest.h>

#include "cases/spelling.hpp"
#include "cases/units.hpp"

namespace puffin::cases {
namespace {

std::string complaint(const std::string& text, const Unit& u) {
  try {
    parse_quantity(text, u);
  } catch (const UnitError& e) {
    return e.what();
  }
  return "";
}

// Decimal prefixes move the exponent of the digits, so the result is the double nearest to the decimal value: equal.
TEST(Units, DecimalPrefixesAreCorrectlyRounded) {
  EXPECT_EQ(parse_quantity("0.234 mm", unit::length), 0.000234);
  EXPECT_EQ(parse_quantity("70 um", unit::length), 70e-6);
  EXPECT_EQ(parse_quantity("0.4nm", unit::length), 0.4e-9);
  EXPECT_EQ(parse_quantity("80ms", unit::time), 0.08);
  EXPECT_EQ(parse_quantity("1.5e-3 mm", unit::length), 1.5e-6);
  EXPECT_EQ(parse_quantity("2751.6 mm^3", unit::volume), 2751.6e-9);
  EXPECT_EQ(parse_quantity("1.7 \u00b5m", unit::length), 1.7e-6);
}

TEST(Units, UnitsOfTheInterfaceHaveTheirFactors) {
  EXPECT_DOUBLE_EQ(parse_quantity("36 L/min", unit::flow_rate), 36e-3 / 60.0);
  EXPECT_DOUBLE_EQ(parse_quantity("36 lpm", unit::flow_rate), 36e-3 / 60.0);
  EXPECT_DOUBLE_EQ(parse_quantity("2.4 kPa", unit::pressure), 2400.0);
  EXPECT_DOUBLE_EQ(parse_quantity("3.6e-3 J/m^2", unit::surface_energy), 3.6e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("3.6 mN/m", unit::surface_energy), 3.6e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("1e-6 kg/(m s)", unit::diffusion), 1e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("1.82e-5 Pa s", unit::viscosity), 1.82e-5);
  EXPECT_DOUBLE_EQ(parse_quantity("1.5 g/cm^3", unit::density), 1500.0);
  EXPECT_DOUBLE_EQ(parse_quantity("1 min", unit::time), 60.0);
  EXPECT_DOUBLE_EQ(parse_quantity("180 deg", unit::angle), 3.14159265358979323846);
  EXPECT_DOUBLE_EQ(parse_quantity("1e12 1/m^3", unit::number_density), 1e12);
  EXPECT_DOUBLE_EQ(parse_quantity("5 %", unit::number), 0.05);
}

TEST(Units, ANumberWithoutUnitIsSI) { EXPECT_EQ(parse_quantity("0.25", unit::length), 0.25); }

TEST(Units, AnotherDimensionIsRefusedNamingBoth) {
  const std::string text = complaint("3 s", unit::length);
  EXPECT_NE(text.find("a time [s]"), std::string::npos) << text;
  EXPECT_NE(text.find("a length [m]"), std::string::npos) << text;
  EXPECT_NE(complaint("1 kg/m^2", unit::density), "");
  EXPECT_NE(complaint("1 m", unit::number), "");
}

TEST(Units, NonsenseIsRefused) {
  for (const char* text : {"", "m", "1 parsec", "1 m^", "1 m^99", "1 (m", "1 m)", "1e999 m", "nan m", "inf", "1 m//s",
                           "1 ((((((((((m))))))))))", "--1 m", "1 m^x", "0x10 m", "1,5 mm"})
    EXPECT_NE(complaint(text, unit::length), "") << text;
}

TEST(Units, TheShortestTextReadsBackAsTheSameNumber) {
  for (const double value : {0.1, 1.0 / 3.0, 2.34e-4, 6.02214076e23, -0.0, 5e-324})
    EXPECT_EQ(parse_quantity(format_quantity(value, unit::length), unit::length), value);
}

TEST(Spelling, DistanceCountsSlips) {
  EXPECT_EQ(edit_distance("surface_enrgy", "surface_energy"), 1);
  EXPECT_EQ(edit_distance("heigth", "height"), 1);  // neighbours swapped
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(Spelling, OnlyNearWordsAreSuggested) {
  const std::vector<std::string> words{"density", "diameter"};
  EXPECT_EQ(nearest("diametre", words), "diameter");
  EXPECT_EQ(nearest("viscosity", words), "");
}

}  // namespace
}  // namespace puffin::cases
