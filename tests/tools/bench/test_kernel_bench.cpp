// What `puffin bench kernel` measures and how it counts.

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "tools/bench/kernel_bench.hpp"

namespace puffin::bench {
namespace {

// MLUPS counts fluid cells: not the band of an immersed boundary behind the wall, nor cells that are solid for the most
// part. All walls have the same fluid.
TEST(KernelBench, CountsFluidCellsAlone) {
  const KernelRow sharp = measure_kernel({"l-bend", 8000, 1, "rr3", "float", "bouzidi"}, 0.0, 1);
  EXPECT_EQ(sharp.cells, sharp.cells_active);
  for (const char* wall : {"psm", "ibm"}) {
    const KernelRow row = measure_kernel({"l-bend", 8000, 1, "rr3", "float", wall}, 0.0, 1);
    EXPECT_EQ(row.cells, sharp.cells) << wall;
    EXPECT_GT(row.cells_active, row.cells) << wall;
    EXPECT_NEAR(row.mlups, 1e-6 * static_cast<double>(row.cells) * row.steps_per_second, 1e-9 * row.mlups) << wall;
    // one turn: its medians are its values
    EXPECT_NEAR(row.added, row.mlups_bare / row.mlups - 1.0, 1e-9) << wall;
    EXPECT_NEAR(row.fraction_of_bound, row.mlups / row.bound_mlups, 1e-9) << wall;
  }
}

TEST(KernelBench, EveryCollisionRuns) {
  for (const char* collision : {"rr3", "bgk", "trt", "central-moments", "hrr"})
    for (const char* scene : {"box", "l-bend"})
      EXPECT_GT(measure_kernel({scene, 8000, 1, collision, "float", "bouzidi"}, 0.0, 1).mlups, 0.0) << collision;
  EXPECT_GT(measure_kernel({"box", 8000, 1, "rr3", "double", "none"}, 0.0, 1).mlups, 0.0);
}

TEST(KernelBench, TheListHasEveryCollisionAndWall) {
  for (const bool quick : {true, false}) {
    std::set<std::string> collisions, walls;
    for (const KernelSetting& s : kernel_settings(quick, {}, {1, 2})) {
      if (s.scene != "l-bend" || s.cells != 2.1e5) continue;
      collisions.insert(s.collision);
      walls.insert(s.wall);
    }
    EXPECT_EQ(collisions, (std::set<std::string>{"rr3", "bgk", "trt", "central-moments", "hrr"})) << quick;
    EXPECT_EQ(walls, (std::set<std::string>{"bouzidi", "halfway", "psm", "ibm"})) << quick;
  }
}

TEST(KernelBench, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(measure_kernel({"box", 1000, 1, "rr4", "float", "bouzidi"}, 0.0, 1), std::invalid_argument);
  EXPECT_THROW(measure_kernel({"box", 1000, 1, "rr3", "float", "glue"}, 0.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace puffin::bench
