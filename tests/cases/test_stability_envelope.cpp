// What `puffin check` knows of the maps of stability.

#include "cases/stability_envelope.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "cases/search_path.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

const std::vector<EnvelopeRow> map{
    {Collision::rr3, Les::smagorinsky, 0.05, WallScheme::bouzidi, 0.10, 0.20, 0.20, "overshoot at 0.15"},
    {Collision::rr3, Les::smagorinsky, 0.10, WallScheme::bouzidi, 0.20, 0.20, 0.20, ""},
    {Collision::bgk, Les::smagorinsky, 0.10, WallScheme::bouzidi, 0.0, 0.0, 0.20, "step-inlet at 0.1"}};

Case with(Collision collision, double constant) {
  Case c = test::parse(test::sample);
  c.numerics.collision = collision;
  c.numerics.smagorinsky_constant = constant;
  return c;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(StabilityEnvelope, WhatRanIsNotTalkedAbout) {
  EXPECT_EQ(outside_envelope(with(Collision::rr3, 0.10), 0.5003, 0.10, map), "");
  EXPECT_EQ(outside_envelope(with(Collision::rr3, 0.14), 0.5003, 0.20, map), "");  // more viscosity than 0.10
  EXPECT_EQ(outside_envelope(with(Collision::bgk, 0.10), 0.51, 0.10, map), "");    // viscous: not what the map is about
}

// Two relaxation times ruin a shear wave in a periodic box at tau = 0.5087, where one keeps it.
TEST(StabilityEnvelope, TwoRelaxationTimesNeedMoreViscosityThanOthers) {
  EXPECT_NE(outside_envelope(with(Collision::trt, 0.10), 0.5087, 0.10, map), "");
  EXPECT_EQ(outside_envelope(with(Collision::trt, 0.10), 0.5125, 0.10, map), "");
  EXPECT_EQ(outside_envelope(with(Collision::bgk, 0.10), 0.5087, 0.10, map), "");
}

TEST(StabilityEnvelope, WhatDivergedHealedOrWasNotTriedIsNamed) {
  const std::string bgk = outside_envelope(with(Collision::bgk, 0.10), 0.5003, 0.10, map);
  EXPECT_TRUE(says(bgk, "bgk, smagorinsky 0.1, bouzidi diverged") && says(bgk, "step-inlet at 0.1")) << bgk;
  const std::string less = outside_envelope(with(Collision::rr3, 0.07), 0.5003, 0.15, map);  // counts as 0.05
  EXPECT_TRUE(says(less, "needed smaller steps") && says(less, "overshoot at 0.15")) << less;
  EXPECT_TRUE(says(outside_envelope(with(Collision::rr3, 0.10), 0.5003, 0.25, map), "beyond the map"));
  EXPECT_TRUE(says(outside_envelope(with(Collision::rr3, 0.02), 0.5003, 0.10, map), "not in the map"));
  EXPECT_TRUE(says(outside_envelope(with(Collision::trt, 0.10), 0.5003, 0.10, map), "not in the map"));
}

TEST(StabilityEnvelope, IsReadAsItWasWritten) {
  const std::string file = testing::TempDir() + "envelope.toml";
  std::ofstream(file) << write_envelope(map);
  EXPECT_EQ(read_envelope(file), map);
  std::ofstream(file) << "[[setting]]\ncollision = \"rr4\"\n";
  EXPECT_THROW(read_envelope(file), std::runtime_error);
}

TEST(StabilityEnvelope, TheShippedMapHoldsTheDefaults) {
  const std::vector<EnvelopeRow> shipped = read_envelope(stability_directory() / "envelope.toml");
  EXPECT_EQ(outside_envelope(test::parse(test::sample), 0.5003, 0.10, shipped), "");
  EXPECT_NE(outside_envelope(with(Collision::bgk, 0.10), 0.5003, 0.10, shipped), "");
}

}  // namespace
}  // namespace puffin::cases
