#pragma once
// Two finished runs side by side: every number of summary.json, every column of history.csv over time.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace puffin::output {

/// |a - b| <= absolute + relative * scale; scale: the larger of |a| and |b|, for a history column the largest |value|.
struct Tolerance {
  double absolute = 0.0, relative = 0.0;
};

/// By dotted name: "fines.drug.FFE", "history.static_drop"; a name stands for all that begin with it and a dot, and the
/// longest that fits counts. A ledger_error without a name in here may differ by 1e-12 of the dose.
struct Tolerances {
  Tolerance standard{0.0, 1e-9};
  std::map<std::string, Tolerance> named;
  std::vector<std::string> ignored;
};

struct Difference {
  std::string name;
  std::optional<double> a, b;  // absent: this run has no such number
  std::string said_a, said_b;  // of what is a word, no number: how the run ended
  std::optional<double> time;  // of the worst moment of a history column [s]
  double difference = 0.0;     // |a - b|; infinite if one is absent
  double allowed = 0.0;
  bool within() const { return difference <= allowed; }
};

/// One of the two.
struct ComparedRun {
  std::string folder, name, state;
  double time = 0.0;  // simulated [s]
};

struct Comparison {
  ComparedRun a, b;
  std::vector<Difference> differences;
  std::vector<std::string> notes;   // what a reader must know of runs of other lengths and names
  std::vector<std::string> unused;  // names in the tolerances that neither run has
};

/// One entry a number, in the order of A's files, then what B alone has; members of lists by their names. Left out:
/// what says how long a run took, with how many threads and which version. Runs with one set of fines each are compared
/// whatever the sets are called. Histories are compared at A's times, B's values linear between its own, over the
/// time that both have. Throws OutputError if a folder holds no finished or stopped run.
Comparison compare_runs(const std::filesystem::path& a, const std::filesystem::path& b, const Tolerances& tolerances);

/// What was compared, an aligned table of what differs, notes, and a last line that counts.
std::string comparison_text(const Comparison& comparison);
/// {"ok", "compared", "outside", "a", "b": {"folder", "name", "state", "simulated_time"}, "notes", "rows": [{"name",
/// "a", "b", "time", "difference", "allowed", "within"}]}
std::string comparison_json(const Comparison& comparison);

}  // namespace puffin::output
