#pragma once
// How far the answers of a run move when something else is computed, each beside how well it is known itself.

#include <map>
#include <string>
#include <vector>

namespace puffin::bench {

/// Numbers of one run by name: shares of the fines, a pressure drop.
using Answers = std::map<std::string, double>;

/// What is compared of a run, from the numbers of its summary.json by their dotted keys: the shares of the fines (FFE,
/// FFW, FFCR, FFCE of `scalar`, or of the only one), those of the carriers (retained_fraction), and `more` keys.
/// Throws std::invalid_argument if the run lacks one of `more`, or has several scalars and none is named.
Answers answers_of(const std::map<std::string, double>& numbers, const std::vector<std::string>& more,
                   const std::string& scalar = "");

/// Half the 95 % confidence interval of each answer's mean over `runs` runs, from its scatter among replicates (runs
/// that differ by their seed alone): t s / sqrt(runs), with the standard deviation s of the replicates and Student's t
/// of one degree of freedom less than there are.
/// Throws std::invalid_argument for fewer than two replicates, or if they do not all have the same answers.
Answers half_widths(const std::vector<Answers>& replicates, int runs);

/// For answers KEY.mean of a run that gives KEY.ci_low and KEY.ci_high too (a mean over time by batches): half that
/// interval over sqrt(runs). Fillings of a dose that still rests do not make the air's own fluctuations differ.
Answers own_half_widths(const std::map<std::string, double>& numbers, const std::vector<std::string>& names, int runs);

/// The answer that moved farthest, measured by its own interval.
struct Shift {
  std::string answer;
  double change = 0.0, half_width = 0.0;  // of that answer, in its unit
  double ratio = 0.0;                     // change over half_width; infinite where what has no interval moved
  bool within = true;                     // every answer moved by no more than its own interval
};

/// Compares the means over runs that come in pairs, of equal seeds and in the same order. exact: no run may move at
/// all; the change is then the largest of a run.
/// Answers without a half width are not compared. Throws std::invalid_argument if there are none, or if a run lacks one
/// that is.
Shift farthest_shift(const std::vector<Answers>& with, const std::vector<Answers>& without, const Answers& half_widths,
                     bool exact);

}  // namespace puffin::bench
