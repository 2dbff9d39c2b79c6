#include "coupling/drag.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace {
using namespace puffin::coupling;
using std::numbers::pi;

const Air air{1.204, 1.82e-5};

TEST(Drag, SchillerNaumannReturnsItsTable) {
  // Re, C_d computed from 24/Re (1 + 0.15 Re^0.687), printed with 4 decimals: half a unit in the last place.
  const std::array<std::array<double, 2>, 11> table{{{0.1, 247.4012},
                                                     {1, 27.6000},
                                                     {10, 4.1511},
                                                     {20, 2.6095},
                                                     {50, 1.5381},
                                                     {100, 1.0917},
                                                     {150, 0.9102},
                                                     {200, 0.8056},
                                                     {300, 0.6839},
                                                     {500, 0.5627},
                                                     {1000, 0.4383}}};
  for (const auto& [re, cd] : table) EXPECT_NEAR(24.0 / re * SchillerNaumann{}.factor(re, 0.0), cd, 5.1e-5) << re;
}

TEST(Drag, SchillerNaumannAgreesWithResolvedFlowAtReynolds100) {
  // Johnson & Patel, J. Fluid Mech. 378, 19 (1999): C_d = 1.087; the correlation is good to 5 %.
  EXPECT_NEAR(24.0 / 100.0 * SchillerNaumann{}.factor(100.0, 0.0), 1.087, 0.05 * 1.087);
}

TEST(Drag, SchillerNaumannKeepsItsCoefficientAbove1000) {
  EXPECT_DOUBLE_EQ(SchillerNaumann{}.factor(5000.0, 0.0), 5.0 * SchillerNaumann{}.factor(1000.0, 0.0));
  EXPECT_NEAR(SchillerNaumann{}.factor(1000.0001, 0.0) / SchillerNaumann{}.factor(1000.0, 0.0), 1.0, 1e-6);
}

TEST(Drag, LawsAreStokesAtRest) {
  // beta = 3 pi mu d; Di Felice's fit ends at 4.8^2/24 = 0.96 of it.
  const double d = 70e-6, stokes = 3 * pi * air.viscosity * d;
  EXPECT_DOUBLE_EQ(drag_coefficient(DragLaw{SchillerNaumann{}}, air, d, 0.0, 0.0), stokes);
  EXPECT_DOUBLE_EQ(drag_coefficient(DragLaw{Beetstra{}}, air, d, 0.0, 0.0), stokes);
  EXPECT_NEAR(drag_coefficient(DragLaw{DiFelice{}}, air, d, 0.0, 0.0), 0.96 * stokes, 1e-14 * stokes);
  EXPECT_EQ(drag_coefficient(DragLaw{NoDrag{}}, air, d, 1.0, 0.0), 0.0);
}

TEST(Drag, DiFeliceReturnsDallaValleForASingleSphere) {
  // C_d = (0.63 + 4.8/sqrt(Re))^2 with phi = 0, so f = C_d Re/24; an identity up to rounding.
  for (const double re : {0.1, 1.0, 30.0, 400.0}) {
    const double root = 0.63 + 4.8 / std::sqrt(re);
    EXPECT_NEAR(DiFelice{}.factor(re, 0.0) / (root * root * re / 24.0), 1.0, 1e-14) << re;
  }
}

TEST(Drag, DiFeliceHasItsKnownExponents) {
  // f(phi)/f(0) at equal superficial Re is e^(1 - X) = e^-2.7 at Re -> 0 (X = 3.7) and e^-2.05 at Re_s = 10^1.5 (X
  // = 3.05).
  const double e = 0.7;
  EXPECT_NEAR(DiFelice{}.factor(0.0, 0.3) / DiFelice{}.factor(0.0, 0.0), std::pow(e, -2.7), 1e-13);
  const double re = std::pow(10.0, 1.5);
  EXPECT_NEAR(DiFelice{}.factor(re / e, 0.3) / DiFelice{}.factor(re, 0.0), std::pow(e, -2.05), 1e-13);
}

TEST(Drag, LawsForBedsRiseWithPacking) {
  for (const double re : {0.0, 0.1, 1.0, 10.0, 100.0}) {
    double felice = 0.0, beetstra = 0.0;
    for (double phi = 0.1; phi < 0.61; phi += 0.1) {
      EXPECT_GT(DiFelice{}.factor(re, phi), felice);
      EXPECT_GT(Beetstra{}.factor(re, phi), beetstra);
      felice = DiFelice{}.factor(re, phi);
      beetstra = Beetstra{}.factor(re, phi);
    }
  }
}

