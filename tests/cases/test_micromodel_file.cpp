#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cases/micromodel_file.hpp"

namespace puffin::cases {
namespace {

class MicroModelFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("puffin-micromodels-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string complaint(const std::string& text) const {
    try {
      read_micromodels(write("bad.toml", text));
    } catch (const CaseError& e) {
      return e.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(MicroModelFile, PowerLawTakesItsFiveConstants) {
  const auto models = read_micromodels(
      write("m.toml", "label = \"given\"\n[wall_detach]\nlaw = \"power\"\nA = [0.01, 1.0, 2.0, 0.02, 0.5]\n"));
  ASSERT_TRUE(models.wall_detach);
  EXPECT_FALSE(models.wall_attach || models.particle_detach || models.drag_detach);
  EXPECT_DOUBLE_EQ(micromodels::fraction(*models.wall_detach, 1.0), 0.01);
  EXPECT_DOUBLE_EQ(micromodels::fraction(*models.wall_detach, 4.0), 0.02 * 2.0);
}

TEST_F(MicroModelFile, TablesAreReadInAnyOrder) {
  write("x.csv", "speed, angle, fraction\n10,90,0.4\n0,45,0\n0,90,0\n10,45,0.2\n");
  const auto models =
      read_micromodels(write("m.toml", "label = \"derived\"\n[wall_detach]\nlaw = \"table\"\nfile = \"x.csv\"\n"));
  EXPECT_DOUBLE_EQ(micromodels::fraction(*models.wall_detach, 5.0, 90.0), 0.2);   // linear in the speed
  EXPECT_DOUBLE_EQ(micromodels::fraction(*models.wall_detach, 10.0, 67.5), 0.3);  // and in the angle
}

TEST_F(MicroModelFile, UnitsAreRead) {
  const auto models = read_micromodels(write("m.toml", R"(label = "surrogate"
[wall_detach]
law = "weibull"
energy_ratio = 3.0
shape = 1.0
carrier_mass = "0.284 ug"
adhesion_energy = "1 fJ"
)"));
  const auto& law = std::get<micromodels::WeibullLaw>(*models.wall_detach);
  EXPECT_DOUBLE_EQ(law.constants().carrier_mass, 2.84e-10);
  EXPECT_DOUBLE_EQ(law.constants().adhesion_energy, 1e-15);
}

TEST_F(MicroModelFile, MistakesHaveTheirPlace) {
  const std::string text = complaint("label = \"gven\"\n[wall_detach]\nlaw = \"power\"\nA = [1, 2]\nB = 3\n");
  EXPECT_NE(text.find("bad.toml:1:9: error: label = \"gven\""), std::string::npos) << text;
  EXPECT_NE(text.find("bad.toml:4:5: error: wall_detach.A"), std::string::npos) << text;
  EXPECT_NE(text.find("bad.toml:5:1: error: unknown key 'B'"), std::string::npos) << text;
}

TEST_F(MicroModelFile, ConstantsThatTheLawRefusesAreReported) {
  EXPECT_NE(complaint("label = \"given\"\n[wall_detach]\nlaw = \"power\"\nA = [-1, 1, 1, 1, 1]\n"), "");
  EXPECT_NE(complaint("label = \"given\"\n[wall_detach]\nlaw = \"table\"\nfile = \"none.csv\"\n"), "");
  write("gap.csv", "speed,angle,fraction\n0,45,0\n10,90,0.4\n");
  EXPECT_NE(complaint("label = \"given\"\n[wall_detach]\nlaw = \"table\"\nfile = \"gap.csv\"\n"), "");
}

}  // namespace
}  // namespace puffin::cases
