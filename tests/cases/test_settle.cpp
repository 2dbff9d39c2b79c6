// A bed that falls into place before the run.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cases/settle.hpp"

namespace puffin::cases {
namespace {

using Vec3 = Eigen::Vector3d;

/// A floor at z = 0 without end.
class Floor : public dem::Walls {
 public:
  dem::RestOfWall near(const Vec3& c, double reach, std::vector<dem::WallTouch>& touches) const override {
    touches.clear();
    if (c.z() <= reach) touches.push_back({{c.x(), c.y(), 0.0}, c.z(), 0});
    return {};
  }
  double clearance(const Vec3& c, double limit) const override { return std::clamp(c.z(), 0.0, limit); }
  bool inside(const Vec3& c) const override { return c.z() > 0.0; }
};

dem::Carrier sphere(std::int64_t id, double radius, const Vec3& position) {
  dem::Carrier c;
  c.id = id;
  c.radius = radius;
  c.mass = 1520.0 * 4.0 / 3.0 * M_PI * std::pow(radius, 3);
  c.position = position;
  return c;
}

dem::Models under_gravity(double g) {
  dem::Models models;
  models.gravity = {0, 0, -g};
  std::get<dem::LinearContact>(models.carrier.contact).friction = dem::ConstantFriction{0.5};
  models.carrier.adhesion = dem::Hamaker{3.6e-3};
  models.wall = models.carrier;
  return models;
}

}  // namespace

// Forty carriers dropped on a floor: all at rest on it or on each other, none below it; loosened to half its density it
// has that within 0.2 %, on the same floor.
TEST(Settle, ABedComesToRestAndIsLoosenedToTheDensityAskedFor) {
  dem::Models models = under_gravity(9.81);
  std::vector<dem::Carrier> carriers;
  for (int n = 0; n < 40; ++n) {
    const int column = n % 3, row = n / 3 % 3, layer = n / 9;
    carriers.push_back(
        sphere(n, 75e-6, {180e-6 * column + 7e-6 * (n % 5), 180e-6 * row - 5e-6 * (n % 7), 180e-6 * layer + 90e-6}));
  }
  const SettledBed bed = settle(models, Floor(), carriers);
  EXPECT_TRUE(bed.at_rest);
  double lowest = 1.0;
  for (std::size_t n = 0; n < carriers.size(); ++n) {
    EXPECT_GT(bed.positions[n].z(), 0.98 * 75e-6);
    carriers[n].position = bed.positions[n];
    lowest = std::min(lowest, bed.positions[n].z());
  }
  const double settled = bulk_density(carriers, Vec3::UnitZ());
  EXPECT_GT(settled, 300.0);
  EXPECT_LT(settled, 1100.0);
  loosen(0.5 * settled, Vec3::UnitZ(), carriers);
  EXPECT_NEAR(bulk_density(carriers, Vec3::UnitZ()), 0.5 * settled, 2e-3 * settled);
  double still_lowest = 1.0;
  for (const auto& c : carriers) still_lowest = std::min(still_lowest, c.position.z());
  EXPECT_NEAR(still_lowest, lowest, 1e-12);
  EXPECT_THROW(loosen(3.0 * settled, Vec3::UnitZ(), carriers), std::invalid_argument);
  models.gravity.setZero();
  EXPECT_THROW(settle(models, Floor(), carriers), std::invalid_argument);
}

// g = 0.05 m/s^2: after the 2 ms that a bed must be still a sphere has fallen 0.1 um at 0.1 mm/s, far below what counts
// as still, from half its diameter over the floor (55 ms away).
TEST(Settle, UnderLowGravityABedFallsBeforeItIsCalledStill) {
  const double radius = 75e-6;
  const SettledBed bed = settle(under_gravity(0.05), Floor(), {sphere(0, radius, {0, 0, 2.0 * radius})});
  EXPECT_TRUE(bed.at_rest);
  EXPECT_NEAR(bed.positions[0].z(), radius, 0.02 * 2.0 * radius);  // at most the overlap that an impact may have
}

// A sphere of 2 mm falls on one of 4 um. Settling spheres may give by 2 % of their diameter, 40 um: the small one has
// no room left under the large one.
TEST(Settle, ACarrierPressedThroughAWallIsNamed) {
  const double large = 1e-3, small = 2e-6;
  try {
    settle(under_gravity(9.81), Floor(),
           {sphere(0, large, {0, 0, 2.0 * small + large + 0.2e-3}), sphere(1, small, {0, 0, small})});
    ADD_FAILURE() << "nothing was said";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("presses carrier 1, of 4 um, through a wall"), std::string::npos) << e.what();
  }
}

}  // namespace puffin::cases
