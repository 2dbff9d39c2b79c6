#pragma once
// What a file pareto.toml says: a verification whose error is weighed against run time, and the settings to try.
// cases/bench/README.md describes the keys.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/verification/verification.hpp"

namespace puffin::cases {

/// One way to run the case: what it changes against the default.
struct ParetoSetting {
  std::string label;
  std::vector<Override> sets;
  bool quick = false;  // part of the short benchmark
};

struct ParetoAxis {
  std::string name;
  std::vector<ParetoSetting> settings;
};

/// A setting with the axis it belongs to; the default has none.
struct ParetoPoint {
  std::string axis, label;
  std::vector<Override> sets;
};

struct ParetoCase {
  std::filesystem::path folder;
  std::string id, title, metric;       // metric: what the error is of, in words
  bool quick = true;                   // the short benchmark has this case
  int repeats = 1;                     // of the full benchmark
  Verification verification;           // with one run, "this"
  Check check;                         // of that run
  std::optional<Check> half_width;     // its value is the half width of the confidence interval of the check's value
  double reference_uncertainty = 0.0;  // in the unit of the reference
  std::vector<Override> sets, quick_sets;  // under every setting
  std::vector<ParetoSetting> variants;     // every setting is run under each of them; the error is that of all
  std::vector<ParetoSetting> references;   // runs; the first gives the reference instead of the check, the others say
                                           // how far it may be off
  std::vector<ParetoAxis> axes;
  std::vector<std::vector<std::string>> products;  // axes of which every combination is tried
};

/// The name of the one run of ParetoCase::verification.
inline constexpr char pareto_run[] = "this";

/// The default first, then every setting of every axis, then the products. quick: only the settings marked so.
std::vector<ParetoPoint> points_of(const ParetoCase& c, bool quick);

/// The reference runs of the short benchmark, or of the full one: those marked so, or all if none is.
std::vector<ParetoSetting> references_of(const ParetoCase& c, bool quick);

/// The runs of a point, with everything under it: one, or one a variant.
std::vector<VerificationRun> runs_of(const ParetoCase& c, const std::vector<Override>& sets, bool quick);

/// Reads FOLDER/pareto.toml. Throws CaseError with every problem, std::system_error if it cannot be read.
ParetoCase read_pareto(const std::filesystem::path& folder);

/// All of a folder by id: its sub-folders with a pareto.toml. Throws as read_pareto.
std::vector<ParetoCase> read_pareto_cases(const std::filesystem::path& folder);

}  // namespace puffin::cases
