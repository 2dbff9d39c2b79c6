// Files of the benchmarks: settings of a case, things left out.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cases/case_error.hpp"
#include "cases/verification/ablation.hpp"
#include "cases/verification/pareto.hpp"

namespace puffin::cases {
namespace {

const std::filesystem::path shipped = std::filesystem::path(PUFFIN_SOURCE_DIR) / "cases" / "bench";

/// A folder with one pareto.toml that varies a shipped verification.
class PieceOfToml {
 public:
  explicit PieceOfToml(const std::string& more) {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("puffin-pareto-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "pareto.toml") << "id = \"X\"\ntitle = \"a title\"\nverify = \"" << shipped.string()
                                           << "/../verify/restitution\"\nrun = \"e080\"\n"
                                           << more;
  }
  ~PieceOfToml() { std::filesystem::remove_all(folder_); }
  PieceOfToml(const PieceOfToml&) = delete;
  PieceOfToml& operator=(const PieceOfToml&) = delete;
  ParetoCase read() const { return read_pareto(folder_); }
  std::string problem() const {
    try {
      read();
    } catch (const CaseError& e) {
      return e.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_;
};

constexpr char check[] = "check = \"linear contact, restitution 0.8\"\n";

TEST(Pareto, EveryShippedCaseIsReadAndItsSettingsAreValid) {
  const auto list = read_pareto_cases(shipped);
  EXPECT_GE(list.size(), 12U);
  for (const ParetoCase& c : list)
    for (const ParetoPoint& p : points_of(c, false))
      for (const VerificationRun& run : runs_of(c, p.sets, false))
        EXPECT_NO_THROW(read_case(run.case_file, run.sets)) << c.id << ": " << p.axis << " " << p.label;
}

TEST(Pareto, TheDeviceHasSixtySettings) {
  std::size_t settings = 0;
  for (const ParetoCase& c : read_pareto_cases(shipped))
    if (c.id == "P9") settings = points_of(c, false).size();
  EXPECT_GE(settings, 60U);
}

TEST(Pareto, ProductsAreEveryCombination) {
  const PieceOfToml toml(std::string(check) +
                         "products = [\"a * b\"]\n[[axis]]\nname = \"a\"\n[[axis.setting]]\nlabel = \"1\"\nset = "
                         "[\"numerics.seed=1\"]\nquick = true\n[[axis.setting]]\nlabel = \"2\"\nset = "
                         "[\"numerics.seed=2\"]\n[[axis]]\nname = \"b\"\n[[axis.setting]]\nlabel = \"3\"\nset = "
                         "[\"numerics.threads=3\"]\n");
  const ParetoCase c = toml.read();
  const auto all = points_of(c, false);
  ASSERT_EQ(all.size(), 1U + 2U + 1U + 2U);  // default, a, b, a x b
  EXPECT_EQ(all.back().axis, "a x b");
  EXPECT_EQ(all.back().label, "2, 3");
  EXPECT_EQ(all.back().sets.size(), 2U);
  EXPECT_EQ(points_of(c, true).size(), 2U);  // default and the one marked quick
}

TEST(Pareto, TheSettingComesLast) {
  const PieceOfToml toml(std::string(check) + "set = [\"numerics.seed=5\"]\nquick_set = [\"numerics.seed=6\"]\n");
  const ParetoCase c = toml.read();
  const auto run = runs_of(c, {{"numerics.seed", "7"}}, true).front();
  EXPECT_EQ(read_case(run.case_file, run.sets).numerics.seed, 7U);
  EXPECT_EQ(read_case(run.case_file, runs_of(c, {}, true).front().sets).numerics.seed, 6U);
  EXPECT_EQ(read_case(run.case_file, runs_of(c, {}, false).front().sets).numerics.seed, 5U);
}

TEST(Pareto, NamesWhatIsNotThere) {
  EXPECT_NE(PieceOfToml("check = \"another\"\n").problem().find("no check 'another'"), std::string::npos);
  EXPECT_NE(PieceOfToml(std::string(check) + "products = [\"a * b\"]\n").problem().find("no axis 'a'"),
            std::string::npos);
  EXPECT_NE(PieceOfToml(std::string(check) + "half_width = \"1 +\"\n").problem().find("half_width"), std::string::npos);
  EXPECT_NE(PieceOfToml(std::string(check) + "sets = []\n").problem().find("sets"), std::string::npos);
}

TEST(Ablations, TheShippedListIsReadAndItsSettingsAreValid) {
  const AblationList list = read_ablations(shipped / "skip.toml");
  EXPECT_GE(list.skips.size(), 9U);
  for (const Ablation& skip : list.skips) {
    const auto scene = std::find_if(list.scenes.begin(), list.scenes.end(),
                                    [&](const AblationScene& s) { return s.name == skip.scene; });
    ASSERT_NE(scene, list.scenes.end());
    EXPECT_NE(read_case(scene->case_file), read_case(scene->case_file, skip.off)) << skip.name;
    EXPECT_EQ(skip.answers.size(), skip.name == "following the ramp" ? 2U : 0U) << "both pressure drops, or none";
  }
}

}  // namespace
}  // namespace puffin::cases
