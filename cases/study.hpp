#pragma once
// Study file (TOML): many cases from one or several bases, for `puffin batch`.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/read_case.hpp"

namespace puffin::cases {

/// A base case with changes. The changes are not checked yet: read_study_case does that, case by case.
struct StudyCase {
  std::string name;
  std::filesystem::path base;             // as it can be opened
  std::vector<Override> sets;             // in the order of the file, those of the sweep behind
  std::vector<std::string> swept;         // keys that the sweep sets
  std::map<std::string, KeyPlace> where;  // of each key, in the study file
};

/// What cases may share: what is asked for, done as far as it is exact.
struct Share {
  bool geometry = false, scalars = false, micromodels = false, start = false, one_way_flow = false;
};

struct Study {
  std::filesystem::path file;
  Share share;
  int replicates = 1;                 // runs a case, with seeds that follow the case's own
  std::filesystem::path experiments;  // a table of measurements to stand beside the results; empty: none
  std::vector<StudyCase> cases;
};

/// Reads a study file: base, share, replicates, experiments, [[case]] name, base, set; [sweep] method, samples, seed,
/// [sweep.range]. A sweep multiplies each case (without [[case]]: the base alone); its cases are called NAME-1, NAME-2,
/// ...
///   list       the n-th values of all ranges together
///   factorial  every combination; with `samples`, so many equal steps between two ends
///   lhs        `samples` points, one in each of as many equal parts of every range (Latin hypercube, McKay, Beckman &
///              Conover, Technometrics 21, 239 (1979)), the same for the same seed
/// Throws CaseError with every problem of the file, std::system_error if it cannot be read.
Study read_study(const std::filesystem::path& file);

/// The case with its changes and the seed of a replicate (0: the case's own). Throws CaseError; a problem with a change
/// stands at its place in the study file.
Case read_study_case(const StudyCase& c, int replicate, std::string_view preset = {});

/// What to lay over the base for a replicate: the case's changes and name, and the seed where it is not the case's own.
std::vector<Override> overrides_of(const StudyCase& c, int replicate);

}  // namespace puffin::cases
