// Who leaves through an opening is told from who breaks through a wall by the way, not by what is nearest in the end.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "cases/build.hpp"
#include "cases/read_case.hpp"
#include "coupling/health.hpp"
#include "lbm/geometry/stl.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::coupling {
namespace {

constexpr double interval = 1e-5;  // [s]

/// A box of 3 mm. The square of 1 mm in the middle of its side x-max is the solid `outlet`.
lbm::geometry::TriangleMesh box_with_a_hole() {
  lbm::geometry::TriangleMesh mesh = lbm::geometry::shapes::box(Vec3::Zero(), Vec3::Constant(3e-3), 3);
  const int outlet = static_cast<int>(mesh.solids.size());
  mesh.solids.emplace_back("outlet");
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const int t = static_cast<int>(n);
    const Vec3 from_middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0 - Vec3::Constant(1.5e-3);
    if (mesh.solids[mesh.solid[n]] == "x-max" && from_middle.tail<2>().cwiseAbs().maxCoeff() < 0.5e-3)
      mesh.solid[n] = outlet;
  }
  return mesh;
}

/// A carrier of 20 um flies freely in that box, which is open at the outlet and at its side z-max. In every scene it
/// passes the edges by more than its radius, and nothing acts on it: in one interval it goes by velocity times time.
class Departures : public ::testing::Test {
 protected:
  void SetUp() override { lbm::geometry::write_stl(stl_.string(), box_with_a_hole()); }
  void TearDown() override { std::filesystem::remove(stl_); }

  std::unique_ptr<cases::Simulation> scene(const Vec3& x, const Vec3& v) const {
    char carrier[240];
    std::snprintf(carrier, sizeof carrier,
                  "{ position = [%.6e, %.6e, %.6e], velocity = [%.6e, %.6e, %.6e], diameter = 2e-5, density = 1520 }",
                  x[0], x[1], x[2], v[0], v[1], v[2]);
    return cases::build(
        cases::parse_case("schema = 1\nname = \"departures\"\n[geometry]\nstl = \"" + stl_.string() +
                              "\"\nunit = \"m\"\n[[geometry.patch]]\nname = \"lid\"\nselect = \"solid:z-max\"\n"
                              "[air]\nmodel = \"none\"\n[numerics]\ntime_step = \"1e-5 s\"\n[carriers]\n"
                              "gravity = [0.0, 0.0, 0.0]\nlist = [" +
                              std::string(carrier) + "]\n[stop]\ntime = \"1 ms\"\n",
                          "departures.toml"));
  }
  /// Through which patch the carrier has gone after one interval; empty if it has not.
  static std::string way_out(cases::Simulation& s) {
    advance(s.models, interval, s.state);
    EXPECT_EQ(s.state.time, interval);
    EXPECT_EQ(s.state.carriers.carriers.size() + s.state.departures.size(), 1U);
    return s.state.departures.empty() ? "" : s.models.patches[s.state.departures[0].patch].patch;
  }

  const std::filesystem::path stl_ =
      std::filesystem::temp_directory_path() /
      ("puffin-departures-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".stl");
};

// From (2.9, 1.5, 1.7) mm to (3.2, 1.5, 2.1) mm: through the hole at z = 1.83 mm. There the plate is 0.2 mm away, the
// hole's edge at z = 2 mm 0.22 mm.
TEST_F(Departures, ObliquelyThroughAHoleInAPlateIsNotThroughThePlate) {
  const auto s = scene({2.9e-3, 1.5e-3, 1.7e-3}, {30.0, 0.0, 40.0});
  const Health health(s->models, s->state);
  EXPECT_EQ(way_out(*s), "outlet");
  EXPECT_NO_THROW(health.check(s->models, s->state));
}

// From (2.8, 1.5, 2.9) mm to (3.1, 1.5, 3.2) mm: through z-max at x = 2.9 mm. There the edge at x = z = 3 mm is the
// nearest place both of z-max and of x-max, a wall, whose triangles come first.
TEST_F(Departures, BeyondTheEdgeOfAnOpeningIsNotThroughTheWallAtThatEdge) {
  const auto s = scene({2.8e-3, 1.5e-3, 2.9e-3}, {30.0, 0.0, 30.0});
  const Health health(s->models, s->state);
  EXPECT_EQ(way_out(*s), "lid");
  EXPECT_NO_THROW(health.check(s->models, s->state));
}

// One that went through the plate flies along behind it, from (3.1, 1.5, 2.2) mm to (3.1, 1.5, 1.5) mm: the hole is the
// nearest surface then. It has not left through it, and is found.
TEST_F(Departures, WhoWentThroughAWallHasNotLeftThoughAnOpeningIsNearest) {
  const auto s = scene({2e-3, 1.5e-3, 1.5e-3}, {0.0, 0.0, -70.0});
  const Health health(s->models, s->state);
  s->state.carriers.carriers.position[0] = {3.1e-3, 1.5e-3, 2.2e-3};
  EXPECT_EQ(way_out(*s), "");
  try {
    health.check(s->models, s->state);
    ADD_FAILURE() << "nothing was noticed";
  } catch (const Diverged& e) {
    EXPECT_NE(std::string(e.what()).find("carrier 0 is outside the walls, at [0.0031, 0.0015, 0.0015] m"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace puffin::coupling
