#pragma once
// A study as runs of the program: which cases share a run, where each writes, what it is expected to cost.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/study.hpp"

namespace puffin::tools {

/// One case in a job, and the scalar of the run that is its own, or carried like it if its fines are replayed ("" where
/// the run is the case's alone).
struct Member {
  std::size_t which = 0;  // index in the study
  std::string scalar;
  std::string micromodels;     // its fines are replayed with this file; "" they are those of the run
  double fines_of_dose = 0.0;  // mass of the fines over that of the dose
};

struct Job {
  std::string id;               // also its folder below the study's: NAME/seed-N or shared/NAME+NAME/seed-N
  std::vector<Member> members;  // the first one's case file is run
  int replicate = 0;
  std::filesystem::path base;
  std::vector<cases::Override> sets;
  std::string resolved;  // the case as the run will write it; empty if it is invalid
  std::string laws;      // what its micro-model file holds; "" without
  std::string problem;   // why it is invalid
  double cost = 0.0;     // relative: cells times steps
  std::string flow;      // jobs with the same one run in one process and one flow; "" alone
  bool seeded = true;    // the seed acts on something: a replicate is another run
  bool settles = false;  // its dose falls before it starts: the bed can serve other runs of the study
};

struct Sharing {
  std::string name;  // a word of `share`
  bool done = false;
  std::string what, error;  // what is shared or why not; exact, or how far off
};

struct Jobs {
  std::vector<Job> jobs;
  std::vector<Sharing> sharings;
  std::vector<std::string> warnings;
};

/// share = scalars: cases that are equal but for their name, reference and the diffusion and scheme of their one
/// reflected scalar run once with a scalar each: fines do not act on air or carriers. share = micromodels: those that
/// are equal but for their micro-models run once with the first one's; the fines of the others are replayed. share =
/// start: doses that settle equally are settled once (cases/bed_store.hpp).
Jobs plan_jobs(const cases::Study& study, std::string_view preset);

/// Whether the name of one of its cases fits the pattern of --only, like "L-*"; every name fits "".
bool is_named(const cases::Study& study, const Job& job, const std::string& pattern);

}  // namespace puffin::tools
