// What runs without cells refuse of a geometry.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cases/assessment.hpp"
#include "cases/build.hpp"
#include "cases/read_case.hpp"
#include "lbm/geometry/stl.hpp"
#include "tests/lbm/geometry/shapes.hpp"

namespace puffin::cases {
namespace {

namespace geometry = lbm::geometry;

/// One carrier in a geometry of boxes, in the given air, which needs no cells.
class DryRun {
 public:
  explicit DryRun(const geometry::TriangleMesh& mesh, const std::string& air)
      : file_(std::filesystem::temp_directory_path() / "puffin-dry-geometry.stl") {
    geometry::write_stl(file_.string(), mesh);
    case_ = parse_case("schema = 1\nname = \"dry\"\n[geometry]\nstl = \"" + file_.filename().string() +
                           "\"\nunit = \"m\"\n[air]\n" + air +
                           "\n[carriers]\ncount = 1\ndiameter = 7e-5\ndensity = 1520\noutside = \"bounce\"\n"
                           "list = [{ position = [1e-3, 1e-3, 1e-3], velocity = [1, 0, 0], diameter = 7e-5, density = "
                           "1520 }]\n[carriers.adhesion]\nmodel = \"none\"\n[stop]\ntime = \"1 ms\"\n",
                       (file_.parent_path() / "dry.toml").string());
  }
  ~DryRun() { std::filesystem::remove(file_); }
  DryRun(const DryRun&) = delete;
  DryRun& operator=(const DryRun&) = delete;
  void run() const { build(case_); }
  void check() const { assess(case_, load_surface(case_)); }

 private:
  std::filesystem::path file_;
  Case case_;
};

const std::string none = "model = \"none\"",
                  frozen =
                      "model = \"frozen\"\nfield = \"uniform\"\nvelocity = [1, 0, 0]\ndensity = 1.2\n"
                      "viscosity = 1.8e-5";

}  // namespace

// A carrier met the face and flew back, and the run ended with 0.
TEST(DryGeometry, BuriedFacesAreRefusedByRunAndCheck) {
  const geometry::TriangleMesh box = geometry::shapes::box({0, 0, 0}, {4e-3, 4e-3, 4e-3});
  for (const std::string& air : {none, frozen}) {
    for (const double from : {2.5e-3, 4e-3}) {
      const DryRun dry(geometry::shapes::joined(box, geometry::shapes::box({from, 0.5e-3, 0.5e-3}, {9e-3, 3e-3, 3e-3})),
                       air);
      EXPECT_THROW(dry.run(), geometry::GeometryError) << air << from;
      EXPECT_THROW(dry.check(), geometry::GeometryError) << air << from;
    }
    const DryRun sound(box, air);
    EXPECT_NO_THROW(sound.run());
    EXPECT_NO_THROW(sound.check());
  }
}

}  // namespace puffin::cases
