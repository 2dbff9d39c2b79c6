// Refusal of nonsense, the friction law's values, and what is kept between steps.

#include <gtest/gtest.h>

#include <limits>

#include "dem/gather.hpp"
#include "dem/surface_law.hpp"
#include "tests/dem/scene.hpp"

using namespace puffin::dem;
using namespace puffin::dem::testing;

namespace {

/// The models after `spoil`, to be checked.
template <class Spoil>
void expect_refused(Spoil spoil, const std::string& named) {
  Models models;
  spoil(models, std::get<LinearContact>(models.carrier.contact));
  try {
    check(models);
    ADD_FAILURE() << named << " was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
  }
}

}  // namespace

TEST(Models, NonsenseIsRefusedByName) {
  EXPECT_NO_THROW(check(Models{}));
  expect_refused([](Models&, LinearContact& c) { c.restitution = 0.0; }, "restitution");
  expect_refused([](Models&, LinearContact& c) { c.restitution = 1.1; }, "restitution");
  expect_refused([](Models&, LinearContact& c) { c.friction = ConstantFriction{-0.1}; }, "friction");
  expect_refused([](Models&, LinearContact& c) { c.friction = SpeedFriction{.5, .2, .1, 2.0, 1.0}; }, "limit_speed");
  expect_refused([](Models&, LinearContact& c) { c.stiffness = -1.0; }, "stiffness");
  expect_refused([](Models&, LinearContact& c) { c.max_overlap = 0.5; }, "max_overlap");
  expect_refused([](Models& m, LinearContact&) { m.carrier.adhesion = Hamaker{}; }, "surface_energy");
  expect_refused(
      [](Models& m, LinearContact&) {
        m.carrier.adhesion = Hamaker{3.6e-3, 2.2e-19, 4e-10, {}};
      },
      "hamaker");
  expect_refused([](Models& m, LinearContact&) { m.integration.steps_per_contact = 2; }, "steps_per_contact");
  expect_refused([](Models& m, LinearContact&) { m.gravity.x() = std::numeric_limits<double>::quiet_NaN(); },
                 "gravity");
  expect_refused([](Models& m, LinearContact&) { m.integration.wake_change = 0.5; }, "wake_change");
}

TEST(Models, CarriersAndStepsThatMakeNoSenseAreRefused) {
  Scene s;
  Carrier bad = lactose(3, {0, 0, 0});
  bad.mass = 0.0;
  EXPECT_THROW(s.add(bad), std::invalid_argument);
  s.add(lactose(1, {0, 0, 0}));
  EXPECT_THROW(s.step(0.0), std::invalid_argument);
  s.loads.clear();
  EXPECT_THROW(s.step(1e-6), std::invalid_argument);
}

// Ends and middle of the speed-dependent friction of eq. 2.4: stick at rest, slip at slip_speed, limit beyond.
TEST(Models, FrictionFallsFromStickToSlipToLimit) {
  Surfaces surfaces;
  std::get<LinearContact>(surfaces.contact).friction = SpeedFriction{0.5, 0.2, 0.1, 1.0, 10.0};
  const SurfaceLaw law(surfaces);
  EXPECT_DOUBLE_EQ(law.friction(0.0), 0.5);
  EXPECT_DOUBLE_EQ(law.friction(0.5), 0.5 - 0.3 * 0.75);
  EXPECT_DOUBLE_EQ(law.friction(1.0), 0.2);
  EXPECT_DOUBLE_EQ(law.friction(5.5), 0.15);
  EXPECT_DOUBLE_EQ(law.friction(40.0), 0.1);
}

TEST(Clusters, KeepNoRoomForABedThatIsGone) {
  Gathering g;
  g.clusters.resize(3);
  g.clusters[0].bodies.reserve(2500);  // held the bed before, holds a pair now
  g.clusters[1].bodies.reserve(2500);  // holds the bed
  g.clusters[2].bodies.reserve(2500);  // is not used in this step
  g.member_begin = {0, 2, 2002};
  g.used = 2;
  give_back(g);
  EXPECT_EQ(g.clusters[0].bodies.capacity(), 0u);
  EXPECT_GE(g.clusters[1].bodies.capacity(), 2500u);
  EXPECT_EQ(g.clusters[2].bodies.capacity(), 0u);
}
