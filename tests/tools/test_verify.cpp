// puffin verify: the quick catalogue passes, and faults put into it are found.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/sanitized.hpp"

namespace {

using puffin::sanitized;

struct Result {
  int code = -1;
  std::string out;
};

/// What the program writes to stdout; `errors`: where stderr goes.
Result puffin(const std::string& arguments, const std::string& errors = "2>/dev/null") {
  const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin " + arguments + " " + errors;
  FILE* pipe = popen(command.c_str(), "r");
  Result result;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) result.out.append(buffer.data(), n);
  result.code = WEXITSTATUS(pclose(pipe));
  return result;
}

TEST(Verify, QuickCataloguePassesAndSaysWhatEveryCheckFound) {
  // The flows take half an hour in a sanitized build; two of them run in the claims below.
  const Result result =
      puffin(std::string("verify --quick --json") + (sanitized ? " --suite scalar --suite dem --suite coupling" : ""));
  EXPECT_EQ(result.code, 0) << result.out;
  const auto json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json.size(), 1u);
  ASSERT_GE(json["cases"].size(), 12u);
  const std::set<std::string> keys{"id",        "suite", "quantity", "reference", "value", "error",
                                   "tolerance", "pass",  "cells",    "seconds",   "source"};
  for (const auto& row : json["cases"]) {
    std::set<std::string> found;
    for (const auto& [key, value] : row.items()) found.insert(key);
    EXPECT_EQ(found, keys);
    EXPECT_TRUE(row["pass"].get<bool>()) << row;
    EXPECT_LE(row["error"].get<double>(), row["tolerance"].get<double>()) << row;
    EXPECT_FALSE(row["source"].get<std::string>().empty());
  }
}

// 1.806e-5 Pa s + 5 %: f Re of a body force moves by 5 %, the decay of the vortices too; both are known to 1 %.
TEST(Verify, ViscosityFivePercentTooHighIsOutOfTolerance) {
  const Result result = puffin("verify --only V01 --only V05 --quick --json --set air.viscosity=1.8963e-5");
  EXPECT_EQ(result.code, 9) << result.out;
  const auto json = nlohmann::json::parse(result.out);
  std::set<std::string> failed;
  for (const auto& row : json["cases"])
    if (!row["pass"].get<bool>()) failed.insert(row["id"].get<std::string>());
  EXPECT_EQ(failed, (std::set<std::string>{"V01", "V05"}));
}

// The channel of 16 cells of 0.0625 mm gets a wall 0.3 cells further out.
TEST(Verify, WallOffByThreeTenthsOfACellIsOutOfTolerance) {
  const Result result = puffin("verify --only V01 --quick --json --set geometry.box.z=1.01875e-3");
  EXPECT_EQ(result.code, 9) << result.out;
  bool found = false;
  const auto json = nlohmann::json::parse(result.out);
  for (const auto& row : json["cases"])
    if (row["quantity"].get<std::string>().starts_with("wall position, high side")) {
      found = true;
      EXPECT_FALSE(row["pass"].get<bool>());
      EXPECT_NEAR(row["value"].get<double>(), 0.3, 0.05) << "the tolerance of the wall's place";
    }
  EXPECT_TRUE(found);
}

// Adhesion times 1.3, friction times 1.2, restitution 0.05 too high, a modulus 5 % too high: each turns its benchmark
// red.
TEST(Verify, FaultsOfContactsAndAdhesionAreOutOfTolerance) {
  for (const std::string fault :
       {"D02 --set carriers.contact.youngs_modulus=4.2e10", "D05 --set carriers.contact.friction=0.36",
        "D06 --set carriers.contact.restitution=0.55", "D09 --set carriers.contact.friction=0.12",
        "D10 --set carriers.adhesion.surface_energy=4.68e-3", "D11 --set carriers.adhesion.surface_energy=4.68e-3",
        "D12 --set carriers.adhesion.surface_energy=4.68e-3"}) {
    const Result result = puffin("verify --quick --json --only " + fault);
    EXPECT_EQ(result.code, 9) << fault << result.out;
    for (const auto& row : nlohmann::json::parse(result.out)["cases"])
      EXPECT_TRUE(row["value"].is_number()) << fault << ": the run is to end, and to be wrong\n" << row;
  }
}

TEST(Verify, UnknownNamesAreUsageErrorsAndFailedRunsAreFailures) {
  EXPECT_EQ(puffin("verify --suite flows").code, 2);
  EXPECT_EQ(puffin("verify --only V99").code, 2);
  EXPECT_EQ(puffin("verify --set nonsense").code, 2);
  const Result slow = puffin("verify --quick --only V08 --only V01", "2>&1");  // no check of it is quick
  EXPECT_EQ(slow.code, 2);
  EXPECT_NE(slow.out.find("V08: --quick leaves it out; the quick cases are"), std::string::npos) << slow.out;
  const Result elsewhere = puffin("verify --suite flow --only D03", "2>&1");
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_NE(elsewhere.out.find("V01"), std::string::npos) << elsewhere.out;
  const Result result = puffin("verify --only V01 --quick --set numerics.nonsense=1", "2>&1");
  EXPECT_EQ(result.code, 9) << result.out;
  EXPECT_NE(result.out.find("did not finish"), std::string::npos) << result.out;
}

// What would break every run does not matter to runs that are finished; without --resume they are never overwritten.
TEST(Verify, GoesOnWhereItStoppedAndJudgesFinishedRunsAsTheyAre) {
  const auto folder = std::filesystem::temp_directory_path() / ("puffin-resumed-" + std::to_string(getpid()));
  const std::string command = "verify --only P09 --json --out " + folder.string();
  const Result first = puffin(command);
  EXPECT_EQ(first.code, 0) << first.out;
  EXPECT_EQ(puffin(command + " --set numerics.nonsense=1").code, 9);
  const Result again = puffin(command + " --resume --set numerics.nonsense=1");
  EXPECT_EQ(again.code, 0) << again.out;
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(puffin("verify --resume").code, 2);
  std::filesystem::remove_all(folder);
}

}  // namespace
