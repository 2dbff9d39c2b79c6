// Air that carriers load: those at rest, those beside walls, more of them than a cell can bear.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "cases/build.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases {
namespace {

using Eigen::Vector3d;

/// Air at 1 m/s through a duct of 4 x 1 x 0.6 mm, with 100 carriers on its floor between 1.6 and 2.3 mm; `more` of
/// their table, and `skip`.
std::string strewn_floor(const std::string& more, const std::string& skip = "") {
  std::string list;
  for (int n = 0; n < 100; ++n) {
    char text[120];
    std::snprintf(text, sizeof text, "{ position = [%.6g, %.6g, 3.5e-5], diameter = 7e-5, density = 1520 },\n",
                  1.6e-3 + 7.12e-5 * (n / 10), 1.2e-4 + 8.45e-5 * (n % 10));
    list += text;
  }
  return R"(
schema = 1
name = "strewn floor"
[geometry]
generator = "duct"
[geometry.duct]
length = "4 mm"
width = "1 mm"
height = "0.6 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
velocity = "1 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.1 mm"
)" + (skip.empty() ? "" : "[numerics.skip]\n" + skip + "\n") +
         R"([carriers]
rotation = false
)" + more +
         "\nlist = [\n" + list + R"(]
[carriers.adhesion]
model = "hamaker"
surface_energy = "3.6e-3 J/m^2"
[stop]
time = "3 ms"
when_empty = false
)";
}

/// What is left of the air's speed over the carriers, and the pressure that drives it, over the time from `until`
/// to 1.2 times that.
struct Blown {
  double near_floor = 0.0;  // [m/s] half a cell above it, in the middle of the carriers
  double drop = 0.0;        // [Pa] between cells before and behind them
  int at_rest = 0;
  coupling::MomentumBooking momentum;
};

Blown blow(const std::string& text, double until = 3e-3) {
  const auto sim = build(parse_case(text, "blown.toml"));
  coupling::State& s = sim->state;
  while (s.time < until * (1.0 - 1e-12)) coupling::advance(sim->models, until, s);
  const auto& rows = s.air->rows;
  const auto at = [&](const Vector3d& x) {
    const Vector3d cell = (x - rows.origin()) / rows.dx();
    return lbm::moments_at(
        *s.air, rows.active_slot(static_cast<int>(std::lround(cell[0])), static_cast<int>(std::lround(cell[1])),
                                 static_cast<int>(std::lround(cell[2]))));
  };
  Blown b;
  int read = 0;
  for (const double end = 1.2 * until; s.time < end * (1.0 - 1e-12); ++read) {  // means: the last interval may be short
    coupling::advance(sim->models, end, s);
    b.near_floor += at({2.05e-3, 0.55e-3, 0.05e-3}).ux * s.scale.speed();
    b.drop += s.scale.pressure(at({1.25e-3, 0.55e-3, 0.35e-3}).density_excess) -
              s.scale.pressure(at({2.75e-3, 0.55e-3, 0.35e-3}).density_excess);
  }
  b.near_floor /= read, b.drop /= read;
  for (const dem::Rest rest : s.carriers.carriers.rest) b.at_rest += rest != dem::Rest::awake;
  b.momentum = s.momentum;
  return b;
}

// All rest and none moves, awake or not: the air that flows past them settles to the same flow. What differs is how
// late the reaction follows: nothing in a flow that has settled. What changes a profile of a fixed flow rate most
// slowly is odd across it and decays in h^2/(4 pi^2 nu) = 0.6 mm squared/(39.5 * 1.5e-5) = 0.61 ms, five of which have
// passed: e^-5, so 1 % of what they change.
TEST(LoadedAir, RestingCarriersSlowTheAirAsThoseThatAreKeptAwakeDo) {
  const Blown free = blow(strewn_floor("two_way = false"));
  const Blown awake = blow(strewn_floor("", "sleeping_carriers = false"));
  const Blown asleep = blow(strewn_floor("")), held = blow(strewn_floor("start = \"1 s\""));
  EXPECT_EQ(awake.at_rest, 0);
  EXPECT_EQ(asleep.at_rest, 100);
  EXPECT_EQ(held.at_rest, 100);
  EXPECT_LT(awake.near_floor, 0.75 * free.near_floor) << "they are felt";
  EXPECT_GT(awake.drop, 1.03 * free.drop);
  for (const Blown* b : {&asleep, &held}) {
    EXPECT_NEAR(b->near_floor, awake.near_floor, 0.01 * (free.near_floor - awake.near_floor));
    EXPECT_NEAR(b->drop, awake.drop, 0.01 * (awake.drop - free.drop));
    EXPECT_GT(b->momentum.exchanged, 0.0);
    EXPECT_LT((b->momentum.given - b->momentum.taken).norm(), 1e-12 * b->momentum.exchanged);
  }
}

