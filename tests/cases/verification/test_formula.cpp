// Formulas of verification files.

#include <gtest/gtest.h>

#include <cmath>

#include "cases/verification/formula.hpp"

namespace puffin::cases {
namespace {

double value(const char* text, const std::map<std::string, double>& known = {}) { return Formula(text)(known); }

TEST(Formula, PrecedenceIsThatOfAlgebra) {
  EXPECT_EQ(value("2 + 3*4^2/8 - 1"), 7.0);
  EXPECT_EQ(value("2^3^2"), 512.0);
  EXPECT_EQ(value("-2^2"), -4.0);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("8 - 4 - 2"), 2.0);
  EXPECT_EQ(value("8/4/2"), 1.0);
  EXPECT_EQ(value("(1 + 1e-3*1000)*2"), 4.0);
  EXPECT_EQ(value("1 < 2"), 1.0);
  EXPECT_EQ(value("(3 <= 2) + (2 >= 2)"), 1.0);
  EXPECT_EQ(value("(id == 3)*(1 + 1 != 3)", {{"id", 3.0}}), 1.0);
  EXPECT_EQ(value("(id == 3) + (2 != 1 + 1)", {{"id", 4.0}}), 0.0);
}

TEST(Formula, FunctionsAndNamesAreThoseOfTheLibrary) {
  EXPECT_EQ(value("sin(pi/6)*cos(0) + sqrt(16)"), std::sin(3.14159265358979323846 / 6) + 4.0);
  EXPECT_EQ(value("max(a_1, b.c) - min(a_1, b.c)", {{"a_1", 2.0}, {"b.c", 5.0}}), 3.0);
  EXPECT_EQ(value("atan2(1, -1)"), std::atan2(1.0, -1.0));
  EXPECT_EQ(Formula("u*u + v + u").names(), (std::vector<std::string>{"u", "v"}));
}

TEST(Formula, MistakesNameTheColumnAndWhatIsWanted) {
  const auto message = [](const char* text) -> std::string {
    try {
      (void)value(text, {{"speed", 1.0}});
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("2 + ").find("column 5: expected a number"), std::string::npos) << message("2 + ");
  EXPECT_NE(message("(2").find("expected ')'"), std::string::npos);
  EXPECT_NE(message("2 3").find("expected an operator"), std::string::npos);
  EXPECT_NE(message("sine(2)").find("expected a function"), std::string::npos);
  EXPECT_NE(message("sped*2").find("did you mean 'speed'"), std::string::npos) << message("sped*2");
  EXPECT_NE(message(std::string(1000, '(').c_str()).find("fewer brackets"), std::string::npos);
}

}  // namespace
}  // namespace puffin::cases
