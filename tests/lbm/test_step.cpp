// A whole step of the air: collision and links in one pass.

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <set>

#include "lbm/link_schedule.hpp"
#include "tests/lbm/box_scene.hpp"

namespace puffin::lbm::test {
namespace {

using geometry::Vec3;

/// A duct of 13 chunks, whose walls lie at different distances from the cells: links to near and far walls.
Air make_duct(Boundary first, Boundary last) {
  Boundary lid{"", BoundaryKind::wall, [](const Vec3&) { return Vec3(0, 1, 0); }};
  BoxScene scene = make_box(Vec3(60, 30, 30), 1.0, {first, last, wall(), wall(), wall(), lid}, Vec3(0, 0.3, -0.2));
  Air air = make_air(scene, {});
  set_cells(
      [](const Vec3& x) {
        return InitialCell{0.01 * std::sin(x[0]), {0.02 * std::sin(0.3 * x[1]), 0.01, 0.02 * std::cos(x[2])}, {}};
      },
      air);
  return air;
}
Air make_open_duct() {
  return make_duct({"", BoundaryKind::velocity_inlet, [](const Vec3&) { return Vec3(1, 0, 0); }},
                   {"", BoundaryKind::pressure_outlet, {}});
}
Drive drive_of(const Air& air) {
  Drive drive = at_rest(air);
  drive.speed[0] = 0.05;
  drive.speed[5] = 0.03;
  return drive;
}

const auto& populations_of(const Air& air) { return std::get<Populations<float>>(air.populations).f; }

/// Steps in one pass with a number of threads, beside steps of collision and links one after the other.
void expect_equal_bits(const std::function<Air()>& make, int threads) {
  Air once = make(), twice = make();
  ASSERT_GT(once.rows.chunks().size(), 10U);
  const Drive drive = drive_of(once);
  const CollisionConstants constants{0.51, 1.0, 0.51};
  for (int n = 0; n < 7; ++n) {
    oneapi::tbb::task_arena arena(threads);
    const KernelReport a = arena.execute([&] { return advance_air(constants, drive, once); });
    const KernelReport b = collide_and_stream(constants, drive, twice);
    apply_links(drive, twice);
    EXPECT_EQ(a.max_speed2, b.max_speed2);
  }
  EXPECT_EQ(once.steps, twice.steps);
  EXPECT_EQ(once.backflow, twice.backflow);
  EXPECT_TRUE(populations_of(once) == populations_of(twice));
}

TEST(Step, InOnePassGivesTheBitsOfCollisionThenLinksForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) expect_equal_bits(make_open_duct, threads);
}

TEST(Step, InOnePassGivesTheSameBitsBesidePeriodicFaces) {
  expect_equal_bits([] { return make_duct(periodic(), periodic()); }, 3);
}

TEST(Step, TheScheduleHoldsEveryWallCellOnce) {
  const Air air = make_open_duct();
  std::multiset<std::ptrdiff_t> wanted, found;
  for (const WallRun& wall : air.links.walls)
    for (int n = 0; n < wall.count; ++n) wanted.insert(wall.first + n);
  const LinkSchedule& schedule = *air.links.schedule;
  for (const WallRun& run : schedule.runs)
    for (int n = 0; n < run.count; ++n) found.insert(run.first + n);
  for (const WallGroup& group : schedule.groups) {
    EXPECT_EQ(group.count % group_unit, 0);
    std::set<std::ptrdiff_t> members;  // a cell repeated within its group is the filling of a pack
    for (int n = 0; n < group.count; ++n) members.insert(schedule.places[group.place + n]);
    found.insert(members.begin(), members.end());
  }
  EXPECT_TRUE(wanted == found);
  EXPECT_FALSE(schedule.groups.empty());
  EXPECT_FALSE(schedule.runs.empty());
}

// Runs that differ in what is wanted of them are cut into packs of their own. What a cell becomes must not depend on
// the cells beside it, not even where the positivity limiter acts in one of them.
TEST(Step, APackIsNoMoreThanItsCells) {
  const auto make = [] {
    BoxScene scene = make_box(Vec3(22, 12, 12), 1.0, {wall(), wall(), wall(), wall(), wall(), wall()});
    Air air = make_air(scene, {});
    set_cells(
        [](const Vec3& x) {
          return InitialCell{
              0.02 * std::sin(x[0] * x[1]), {0.2 * std::sin(1.7 * x[1] + x[2]), 0.2, 0.15 * std::cos(2.3 * x[0])}, {}};
        },
        air);
    return air;
  };
  Air plain = make(), watched = make();
  for (std::size_t r = 0; r < watched.run_flags.size(); r += 3) watched.run_flags[r] = run_moments;
  for (int n = 0; n < 6; ++n)
    for (Air* air : {&plain, &watched}) advance_air({0.5003, 1.0, 0.5003}, at_rest(*air), *air);
  EXPECT_GT(plain.limited, 0);
  EXPECT_EQ(plain.limited, watched.limited);
  EXPECT_TRUE(populations_of(plain) == populations_of(watched));
}

TEST(Rows, OfAStraightDuctAreOneSpan) {
  const BoxScene scene = make_box(Vec3(22, 9, 7), 1.0, {wall(), wall(), wall(), wall(), wall(), wall()});
  const Rows rows(scene.voxels);
  const std::vector<lbm::Run>& runs = rows.runs();
  ASSERT_EQ(runs.size(), 9U * 7U);
  for (std::size_t r = 1; r < runs.size(); ++r) {
    EXPECT_EQ(runs[r].span, runs[0].span);
    EXPECT_EQ(runs[r].shift, runs[0].shift);
    // A ghost at each end and no room between them, along z first; two rows of ghosts between planes.
    EXPECT_EQ(runs[r].first - runs[r - 1].first, runs[r].y == runs[r - 1].y ? 24 : 3 * 24);
  }
  for (std::size_t s = 0; s < rows.slots(); ++s)
    EXPECT_EQ((rows.active_lanes()[s / 16] >> s % 16 & 1) != 0, rows.is_active(static_cast<std::ptrdiff_t>(s))) << s;
}

// Rows of every length up to two packs of the widest processor, so that ends of rows are masked, overlap, or share a
// pack with another. Populations are at most 0.02 here; each of about 200 roundings changes them by at most
// 0.02 x 6e-8, while a cell that is left out differs by the collision itself, about 1e-3.
TEST(Step, RowsOfEveryLengthAreTreatedByEveryInstructionSet) {
  for (int length = 1; length <= 33; ++length) {
    BoxScene scene = make_box(Vec3(length, 7, 5), 1.0, {wall(), wall(), wall(), wall(), wall(), wall()});
    std::vector<Air> airs;
    for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
      if (isa > detect_isa()) continue;
      AirOptions options;
      options.isa = isa;
      airs.push_back(make_air(scene, options));
      Air& air = airs.back();
      set_cells(
          [](const Vec3& x) {
            return InitialCell{0.01 * std::sin(x[0] + 2.0 * x[1]), {0.05, -0.03, 0.02}, {}};
          },
          air);
      for (int n = 0; n < 2; ++n) advance_air({0.8, 1.0, 0.8}, at_rest(air), air);  // an even and an odd step
    }
    for (const Air& air : airs) {
      float worst = 0.0F;
      for (std::size_t k = 0; k < populations_of(air).size(); ++k)
        worst = std::max(worst, std::abs(populations_of(air)[k] - populations_of(airs[0])[k]));
      EXPECT_LT(worst, 200 * 0.02 * 6e-8) << "rows of " << length << ", " << name(air.options.isa);
    }
  }
}

// The smallest normal float is 1.2e-38. What a collision reads below that is zero, and so is what it writes; outside
// of the collision such numbers live on.
TEST(Step, NumbersBelowTheNormalRangeFadeToZero) {
  BoxScene scene = make_box(Vec3(8, 8, 8), 1.0, {wall(), wall(), wall(), wall(), wall(), wall()});
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (isa > detect_isa()) continue;
    AirOptions options;
    options.isa = isa;
    Air air = make_air(scene, options);
    auto& f = std::get<Populations<float>>(air.populations).f;
    std::fill(f.begin(), f.end(), 1e-40F);
    collide_and_stream({0.51, 1.0, 0.51}, at_rest(air), air);
    const lbm::Run& run = air.rows.runs().front();
    for (int i = 0; i < d3q19::q; ++i)
      EXPECT_EQ(std::get<Populations<float>>(air.populations).departed(run, run.first, i, Parity::even), 0.0F) << i;
    volatile float tiny = 1e-40F;
    EXPECT_GT(tiny * 2.0F, 0.0F);
  }
}

}  // namespace
}  // namespace puffin::lbm::test