// Beside a wall a carrier has up to 3 times the drag along it and 1,000 times across it: the cells are asked for no
// more than they have. It diverged at once.
TEST(LoadedAir, DragBesideWallsIsNoMoreThanTheCellsCanGive) {
  for (const char* sleeping : {"false", "true"}) {
    const Blown b = blow(strewn_floor("near_wall = true", std::string("sleeping_carriers = ") + sleeping), 1e-3);
    const Blown without = blow(strewn_floor("", std::string("sleeping_carriers = ") + sleeping), 1e-3);
    EXPECT_GT(b.near_floor, 0.0) << sleeping;
    EXPECT_LT(b.near_floor, without.near_floor) << "more drag: slower air";
    EXPECT_GT(b.drop, without.drop);
  }
}

// 512 carriers that nothing moves fill a cube to 0.52; the load of a step of 0.01 lattice units is 0.15, so that three
// steps are not cut short. With the air read in the
// last step of an odd number alone, what changes sign from step to step grew by 1 + load/steps an exchange.
TEST(LoadedAir, ADenseBedStaysQuietAtEveryInterval) {
  std::array<double, 3> drop{};
  const std::array<int, 3> intervals{1, 2, 3};
  for (std::size_t n = 0; n < intervals.size(); ++n) {
    const auto sim = build(parse_case(R"(
schema = 1
name = "dense bed"
[geometry]
generator = "duct"
[geometry.duct]
length = "4 mm"
width = "1 mm"
height = "1 mm"
[air]
density = "1.204 kg/m^3"
viscosity = "1.82e-5 Pa s"
[[air.boundary]]
patch = "inlet"
type = "velocity-inlet"
velocity = "2 m/s"
[[air.boundary]]
patch = "outlet"
type = "pressure-outlet"
[numerics]
dx = "0.2 mm"
lattice_speed = 0.01
coupling_interval = )" + std::to_string(intervals[n]) +
                                          R"(
[carriers]
count = 512
diameter = "70 um"
density = "1e6 kg/m^3"
gravity = [0, 0, 0]
drag = "beetstra"
fill = { shape = "cube", at = [2e-3, 0.5e-3, 0.0], gap = 0.001 }
[carriers.contact]
stiffness = "10 N/m"
[stop]
time = "4 ms"
when_empty = false
)",
                                      "bed.toml"));
    coupling::State& s = sim->state;
    while (s.time < 4e-3 * (1.0 - 1e-12)) ASSERT_NO_THROW(coupling::advance(sim->models, 4e-3, s)) << intervals[n];
    const auto& rows = s.air->rows;
    drop[n] = s.scale.pressure(lbm::moments_at(*s.air, rows.active_slot(2, 2, 2)).density_excess);
    EXPECT_LT(s.extremes.max_speed_lu, 0.3) << intervals[n];
    EXPECT_LT(static_cast<double>(s.effort.exchanges), 1.1 * s.air->steps / intervals[n] + 1.0) << intervals[n];
  }
  // The steady drop does not know the interval, as the drag is not limited. Sound of the start, a fifth of the drop at
  // 1 ms, dies with its own reflections: 35.04 to 35.09 Pa at 2 ms, 35.280 at 4 ms.
  EXPECT_NEAR(drop[1], drop[0], 1e-3 * drop[0]);
  EXPECT_NEAR(drop[2], drop[0], 1e-3 * drop[0]);
}

}  // namespace
}  // namespace puffin::cases
