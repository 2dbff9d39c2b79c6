// Verification files: what they may say, and how outputs are judged by them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "cases/search_path.hpp"
#include "cases/verification/evaluate.hpp"

namespace puffin::cases {
namespace {

constexpr const char* sample = R"toml(
id = "X01"
suite = "flow"
title = "sample"
source = "by hand"
constants = ["U = 2", "V = 3*U"]
[[run]]
name = "coarse"
constants = ["shift = 0.4"]
[[run]]
name = "fine"
quick = false
constants = ["shift = 0.1"]
[[reading]]
name = "last_u"
output = "probes.csv"
where = { probe = "a" }
filter = "time > 0"
x = "time"
y = "u/U + shift"
reduce = "last"
[[check]]
quantity = "value"
result = "last_u"
reference = "V/2"
measure = "absolute"
tolerance = 0.15
reason = "by hand"
[[check]]
quantity = "ratio of runs"
result = "coarse.last_u - last_u"
reference = 0.3
measure = "relative"
tolerance = 1e-12
reason = "rounding"
[[check]]
quantity = "order"
result = "last_u - 3"
order_over = ["coarse", "fine"]
reference = 2
bound = "at-least"
measure = "absolute"
tolerance = 1e-9
reason = "rounding"
[[check]]
quantity = "bound"
run = "coarse"
result = "last_u"
reference = 3.5
bound = "at-most"
measure = "relative"
tolerance = 0
reason = "by hand"
)toml";

class VerificationFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("puffin-verification-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  Verification read(const std::string& text) {
    std::ofstream(folder_ / "verify.toml") << text;
    return read_verification(folder_);
  }
  std::string problems(const std::string& text) {
    try {
      read(text);
    } catch (const CaseError& e) {
      return e.what();
    }
    return "";
  }
  std::filesystem::path folder_;
};

/// u of probe a: 1, 6 at the end; of probe b: 100.
RunOutput output(double dx) {
  RunOutput run;
  run.numbers = {{"dx", dx}, {"cells_fluid", 8.0}};
  run.table = [](const std::string& name) {
    EXPECT_EQ(name, "probes.csv");
    Table t;
    t.numbers = {{"time", {0.0, 1.0, 2.0, 2.0}}, {"u", {1.0, 2.0, 6.0, 100.0}}};
    t.words = {{"probe", {"a", "a", "a", "b"}}};
    return t;
  };
  return run;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

// last_u = 6/2 + shift: 3.4 and 3.1. Order of (0.4, 0.1) over (0.2, 0.1): 2.
TEST_F(VerificationFile, IsJudgedAsByHand) {
  const Verification v = read(sample);
  const std::map<std::string, RunOutput> runs{{"coarse", output(0.2)}, {"fine", output(0.1)}};
  std::vector<Outcome> o;
  for (const Check& check : v.checks) o.push_back(evaluate(v, check, runs));
  ASSERT_EQ(o.size(), 4u);
  EXPECT_NEAR(o[0].value, 3.1, 1e-12);
  EXPECT_NEAR(o[0].reference, 3.0, 1e-12);
  EXPECT_NEAR(o[0].error, 0.1, 1e-12);
  EXPECT_TRUE(o[0].pass);
  EXPECT_NEAR(o[1].value, 0.3, 1e-12);
  EXPECT_TRUE(o[1].pass) << o[1].error;
  EXPECT_NEAR(o[2].value, 2.0, 1e-9);
  EXPECT_TRUE(o[2].pass);
  EXPECT_TRUE(o[3].pass) << "3.4 is at most 3.5";
  EXPECT_EQ(runs_of(v, v.checks[1]), (std::vector<std::string>{"coarse", "fine"}));
  EXPECT_EQ(runs_of(v, v.checks[2]), (std::vector<std::string>{"coarse", "fine"}));
}

// u of probe a is 1, 2, 6 at 0, 1, 2 s: slopes 1 and 4.
TEST_F(VerificationFile, DerivativesAreSlopesBetweenRows) {
  std::string text = replaced(sample, "filter = \"time > 0\"", "derivative = true");
  text = replaced(text, "y = \"u/U + shift\"", "y = \"u\"");
  const Verification v = read(text);
  EXPECT_NEAR(evaluate(v, v.readings[0], v.runs[0], output(0.1)), 4.0, 1e-12);
  const Verification first = read(replaced(text, "reduce = \"last\"", "reduce = \"at-maximum\""));
  EXPECT_NEAR(evaluate(first, first.readings[0], first.runs[0], output(0.1)), 1.5, 1e-12);
}

// One line of the results for each run, with the label of the run or its name.
TEST_F(VerificationFile, AChecksRunsAreALineEach) {
  std::string text = replaced(sample, "run = \"coarse\"\nresult", "runs = [\"coarse\", \"fine\"]\nresult");
  text = replaced(text, "name = \"fine\"", "name = \"fine\"\nlabel = \"a fine grid\"");
  const Verification v = read(text);
  ASSERT_EQ(v.checks.size(), 5u);
  EXPECT_EQ(v.checks[3].quantity, "bound, coarse");
  EXPECT_EQ(v.checks[4].quantity, "bound, a fine grid");
  const std::map<std::string, RunOutput> runs{{"coarse", output(0.2)}, {"fine", output(0.1)}};
  EXPECT_NEAR(evaluate(v, v.checks[3], runs).value, 3.4, 1e-12);
  EXPECT_NEAR(evaluate(v, v.checks[4], runs).value, 3.1, 1e-12);
  EXPECT_EQ(runs_of(v, v.checks[4]), std::vector<std::string>{"fine"});
  EXPECT_NE(problems(replaced(sample, "run = \"coarse\"", "run = \"coarse\"\nruns = [\"fine\"]")).find("one of 'run'"),
            std::string::npos);
  EXPECT_NE(problems(replaced(text, "[\"coarse\", \"fine\"]\nresult", "[\"fin\"]\nresult")).find("no run 'fin'"),
            std::string::npos);
}

// Carriers 7 and 5, of which the second appears later: each row holds what its carrier's first row holds.
TEST(Tables, RowsKnowHowTheirCarrierBegan) {
  Table t;
  t.numbers = {{"id", {7.0, 7.0, 5.0, 7.0, 5.0}}, {"u", {1.0, 2.0, 3.0, 4.0, 5.0}}};
  add_first_columns(t, "id");
  EXPECT_EQ(t.numbers.at("first_u"), (std::vector<double>{1.0, 1.0, 3.0, 1.0, 3.0}));
  EXPECT_EQ(t.numbers.at("u"), (std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0}));
  const std::size_t columns = t.numbers.size();
  add_first_columns(t, "name");
  EXPECT_EQ(t.numbers.size(), columns) << "there is no such column to go by";
}

