// puffin bench pareto: what it says of settings that run and of one that cannot, of its references and variants, and
// how a benchmark ends that chose nothing or was interrupted.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace {

using nlohmann::json;

const std::string program = std::string(PUFFIN_BINARY_DIR) + "/puffin";
const std::string cases = std::string(PUFFIN_SOURCE_DIR) + "/cases";

struct Result {
  int code = -1;
  std::string out;
};

Result puffin(const std::string& arguments, const std::string& errors = "2>/dev/null") {
  FILE* pipe = popen((program + " " + arguments + " " + errors).c_str(), "r");
  Result result;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) result.out.append(buffer.data(), n);
  result.code = WEXITSTATUS(pclose(pipe));
  return result;
}

/// A catalogue of one case: one impact of a carrier on a wall, a fraction of a second, with these lines at its end.
class Catalogue {
 public:
  explicit Catalogue(const std::string& more) {
    folder_ = std::filesystem::temp_directory_path() / ("puffin-bench-" + std::to_string(getpid()) +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_ / "x");
    std::ofstream(folder_ / "x" / "pareto.toml")
        << "id = \"X\"\ntitle = \"an impact\"\nverify = \"" << cases << "/verify/restitution\"\nrun = \"e080\"\n"
        << "check = \"linear contact, restitution 0.8\"\n"
        << more;
  }
  ~Catalogue() { std::filesystem::remove_all(folder_); }
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;
  std::string arguments() const { return "bench pareto --catalogue " + folder_.string(); }
  std::filesystem::path out() const { return folder_ / "out"; }

 private:
  std::filesystem::path folder_;
};

/// Cells of a line of CSV; those in quotes may hold commas.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

// Whoever draws error over seconds from the tables must not find that the setting that failed is the best.
TEST(BenchPareto, ASettingThatFailedHasNoNumbers) {
  const Catalogue catalogue(
      "[[axis]]\nname = \"contact\"\n[[axis.setting]]\nlabel = \"none\"\nset = [\"carriers.contact.max_overlap=7\"]\n");
  const Result result = puffin(catalogue.arguments() + " --json --out " + catalogue.out().string());
  ASSERT_EQ(result.code, 0) << result.out;
  const json rows = json::parse(result.out)["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["outcome"], "ok");
  EXPECT_LT(rows[0]["error"].get<double>(), 0.01);
  EXPECT_EQ(rows[1]["outcome"], "exit 3");
  EXPECT_GT(rows[1]["processor_seconds"].get<double>(), 0.0);
  const std::vector<std::string> numbers{"error",
                                         "error_half_width",
                                         "value",
                                         "value_half_width",
                                         "value_spread",
                                         "reference",
                                         "reference_uncertainty",
                                         "time_over_front",
                                         "time_over_front_certain",
                                         "front_error",
                                         "error_over_front",
                                         "cells"};
  for (const std::string& key : numbers) EXPECT_TRUE(rows[1].at(key).is_null()) << key << " " << rows[1][key];

  std::ifstream in(catalogue.out() / "pareto.csv");
  std::string header, good, bad;
  std::getline(in, header), std::getline(in, good), std::getline(in, bad);
  const auto names = split(header);
  for (const std::string& key : numbers) {
    const auto at = std::find(names.begin(), names.end(), key) - names.begin();
    EXPECT_EQ(split(bad).at(static_cast<std::size_t>(at)), "nan") << key;
    EXPECT_NE(split(good).at(static_cast<std::size_t>(at)), "nan") << key;
  }
}

// value and its half width, reference and its uncertainty stand in the metric's unit, the error's bar on its own scale.
TEST(BenchPareto, WidthsStandInTheUnitOfWhatTheyBelongTo) {
  const Catalogue catalogue("reference_uncertainty = 0.3\nhalf_width = \"0.4\"\n");
  const json row = json::parse(puffin(catalogue.arguments() + " --json").out)["rows"][0];
  EXPECT_DOUBLE_EQ(row["reference"], 0.8);
  EXPECT_DOUBLE_EQ(row["reference_uncertainty"], 0.3);
  EXPECT_DOUBLE_EQ(row["value_half_width"], 0.4);
  EXPECT_DOUBLE_EQ(row["error_half_width"], 0.5 / 0.8);  // hypot(0.3, 0.4) over the reference
}

// A restitution of 0.8 asked for, once with 0.7 and once with 0.9 set instead: right in the mean, off by 0.1 each time.
TEST(BenchPareto, TheErrorOverVariantsIsTheirRootMeanSquare) {
  const Catalogue catalogue(
      "[[variant]]\nlabel = \"low\"\nset = [\"carriers.contact.restitution=0.7\"]\n"
      "[[variant]]\nlabel = \"high\"\nset = [\"carriers.contact.restitution=0.9\"]\n");
  const json row = json::parse(puffin(catalogue.arguments() + " --json").out)["rows"][0];
  EXPECT_EQ(row["outcome"], "ok") << row;
  EXPECT_NEAR(row["value"], 0.8, 0.005);
  EXPECT_NEAR(row["value_spread"], 0.1, 0.005);
  EXPECT_NEAR(row["error"], 0.1 / 0.8, 0.005);
}

// References that none is marked for the mode are taken rather than the check's placeholder.
TEST(BenchPareto, ReferencesOfTheOtherModeAreBetterThanNone) {
  const std::string reference = "[[reference]]\nlabel = \"softer\"\nset = [\"carriers.contact.restitution=0.5\"]\n";
  for (const char* quick : {"", "quick = true\n"})
    for (const char* mode : {"", " --quick"}) {
      const Catalogue catalogue(reference + quick);
      const json row = json::parse(puffin(catalogue.arguments() + " --json" + mode).out)["rows"][0];
      EXPECT_NEAR(row["reference"], 0.5, 0.005) << quick << mode;
    }
}

TEST(BenchPareto, NothingChosenIsAUsageErrorThatNamesWhatThereIs) {
  const Result unknown = puffin("bench pareto --only P99", "2>&1");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.out.find("P9d"), std::string::npos) << unknown.out;
  const Result full = puffin("bench pareto --quick --only P9d", "2>&1");  // its references are long runs
  EXPECT_EQ(full.code, 2);
  EXPECT_NE(full.out.find("leave --quick out"), std::string::npos) << full.out;
}

/// What a benchmark ends with that a signal reaches once it has said what it does.
int code_after(int signal, const std::vector<std::string>& words) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return -1;
  const pid_t pid = fork();
  if (pid == 0) {
    std::vector<const char*> argv{program.c_str()};
    for (const std::string& word : words) argv.push_back(word.c_str());
    argv.push_back(nullptr);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    execv(argv[0], const_cast<char* const*>(argv.data()));
    _exit(1);
  }
  close(ends[1]);
  char c = 0;
  while (read(ends[0], &c, 1) == 1 && c != '\n') continue;
  kill(pid, signal);
  int status = 0;
  waitpid(pid, &status, 0);
  close(ends[0]);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Each of these runs for minutes, in children of its own or (stability) in the program itself.
TEST(BenchPareto, ABenchmarkThatIsInterruptedSaysSo) {
  EXPECT_EQ(code_after(SIGINT, {"bench", "pareto", "--only", "P9"}), 130);
  EXPECT_EQ(code_after(SIGTERM, {"bench", "pareto", "--only", "P9"}), 75);
  EXPECT_EQ(code_after(SIGINT, {"bench", "stability", "--only", "drift"}), 130);
  EXPECT_EQ(code_after(SIGINT, {"bench", "skip"}), 130);
  EXPECT_EQ(code_after(SIGINT, {"bench", "scaling"}), 130);
}

}  // namespace
