// A case that cannot fit is refused before anything of its size is allocated.

#include "cases/room.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "cases/build.hpp"
#include "cases/check_boundaries.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// A closed box with an edge of 10 mm, air alone.
Case box(double dx) {
  return parse_case(
      "name = \"box\"\n[geometry]\ngenerator = \"box\"\n[geometry.box]\nx = 0.01\ny = 0.01\nz = 0.01\n[air]\n"
      "initial_velocity = [1.0, 0.0, 0.0]\n[numerics]\nreference_speed = 1.0\ndx = " +
          std::to_string(dx * 1e9) + "e-9\n[stop]\ntime = 1e-3\n",
      "box.toml");
}

TEST(Room, TheLeastMemoryIsThatOfThePopulations) {
  // 100^3 cells, 19 floats each, and a bit a cell.
  const Case c = box(1e-4);
  EXPECT_NEAR(least_memory(c, load_surface(c)), 1e6 * (19.0 * 4.0 + 0.125), 1e6 * 0.01);
}

TEST(Room, MoreMemoryThanThereIsIsRefusedWithBothNumbers) {
  const Case c = box(1e-4);
  EXPECT_NO_THROW(require_room(c, load_surface(c), 1e8));
  try {
    build(c, {}, 5e7);
    FAIL() << "built";
  } catch (const TooLarge& e) {
    EXPECT_NE(std::string(e.what()).find("at least 0.0761 GB of memory, 0.05 GB are available"), std::string::npos)
        << e.what();
  }
}

TEST(Room, MoreCellsThanCanBeNumberedAreRefusedOnAnyMachine) {
  const Case c = box(1e-8);  // 10^18
  EXPECT_THROW(build(c, {}, endless), TooLarge);
}

TEST(Room, CarriersThatFillMoreThanTheDeviceAreRefused) {
  Case c = box(1e-4);
  c.carriers.emplace();
  c.carriers->diameter = 1e-3;
  c.carriers->fill.emplace();
  c.carriers->fill->at = Vec3(5e-3, 5e-3, 0.0);
  // pi / sqrt(18) of 1000 mm^3 over pi / 6 mm^3: 1414.2 spheres.
  c.carriers->count = 1414;
  EXPECT_TRUE(boundary_problems(c, load_surface(c)).empty());
  c.carriers->count = 1415;
  ASSERT_EQ(boundary_problems(c, load_surface(c)).size(), 1U);
  EXPECT_EQ(boundary_problems(c, load_surface(c)).front().key, "carriers.count");
}

}  // namespace
}  // namespace puffin::cases
