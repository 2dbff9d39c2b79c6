// What a run says of impacts and of drag beyond the range of a law of its fines.

#include "tools/puffin/law_limits.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "cases/read_case.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {

void log_warning(const std::string&) {}  // the terminal's part, which is not asked here

namespace {

/// A carrier in air at rest.
std::unique_ptr<cases::Simulation> scene() {
  auto s = cases::build(cases::parse_case(R"toml(
schema = 1
name = "limits"
[geometry]
generator = "box"
[geometry.box]
x = "1 mm"
y = "1 mm"
z = "1 mm"
[air]
model = "frozen"
density = "1.2 kg/m^3"
viscosity = "1.8e-5 Pa s"
field = "uniform"
velocity = [0.0, 0.0, 0.0]
[numerics]
dx = "0.1 mm"
[carriers]
list = [{ position = [5e-4, 5e-4, 5e-4], velocity = [0, 0, 0], diameter = 7e-5, density = 1520 }]
[fines]
[[fines.scalar]]
name = "drug"
[stop]
time = "1 ms"
)toml",
                                          "limits.toml"));
  s->models.settling = false;
  s->state.loads.assign(1, dem::Load{});
  s->models.fines.emplace();
  return s;
}

/// Valid from 1 to 10 m/s; takes a tenth of what flies slower than 2 m/s, or nothing of it, and a tenth beyond.
micromodels::Law law(double slow) { return micromodels::PowerLaw({slow, 0.0, 2.0, 0.1, 0.0}, {1.0, 10.0}); }

std::vector<std::string> told_of_impact(bool wall, double speed, const micromodels::FinesModels& laws) {
  const auto s = scene();
  s->models.fines = laws;
  dem::ContactBegun contact;
  contact.a = 0;
  contact.b = wall ? -1 : 1;
  contact.normal_speed = speed;
  contact.time = 2e-4;
  s->state.events.begun.assign(3, contact);  // the first is told
  std::vector<std::string> warnings;
  warn_beyond_laws(*s, warnings);
  return warnings;
}

std::vector<std::string> told_of_slip(double slip, const micromodels::FinesModels& laws) {
  const auto s = scene();
  s->models.fines = laws;
  s->state.loads[0].air_velocity = {0.0, slip, 0.0};
  std::vector<std::string> warnings;
  for (int n = 0; n < 2; ++n) warn_beyond_laws(*s, warnings);
  return warnings;
}

using Texts = std::vector<std::string>;
constexpr const char* faster = "is faster than its law was made for, 10 m/s";
constexpr const char* slower = "is slower than its law was made for, 1 m/s";

TEST(LawLimits, ImpactsOnBothSidesOfTheRangeAreToldOnce) {
  micromodels::FinesModels laws;
  laws.wall_detach = laws.particle_detach = law(0.1);
  const std::string at = " m/s (t = 0.0002 s), ";
  EXPECT_EQ(told_of_impact(true, 12.0, laws), Texts{"micro-models: an impact on a wall, at 12" + at + faster});
  EXPECT_EQ(told_of_impact(true, 0.5, laws), Texts{"micro-models: an impact on a wall, at 0.5" + at + slower});
  EXPECT_EQ(told_of_impact(false, 12.0, laws), Texts{"micro-models: an impact between carriers, at 12" + at + faster});
  EXPECT_EQ(told_of_impact(false, 0.5, laws), Texts{"micro-models: an impact between carriers, at 0.5" + at + slower});
  EXPECT_EQ(told_of_impact(true, 5.0, laws), Texts{});
}

TEST(LawLimits, SlowImpactsThatTakeNothingAreNotTold) {
  micromodels::FinesModels laws;
  laws.wall_detach = laws.wall_attach = laws.particle_detach = law(0.0);
  for (const bool wall : {true, false}) EXPECT_EQ(told_of_impact(wall, 0.5, laws), Texts{});
  laws.wall_attach = law(0.1);  // one of the two is enough
  EXPECT_EQ(told_of_impact(true, 0.5, laws).size(), 1u);
}

TEST(LawLimits, SlipOnBothSidesOfTheRangeIsToldOnce) {
  micromodels::FinesModels laws;
  laws.drag_detach = law(0.1);
  EXPECT_EQ(told_of_slip(12.0, laws),
            Texts{std::string("micro-models: the drag on a carrier, at 12 m/s (t = 0 s), ") + faster});
  EXPECT_EQ(told_of_slip(0.5, laws),
            Texts{std::string("micro-models: the drag on a carrier, at 0.5 m/s (t = 0 s), ") + slower});
  EXPECT_EQ(told_of_slip(5.0, laws), Texts{});
  laws.drag_detach = law(0.0);
  EXPECT_EQ(told_of_slip(0.5, laws), Texts{});
}

TEST(LawLimits, WhatARetreatUndoesIsForgotten) {
  micromodels::FinesModels laws;
  laws.wall_detach = law(0.1);
  Texts warnings = told_of_impact(true, 12.0, laws);
  forget_beyond_laws(3e-4, warnings);
  EXPECT_EQ(warnings.size(), 1u);
  forget_beyond_laws(1e-4, warnings);
  EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace puffin::tools
