// `base = "other.toml"`: a case file that says only what differs.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cases/write_case.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases::test {
namespace {

namespace fs = std::filesystem;

class Inherit : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("puffin-inherit-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_ / "base");
    file("base/case.toml", sample);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string first_problem(const fs::path& path) const {
    try {
      read_case(path);
    } catch (const CaseError& e) {
      return e.problems.front().to_string();
    }
    return "none";
  }
  fs::path folder_;
};

TEST_F(Inherit, WhatIsNotGivenIsTheBases) {
  const auto path = file("case.toml", "base = \"base/case.toml\"\nname = \"other\"\n[carriers]\ncount = 2000\n");
  Case c = read_case(path);
  const Case base = read_case(folder_ / "base/case.toml");
  EXPECT_EQ(c.name, "other");
  EXPECT_EQ(c.carriers->count, 2000);
  c.name = base.name, c.carriers->count = base.carriers->count, c.provenance = base.provenance;
  EXPECT_TRUE(c == base);
}

TEST_F(Inherit, AFullFileOfTheSameValuesIsTheSameCase) {
  const auto path = file("case.toml", "base = \"base/case.toml\"\nname = \"sample\"\n");
  const Case c = read_case(path), base = read_case(folder_ / "base/case.toml");
  EXPECT_TRUE(c == base);
  EXPECT_TRUE(parse_case(write_resolved(c), path) == c);
}

TEST_F(Inherit, ListsAndAlternativesReplaceTheBases) {
  const auto path = file("case.toml",
                         "base = \"base/case.toml\"\nname = \"other\"\n[numerics]\ncells = 20000\n"
                         "[[air.boundary]]\npatch = \"outlet\"\ntype = \"pressure-outlet\"\n"
                         "[[air.boundary]]\npatch = \"inlet\"\ntype = \"velocity-inlet\"\nvelocity = \"10 m/s\"\n");
  const Case c = read_case(path);
  EXPECT_FALSE(c.numerics.dx);
  EXPECT_EQ(c.numerics.cells, 20000);
  ASSERT_EQ(c.air.boundaries.size(), 2u);
  EXPECT_EQ(c.air.boundaries[0].patch, "outlet");
  EXPECT_TRUE(std::holds_alternative<MeanSpeed>(c.air.boundaries[1].flow));
}

TEST_F(Inherit, NameAndReferenceBelongToOneCase) {
  file("base/case.toml", sample + "[reference]\nFFE = 0.5\n");
  EXPECT_NE(first_problem(file("case.toml", "base = \"base/case.toml\"\n")).find("missing key 'name'"),
            std::string::npos);
  EXPECT_TRUE(read_case(file("case.toml", "base = \"base/case.toml\"\nname = \"other\"\n")).reference.empty());
}

TEST_F(Inherit, MistakesAreFoundWhereTheyStand) {
  const auto good = file("case.toml", "base = \"base/case.toml\"\nname = \"a\"\n[carriers]\ncuont = 3\n");
  EXPECT_NE(first_problem(good).find("case.toml:4:1: error: unknown key 'cuont'"), std::string::npos);
  file("base/case.toml", replaced(sample, "parcel = 10", "parcel = -1"));  // line 19 of the base
  EXPECT_NE(first_problem(file("case.toml", "base = \"base/case.toml\"\nname = \"a\"\n")).find("base/case.toml:19:10"),
            std::string::npos)
      << first_problem(folder_ / "case.toml");
}

TEST_F(Inherit, AssumptionsOfTheBaseStayAssumptions) {
  file("base/case.toml", replaced(sample, "parcel = 10", "parcel = 10  # assumed: why not"));
  const Case c = read_case(file("case.toml", "base = \"base/case.toml\"\nname = \"a\"\n"));
  EXPECT_EQ(assumptions(c), std::vector<std::string>{"carriers.parcel: why not"});
}

TEST_F(Inherit, FilesOfTheBaseAreLookedForBesideIt) {
  file("base/models.toml", "");
  file("base/case.toml", replaced(sample, "parcel = 10", "parcel = 10\nfines_each = 2000\nfine_mass_ratio = 2e-5") +
                             "[fines]\nmicromodels = \"models.toml\"\n[[fines.scalar]]\nname = \"s\"\n"
                             "diffusion = 1e-6\n");
  const Case c = read_case(file("case.toml", "base = \"base/case.toml\"\nname = \"a\"\n"));
  EXPECT_EQ(fs::path(c.fines->micromodels), folder_ / "base/models.toml");
}

TEST_F(Inherit, AMissingBaseAndACircleAreRefused) {
  EXPECT_NE(first_problem(file("case.toml", "name = \"a\"\nbase = \"none.toml\"\n")).find("case.toml:2:8"),
            std::string::npos)
      << first_problem(folder_ / "case.toml");
  file("b.toml", "base = \"case.toml\"\n");
  EXPECT_NE(first_problem(file("case.toml", "base = \"b.toml\"\nname = \"a\"\n")).find("in a circle"),
            std::string::npos);
}

}  // namespace
}  // namespace puffin::cases::test