TEST(Drag, BeetstraReturnsAValueByHand) {
  // phi = 0.3, Re_s = 100 (so Re = 100/0.7): 10 phi/e^2 = 6.122449; e^2 (1 + 1.5 sqrt 0.3) = 0.892577;
  // 1/e + 3 e phi + 8.4 * 100^-0.343 = 1.428571 + 0.63 + 1.730929 = 3.789501; 1 + 10^0.9 * 100^-1.1 = 1.050119;
  // 0.413 * 100/(24 * 0.49) = 3.511905; product 12.673200; sum 19.688225, times e = 13.781758. The sum has 6 rounded
  // digits after the point.
  EXPECT_NEAR(Beetstra{}.factor(100.0 / 0.7, 0.3), 13.781758, 5e-6);
}

TEST(Drag, BeetstraReturnsCarmanKozenyInAStokesBed) {
  // Carman-Kozeny: F/(3 pi mu d e |v|) = 10 phi/e^2; the rest, e^2 (1 + 1.5 sqrt phi), is 2.0 % of it at phi = 0.6.
  const double phi = 0.6, e = 0.4;
  const double kozeny = e * 10.0 * phi / (e * e);
  EXPECT_NEAR(Beetstra{}.factor(0.0, phi) / kozeny, 1.0, 0.021);
}

TEST(Drag, TerminalVelocityOfLactoseIsThatOfTheTable) {
  // Columns: d [um], slip correction, v_t [m/s] with Schiller-Naumann, printed with 6 digits; g (1 - rho/rho_p),
  // divided drag by the slip correction (printed with 4 decimals, so 5e-5 relative). Fixed point iteration to 1e-10.
  const std::array<std::array<double, 3>, 6> table{{{1.9, 1.0900, 1.78940e-04},
                                                    {5, 1.0342, 1.17509e-03},
                                                    {10, 1.0171, 4.61285e-03},
                                                    {30, 1.0057, 4.01082e-02},
                                                    {100, 1.0017, 3.58331e-01},
                                                    {150.81, 1.0011, 6.67359e-01}}};
  for (const auto& [um, slip_correction, expected] : table) {
    const double d = um * 1e-6, weight = pi / 6 * d * d * d * (1520.0 - air.density) * 9.81;
    double v = 0.0;
    for (int n = 0; n < 200; ++n)
      v = weight * slip_correction / drag_coefficient(DragLaw{SchillerNaumann{}}, air, d, v, 0.0);
    EXPECT_NEAR(v / expected, 1.0, 6e-5) << um;
  }
}

TEST(Drag, DoesNotDependOnTheUnits) {
  // In millimetres, grams and milliseconds: beta [g/ms] = beta [kg/s], density in g/mm^3 = 1e-6, viscosity g/(mm ms) =
  // 1e-3.
  const Air other{1.204e-6, 1.82e-5 * 1e-3};
  for (const char* name : {"schiller-naumann", "di-felice", "beetstra"}) {
    const DragLaw law = drag_law(name);
    const double si = drag_coefficient(law, air, 70e-6, 12.0, 0.2);
    const double mm = drag_coefficient(law, other, 70e-3, 12.0, 0.2);
    EXPECT_NEAR(si / mm, 1e-3 * 1e3, 1e-12) << name;  // kg/s = 1e3 g / 1e3 ms; mm form: 1e-3 * 1e3
  }
}

TEST(Drag, AParcelHasTheDragOfItsSingleCarriers) {
  const std::vector<Eigen::Vector3d> u{{3, 0, 4}, {3, 0, 4}}, v(2, Eigen::Vector3d::Zero());
  const std::vector<double> radius{35e-6, 35e-6}, count{1.0, 10.0};
  std::vector<double> beta(2);
  drag_coefficients(SchillerNaumann{}, air, std::vector<int>{0, 1}, u, v, radius, count, {}, beta);
  EXPECT_DOUBLE_EQ(beta[0], drag_coefficient(SchillerNaumann{}, air, 70e-6, 5.0, 0.0));
  EXPECT_DOUBLE_EQ(beta[1], 10.0 * beta[0]);
}

TEST(Drag, UnknownNamesListTheKnownOnes) {
  EXPECT_EQ(drag_law("beetstra").index(), DragLaw(Beetstra{}).index());
  try {
    drag_law("stokes");
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("schiller-naumann, di-felice, beetstra, none"), std::string::npos);
  }
}
}  // namespace
