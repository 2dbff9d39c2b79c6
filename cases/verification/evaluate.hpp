#pragma once
// Checks of a verification against the outputs of its runs.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cases/verification/verification.hpp"

namespace puffin::cases {

/// Rows of an output file; a column is numbers, words or both.
struct Table {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::string>> words;
  std::size_t rows() const { return numbers.empty() ? 0 : numbers.begin()->second.size(); }
};

/// Adds, for each column NAME of numbers, a column "first_NAME": what the first row with the same number in `key`
/// holds. So a row of tracks.csv knows how its carrier began. No column `key`: nothing is added.
void add_first_columns(Table& table, const std::string& key);

/// Adds, for each column NAME of numbers and each WORD in the column `word`, a column "NAME.WORD": what the row with
/// that word and the same number in `key` holds, NaN if there is none. So a row of planes.csv knows the other planes at
/// its time. No column `key` or `word`: nothing is added.
void add_word_columns(Table& table, const std::string& key, const std::string& word);

/// What the runs left behind, as the evaluation asks for it.
struct RunOutput {
  /// The whole numbers of summary.json by their dotted keys, "dx", "pressure.static_drop.mean".
  std::map<std::string, double> numbers;
  /// A table by its file's name. Throws if there is no such file.
  std::function<Table(const std::string& output)> table;
  /// Moments of the fields: their times, and the cells of one of them (columns x, y, z, u, v, w, p, fines_SCALAR,
  /// time).
  std::function<std::vector<double>()> field_times;
  std::function<Table(std::size_t moment)> field;
};

struct Outcome {
  double value = 0.0, reference = 0.0;  // NaN: could not be computed, and `problem` says why
  double error = 0.0;                   // distance from the reference, over it if the measure is relative; beyond a
                                        // bound, how far
  bool pass = false;
  std::string problem;
};

/// The runs that a check needs, in the order of the file.
std::vector<std::string> runs_of(const Verification& v, const Check& check);

/// outputs: by the name of the run. A missing run, a reading that cannot be made and a NaN are failures, with the
/// reason in Outcome::problem. Never throws for what the outputs hold.
Outcome evaluate(const Verification& v, const Check& check, const std::map<std::string, RunOutput>& outputs);

/// One reading of one run. Throws std::invalid_argument and what the output's functions throw.
double evaluate(const Verification& v, const Reading& reading, const VerificationRun& run, const RunOutput& output);

}  // namespace puffin::cases
