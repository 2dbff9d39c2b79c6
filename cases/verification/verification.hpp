#pragma once
// What a file verify.toml says: which runs of a case to make, which numbers to read from their outputs, and what to
// compare them with. README.md in cases/verify describes the keys.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/read_case.hpp"
#include "cases/verification/formula.hpp"
#include "cases/verification/reductions.hpp"

namespace puffin::cases {

/// A named formula; those after it may use it.
struct Constant {
  std::string name;
  Formula formula;
};

/// One run of a case file with its variations.
struct VerificationRun {
  std::string name;
  std::string label;  // for people, in the lines of checks that are made of several runs; the name if not given
  std::filesystem::path case_file;
  std::vector<Override> sets;
  std::vector<Constant> constants;  // over those of the whole file
  bool quick = true;
};

/// Rows of a CSV file beside verify.toml.
struct ReferenceCurve {
  std::filesystem::path file;
  std::map<std::string, std::string> where;     // rows whose column holds this text
  std::optional<Formula> x, y;                  // of the columns and constants
  std::optional<std::array<double, 2>> window;  // rows with x in it
};

/// A number read from the output of a run.
struct Reading {
  std::string name;
  std::string output;                           // "history.csv", ..., "fields", "events.h5"
  std::map<std::string, std::string> where;     // rows whose column holds this text
  std::optional<Formula> filter;                // rows where this is not 0
  std::optional<Formula> x, y;                  // of the columns, constants and the run's own numbers
  std::optional<std::array<double, 2>> window;  // rows with x in it
  bool derivative = false;                      // dy/dx between neighbouring points instead of y
  std::optional<double> time;                   // fields: the moment nearest to it; the last one if absent
  std::optional<Reduction> each;                // fields: reduce every moment to one value over time first
  Reduction reduce = Reduction::last;
  std::optional<Formula> at, level, frequency;  // of the constants and the run's own numbers
  std::optional<Formula> exact;                 // ordinate of the exact curve, a formula of the columns too
  std::optional<ReferenceCurve> against;
};

enum class Measure { absolute, relative };
enum class Bound { both, at_least, at_most };

/// One line of the results.
struct Check {
  std::string quantity;
  std::optional<Formula> result;        // of readings, "RUN.READING", constants and the run's own numbers
  std::string run;                      // whose readings carry no run's name
  std::vector<std::string> order_over;  // runs: the value is the order of `result` over their dx
  std::optional<Formula> reference;     // of the constants
  double tolerance = 0.0;
  Measure measure = Measure::relative;
  Bound bound = Bound::both;
  std::string reason;  // of the tolerance
  std::string source;  // of the reference; that of the file if empty
};

struct Verification {
  std::filesystem::path folder;
  std::string id, suite, title, source;
  std::vector<Constant> constants;
  std::vector<VerificationRun> runs;
  std::vector<Reading> readings;
  std::vector<Check> checks;
};

/// Reads FOLDER/verify.toml. Throws CaseError with every problem, std::system_error if it cannot be read.
Verification read_verification(const std::filesystem::path& folder);

/// All of the catalogue in the folder, by id: the sub-folders with a verify.toml.
/// Throws as read_verification, and std::invalid_argument for two with one id.
std::vector<Verification> read_catalogue(const std::filesystem::path& folder);

}  // namespace puffin::cases
