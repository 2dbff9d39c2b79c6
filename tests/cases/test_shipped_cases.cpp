#include <gtest/gtest.h>

#include <filesystem>

#include <algorithm>

#include "cases/derived.hpp"
#include "cases/micromodel_file.hpp"
#include "cases/read_case.hpp"
#include "cases/check_boundaries.hpp"
#include "cases/surface.hpp"
#include "cases/write_case.hpp"

namespace puffin::cases {
namespace {

std::vector<std::filesystem::path> shipped_cases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(PUFFIN_SOURCE_DIR) / "cases"))
    if (entry.path().filename() == "case.toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(ShippedCases, AllReadWithoutProblemsAndComeBackFromTheirResolvedForm) {
  ASSERT_GE(shipped_cases().size(), 8u);
  for (const auto& file : shipped_cases()) {
    SCOPED_TRACE(file.string());
    Case c;
    ASSERT_NO_THROW(c = read_case(file));
    EXPECT_TRUE(parse_case(write_resolved(c), file) == c);
    for (const char* preset : {"quick", "fast", "accurate"}) EXPECT_NO_THROW(read_case(file, {}, preset));
  }
}

TEST(ShippedCases, TheirSurfacesAreClosedAndHaveTheirPatches) {
  for (const auto& file : shipped_cases()) {
    SCOPED_TRACE(file.string());
    const Case c = read_case(file);
    Surface s;
    ASSERT_NO_THROW(s = load_surface(c));
    EXPECT_TRUE(boundary_problems(c, s).empty());
    EXPECT_GT(s.volume, 0.0);
  }
}

// Facts of the thesis: 25000 carriers weigh 7.1 mg with their fines. Tolerance: the mass is stated with two digits.
TEST(ShippedCases, LBaseLoadsTheDoseOfTheThesis) {
  const Case c = read_case(std::filesystem::path(PUFFIN_SOURCE_DIR) / "cases/l-base/case.toml");
  EXPECT_NEAR(dose_mass(*c.carriers), 7.1e-6, 0.05e-6);
  EXPECT_FALSE(c.carriers->rotation);
  EXPECT_EQ(c.stop.time, 0.211);
  EXPECT_FALSE(assumptions(c).empty());
}

TEST(ShippedMicroModels, AreRead) {
  for (const char* name : {"lactose-3.6e-3.toml", "lactose-1.8e-2.toml"}) {
    const auto models = read_micromodels(std::filesystem::path(PUFFIN_SOURCE_DIR) / "cases/micromodels" / name);
    EXPECT_EQ(models.label, micromodels::Label::surrogate);
    EXPECT_TRUE(models.wall_detach && models.wall_attach && models.particle_detach && models.drag_detach);
  }
}

}  // namespace
}  // namespace puffin::cases
