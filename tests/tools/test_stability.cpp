// puffin bench stability: what it says of scenes that run and of one that cannot, and its plan.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace {

struct Result {
  int code = -1;
  std::string out;
};

Result puffin(const std::string& arguments, const std::string& errors = "2>/dev/null") {
  const std::string command = std::string(PUFFIN_BINARY_DIR) + "/puffin " + arguments + " " + errors;
  FILE* pipe = popen(command.c_str(), "r");
  Result result;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) result.out.append(buffer.data(), n);
  result.code = WEXITSTATUS(pclose(pipe));
  return result;
}

// The default runs through an outlet that a vortex crosses, and through vortices without any molecular viscosity.
TEST(Stability, TheDefaultRunsWhereItMust) {
  const Result result = puffin("bench stability --quick --only back-flow --only taylor-green --json");
  ASSERT_EQ(result.code, 0) << result.out;
  const auto rows = nlohmann::json::parse(result.out)["rows"];
  ASSERT_EQ(rows.size(), 3u);
  for (const auto& row : rows) {
    EXPECT_EQ(row["outcome"], "ok") << row;
    EXPECT_GT(row["steps"].get<int>(), 100) << row;
  }
  EXPECT_EQ(rows[1]["variation"], "tau 1/2");
  EXPECT_EQ(rows[1]["tau_min"].get<double>(), 0.5);
  EXPECT_GT(rows[2]["backflow"].get<int>(), 0) << "no air came back: the scene tests nothing";
}

// BGK at tau = 0.5001 and full flow cannot run: it is ended, and the first bad cell is named.
TEST(Stability, WhatDivergesIsNamed) {
  const Result result = puffin("bench stability --quick --only step-inlet --json");
  ASSERT_EQ(result.code, 0) << result.out;
  const auto rows = nlohmann::json::parse(result.out)["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["outcome"], "ok") << rows[0];
  EXPECT_EQ(rows[1]["variation"], "bgk");
  EXPECT_EQ(rows[1]["outcome"], "diverged") << rows[1];
  EXPECT_NE(rows[1]["why"].get<std::string>().find("cell"), std::string::npos) << rows[1]["why"];
}

TEST(Stability, NothingChosenIsAUsageErrorThatNamesTheScenes) {
  const Result result = puffin("bench stability --only nosuch", "2>&1");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.out.find("back-flow"), std::string::npos) << result.out;
}

}  // namespace
