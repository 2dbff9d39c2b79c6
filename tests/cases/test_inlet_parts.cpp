// Inlets of several faces that do not touch: each is an opening of its own, with one mean speed for all.

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/assessment.hpp"
#include "cases/build.hpp"
#include "cases/check_boundaries.hpp"
#include "cases/inlet_profile.hpp"
#include "tests/cases/vented_duct.hpp"

namespace puffin::cases {
namespace {

using test::VentedDuct;

const std::string one_litre = "flow_rate = \"1 L/min\"";
constexpr double face = 16e-6;  // [m^2]

/// What the links of each part bring at a mean speed of 1 [m^3/s over m/s].
std::vector<double> brought(const Simulation& s, std::size_t parts) {
  std::vector<double> sums(parts, 0.0);
  for (const auto& link : s.state.air->links.inlets) sums.at(link.part) += link.gain * s.dx * s.dx;
  return sums;
}

Vec3 air_at(const Simulation& s, const Vec3& x) {
  const auto& rows = s.state.air->rows;
  const Vec3 cell = (x - rows.origin()) / s.dx;
  const auto m = lbm::moments_at(
      *s.state.air, rows.active_slot(static_cast<int>(cell[0]), static_cast<int>(cell[1]), static_cast<int>(cell[2])));
  return {m.ux, m.uy, m.uz};
}

}  // namespace

// The cells fit the faces: rounding alone. (Through the end alone, which the mean normal looks along, all came in.)
TEST(InletParts, EachFaceBringsItsShareOfTheFlowAtTheSpeedThatCheckSays) {
  const VentedDuct duct(true);
  const Case c = duct.with(one_litre);
  const auto s = build(c);
  const std::vector<double> flow = brought(*s, 3);
  for (const double q : flow) EXPECT_NEAR(q, face, 1e-6 * face);  // gains come from links cut at float distances
  const auto& inlet = s->models.patches[s->surface.patches.find("inlet")];
  EXPECT_NEAR(inlet.area, 3.0 * face, 1e-9 * face);
  EXPECT_NEAR(inlet.speed(0.0) * (flow[0] + flow[1] + flow[2]), 1e-3 / 60.0, 1e-6 * 1e-3 / 60.0);
  const Assessment a = assess(c, s->surface);
  EXPECT_EQ(a.inlets.at(0).largest_mean_speed, inlet.speed(0.0));
  EXPECT_EQ(s->reference_speed, a.reference_speed);
  EXPECT_EQ(s->models.time_step.reference_dt, a.lattice->dt);
}

// They were refused as without a direction. In the first steps, before any jet meets the other, the air beside each
// vent goes in.
TEST(InletParts, TwoVentsThatLookAtEachOtherBothBlow) {
  const auto s = build(VentedDuct(false).with(one_litre));
  for (int n = 0; n < 10; ++n) coupling::advance(s->models, s->description.stop.time, s->state);
  const double speed = s->models.patches[s->surface.patches.find("inlet")].speed(0.0) * s->state.scale.dt / s->dx;
  EXPECT_GT(air_at(*s, {4e-3, 0.25e-3, 2e-3}).y(), 0.5 * speed);
  EXPECT_LT(air_at(*s, {4e-3, 3.75e-3, 2e-3}).y(), -0.5 * speed);
}

// A square duct has 2.096256 of the mean in its middle (exact series; tests/cases/test_inlet_profile.cpp).
TEST(InletParts, EachFaceHasAProfileOfItsOwn) {
  const VentedDuct duct(true);
  const Case c = duct.with("velocity = \"1 m/s\"\nprofile = \"duct\"");
  const Surface s = load_surface(c);
  const Boundary& b = c.air.boundaries[0];
  const auto shape = profile_of(b, s, inlet_of(c, s, b)).shape;
  EXPECT_LT((shape({0, 2e-3, 2e-3}) - Vec3(2.096256, 0, 0)).norm(), 1e-5);
  EXPECT_LT((shape({4e-3, 0, 2e-3}) - Vec3(0, 2.096256, 0)).norm(), 1e-5);
  EXPECT_LT((shape({4e-3, 4.01e-3, 2e-3}) - Vec3(0, -2.096256, 0)).norm(), 1e-5) << "a little beyond the face";
  for (const double q : brought(*build(c), 3)) EXPECT_NEAR(q, face, 1e-6 * face);
}

// (3, 4, 0) m/s brings 3 m/s through the end. The vents look against each other, so it leaves by one of them.
TEST(InletParts, AVectorThatLeavesByOneFaceIsRefusedWithThatFace) {
  const VentedDuct duct(true);
  const Case c = duct.with("velocity = [3.0, 4.0, 0.0]");
  const auto problems = boundary_problems(c, load_surface(c));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].to_string().find("the part of 'inlet' around"), std::string::npos) << problems[0].to_string();
}

// Through the end and the lower vent alone, as tagged by their places: 3 and 4 m/s on equal faces, a mean of 3.5.
TEST(InletParts, AVectorGoesItsWayThroughAllFaces) {
  const VentedDuct duct(true);
  Case c = duct.with("velocity = [3.0, 4.0, 0.0]");
  c.geometry.patches = {{"upper", "near:[0.004, 0.004, 0.002]"}};
  const auto s = build(c);
  const auto& inlet = s->models.patches[s->surface.patches.find("inlet")];
  EXPECT_NEAR(inlet.speed(0.0), 3.5, 1e-9);
  const std::vector<double> flow = brought(*s, 2);
  EXPECT_NEAR(inlet.speed(0.0) * flow[0], 3.0 * face, 1e-5 * face);
  EXPECT_NEAR(inlet.speed(0.0) * flow[1], 4.0 * face, 1e-5 * face);
  const auto& shape = s->state.air->boundaries[s->surface.patches.find("inlet")].profile;
  for (const Vec3& x : {Vec3(0, 2e-3, 2e-3), Vec3(4e-3, 0, 2e-3)})
    EXPECT_LT((3.5 * shape(x) - Vec3(3, 4, 0)).norm(), 1e-9);
}

TEST(InletParts, AFileOnFacesThatLookDifferentWaysIsRefused) {
  const VentedDuct duct(true);
  Case c = duct.with("velocity = \"1 m/s\"");
  c.air.boundaries[0].profile = Profile::file;
  const Surface s = load_surface(c);
  EXPECT_THROW(inlet_of(c, s, c.air.boundaries[0]), lbm::geometry::GeometryError);
}

// Each part has fluctuations of its own whose net flow is none, so the flow stays what is asked for. Floats: 1e-5.
TEST(InletParts, TurbulenceBringsNoFlowThroughAnyFace) {
  const auto s = build(VentedDuct(true).with(one_litre + "\nturbulence = 0.1"));
  ASSERT_EQ(s->models.turbulence.size(), 3u);
  for (const auto& t : s->models.turbulence) {
    std::vector<float> gain(s->state.air->links.inlets.size(), 0.0F);
    lbm::add_fluctuation(t, 3.0, 1.0, gain);
    double net = 0.0, most = 0.0;
    for (const auto l : t.links) net += gain[l], most = std::max(most, std::abs(static_cast<double>(gain[l])));
    EXPECT_GT(most, 1e-3);
    EXPECT_NEAR(net, 0.0, 1e-5);
  }
}

}  // namespace puffin::cases
