// Study files: lists, sweeps, replicates; mistakes at their place.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "cases/study.hpp"
#include "cases/sweep.hpp"
#include "tests/cases/sample_case.hpp"

namespace puffin::cases::test {
namespace {

namespace fs = std::filesystem;

class StudyFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("puffin-study-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << sample;
  }
  void TearDown() override { fs::remove_all(folder_); }
  Study study(const std::string& text) const {
    std::ofstream(folder_ / "study.toml") << text;
    return read_study(folder_ / "study.toml");
  }
  std::string problems(const std::string& text) const {
    try {
      study(text);
    } catch (const CaseError& e) {
      return e.what();
    }
    return "none";
  }
  fs::path folder_;
};

TEST_F(StudyFile, CasesAreTheBaseWithTheirChanges) {
  const Study s = study(
      "base = \"case.toml\"\nshare = [\"scalars\"]\nreplicates = 3\n[[case]]\nname = \"a\"\n"
      "set = { \"carriers.count\" = 500, \"stop.time\" = \"5 ms\" }\n[[case]]\nname = "
      "\"b\"\n[case.set.carriers]\nparcel = 1\n");
  EXPECT_EQ(s.replicates, 3);
  EXPECT_TRUE(s.share.scalars && !s.share.geometry);
  ASSERT_EQ(s.cases.size(), 2u);
  const Case a = read_study_case(s.cases[0], 0), b = read_study_case(s.cases[1], 0);
  EXPECT_EQ(a.carriers->count, 500);
  EXPECT_DOUBLE_EQ(a.stop.time, 0.005);
  EXPECT_EQ(b.carriers->parcel, 1);
  EXPECT_EQ(b.carriers->count, 1000);
}

TEST_F(StudyFile, ValuesReadAsTheyWereWritten) {
  const Study s = study("base = \"case.toml\"\n[[case]]\nname = \"a\"\nset = { \"numerics.time_step\" = 8e-4 }\n");
  EXPECT_EQ(s.cases[0].sets.at(0).value, "8e-04");  // not 0.00080000000000000004
}

TEST_F(StudyFile, ReplicatesDifferInTheSeedAlone) {
  const Study s = study("base = \"case.toml\"\n[[case]]\nname = \"a\"\nset = { \"numerics.seed\" = 7 }\n");
  Case first = read_study_case(s.cases[0], 0), third = read_study_case(s.cases[0], 2);
  EXPECT_EQ(first.numerics.seed, 7u);
  EXPECT_EQ(third.numerics.seed, 9u);
  third.numerics.seed = 7, third.provenance = first.provenance;
  EXPECT_TRUE(first == third);
}

TEST_F(StudyFile, AFactorialHasEveryCombinationAndAListGoesTogether) {
  const std::string range =
      "[sweep.range]\n\"carriers.contact.friction\" = [0.1, 0.6]\n\"carriers.diameter\" = [\"60 um\", \"70 um\", \"80 "
      "um\"]\n";
  const Study s = study("base = \"case.toml\"\n[sweep]\nmethod = \"factorial\"\n" + range);
  ASSERT_EQ(s.cases.size(), 6u);
  EXPECT_EQ(s.cases[0].name, "sample-1");
  std::set<std::pair<double, double>> seen;
  for (const StudyCase& c : s.cases) {
    const Case built = read_study_case(c, 0);
    seen.emplace(std::get<double>(built.carriers->contact.friction), built.carriers->diameter);
  }
  EXPECT_EQ(seen.size(), 6u);
  EXPECT_NE(problems("base = \"case.toml\"\n[sweep]\nmethod = \"list\"\n" + range).find("has 3 values"),
            std::string::npos);
  EXPECT_EQ(study("base = \"case.toml\"\n[sweep]\nmethod = \"list\"\n[sweep.range]\n\"carriers.count\" = [10, 20]\n")
                .cases.size(),
            2u);
}

// Its name is the case's, whatever the base is called; a quote in it stays a quote.
TEST_F(StudyFile, ARunBearsTheNameOfItsCase) {
  const Study s = study(
      "base = \"case.toml\"\n[[case]]\nname = 'the \"slow\" one'\n[[case]]\nname = \"b\"\nset = { name = \"c\" }\n");
  EXPECT_EQ(read_study_case(s.cases[0], 0).name, "the \"slow\" one");
  EXPECT_EQ(read_study_case(s.cases[1], 0).name, "c") << "said by the study itself";
}

// The defining property of a Latin hypercube: each of n equal parts of each range holds exactly one point.
TEST(Sweep, ALatinHypercubeHasOnePointInEachPartOfEachRange) {
  const std::vector<SweepRange> ranges{{"a", {"0", "1"}, {0.0, 1.0}, false}, {"b", {"-2", "3"}, {-2.0, 3.0}, false}};
  constexpr int n = 17;
  const auto points = sweep_points(SweepMethod::lhs, ranges, n, 5);
  for (std::size_t k = 0; k < 2; ++k) {
    std::set<int> parts;
    for (const auto& point : points) {
      const auto& ends = ranges[k].numbers;
      parts.insert(static_cast<int>(std::floor((std::stod(point[k]) - ends[0]) / (ends[1] - ends[0]) * n)));
    }
    EXPECT_EQ(parts.size(), n);
    EXPECT_EQ(*parts.begin(), 0);
    EXPECT_EQ(*parts.rbegin(), n - 1);
  }
  EXPECT_EQ(points, sweep_points(SweepMethod::lhs, ranges, n, 5));
  EXPECT_NE(points, sweep_points(SweepMethod::lhs, ranges, n, 6));
}

TEST(Sweep, WholeNumbersStayWholeAndLevelsAreEvenlySpread) {
  const std::vector<SweepRange> ranges{{"count", {"100", "200"}, {100, 200}, true}};
  const auto points = sweep_points(SweepMethod::factorial, ranges, 3, 1);
  EXPECT_EQ(points, (std::vector<std::vector<std::string>>{{"100"}, {"150"}, {"200"}}));
  // 0.3 + (0.9 - 0.3) is 0.9000000000000001 in doubles.
  const auto ends = sweep_points(SweepMethod::factorial, {{"friction", {"0.3", "0.9"}, {0.3, 0.9}, false}}, 2, 1);
  EXPECT_EQ(ends, (std::vector<std::vector<std::string>>{{"0.3"}, {"0.9"}}));
}

// [0, 1] of a coefficient are two ends, of a number of carriers whole numbers.
TEST_F(StudyFile, WholeEndsOfARealQuantityHavePointsInBetween) {
  const Study s = study(
      "base = \"case.toml\"\n[sweep]\nmethod = \"factorial\"\nsamples = 3\n[sweep.range]\n"
      "\"carriers.contact.friction\" = [0, 1]\n\"carriers.count\" = [100, 201]\n");
  std::set<std::string> frictions, counts;
  for (const StudyCase& c : s.cases)
    for (const Override& o : c.sets) (o.key == "carriers.count" ? counts : frictions).insert(o.value);
  EXPECT_EQ(frictions, (std::set<std::string>{"0", "0.5", "1"}));
  EXPECT_EQ(counts, (std::set<std::string>{"100", "151", "201"}));  // 150.5 rounded
}

TEST_F(StudyFile, MistakesAreFoundAtTheirPlace) {
  EXPECT_NE(problems("base = \"case.toml\"\nreplicate = 2\n")
                .find("study.toml:2:1: error: unknown key 'replicate'; did "
                      "you mean 'replicates'?"),
            std::string::npos);
  EXPECT_NE(problems("base = \"none.toml\"\n").find("study.toml:1:8"), std::string::npos);
  EXPECT_NE(problems("base = \"case.toml\"\nshare = [\"air\"]\n").find("study.toml:2:9"), std::string::npos);
  EXPECT_NE(
      problems("base = \"case.toml\"\n[sweep]\nmethod = \"lsh\"\n[sweep.range]\na = [1, 2]\n").find("study.toml:3:10"),
      std::string::npos);
  EXPECT_NE(problems("base = \"case.toml\"\n[[case]]\nname = \"a\"\n[[case]]\nname = \"a\"\n").find("study.toml:5:8"),
            std::string::npos);
  const Study s = study("base = \"case.toml\"\n[[case]]\nname = \"a\"\nset = { \"carriers.cuont\" = 3 }\n");
  try {
    read_study_case(s.cases[0], 0);
    FAIL() << "a misspelt key of a change was read";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("study.toml:4:"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("did you mean 'count'"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace puffin::cases::test