// Planes a and b at times 1 and 2; b has no row at time 3.
TEST(Tables, RowsKnowTheOtherPlanesAtTheirTime) {
  Table t;
  t.numbers = {{"time", {1.0, 1.0, 2.0, 2.0, 3.0}}, {"p", {10.0, 11.0, 20.0, 21.0, 30.0}}};
  t.words = {{"plane", {"a", "b", "a", "b", "a"}}};
  add_word_columns(t, "time", "plane");
  EXPECT_EQ(t.numbers.at("p.a"), (std::vector<double>{10.0, 10.0, 20.0, 20.0, 30.0}));
  EXPECT_EQ(t.numbers.at("p.b")[0], 11.0);
  EXPECT_EQ(t.numbers.at("p.b")[3], 21.0);
  EXPECT_TRUE(std::isnan(t.numbers.at("p.b")[4]));
  const std::size_t columns = t.numbers.size();
  add_word_columns(t, "time", "patch");
  EXPECT_EQ(t.numbers.size(), columns) << "there is no such column to go by";
}

TEST_F(VerificationFile, WhatIsMissingOrNoNumberFails) {
  const Verification v = read(sample);
  const Outcome missing = evaluate(v, v.checks[0], {{"coarse", output(0.2)}});
  EXPECT_FALSE(missing.pass);
  EXPECT_NE(missing.problem.find("'fine' did not finish"), std::string::npos) << missing.problem;
  RunOutput broken = output(0.1);
  broken.table = [](const std::string&) {
    Table t;
    t.numbers = {{"time", {1.0}}, {"u", {std::nan("")}}};
    t.words = {{"probe", {"a"}}};
    return t;
  };
  const std::map<std::string, RunOutput> runs{{"coarse", broken}, {"fine", broken}};
  for (const Check& check : v.checks) EXPECT_FALSE(evaluate(v, check, runs).pass) << check.quantity;
}

TEST_F(VerificationFile, MistakesAreNamedWithTheirPlace) {
  EXPECT_NE(problems(replaced(sample, "y = \"u/U", "y = \"u/")).find("reading"), std::string::npos);
  EXPECT_NE(problems(replaced(sample, "reduce = \"last\"", "reduce = \"latest\"")).find("must be one of"),
            std::string::npos);
  EXPECT_NE(problems(replaced(sample, "tolerance = 0.15", "tolerence = 0.15")).find("did you mean 'tolerance'"),
            std::string::npos);
  EXPECT_NE(problems(replaced(sample, "[\"coarse\", \"fine\"]", "[\"coarse\", \"fin\"]")).find("no run 'fin'"),
            std::string::npos);
  EXPECT_NE(problems(replaced(sample, "reason = \"rounding\"", "")).find("reason"), std::string::npos);
  EXPECT_NE(problems(replaced(sample, "\"U = 2\"", "\"U : 2\"")).find("name = formula"), std::string::npos);
}

TEST(Catalogue, OfThisTreeIsReadAndItsCasesExist) {
  const auto catalogue = read_catalogue(std::filesystem::path(PUFFIN_SOURCE_DIR) / "cases" / "verify");
  ASSERT_GE(catalogue.size(), 3u);
  for (const Verification& v : catalogue)
    for (const VerificationRun& run : v.runs) {
      SCOPED_TRACE(v.id + " " + run.name);
      EXPECT_NO_THROW(read_case(run.case_file, run.sets));
    }
  EXPECT_TRUE(std::filesystem::is_directory(verification_directory()));
}

TEST(Catalogue, HasChecksOfAllTwelveBenchmarksOfCarriers) {
  std::set<std::string> found;
  for (const Verification& v : read_catalogue(std::filesystem::path(PUFFIN_SOURCE_DIR) / "cases" / "verify"))
    if (v.suite == "dem") found.insert(v.id);
  for (int n = 1; n <= 12; ++n) {
    const std::string id = (n < 10 ? "D0" : "D") + std::to_string(n);
    EXPECT_TRUE(found.contains(id)) << id;
  }
}

}  // namespace
}  // namespace puffin::cases
