#pragma once
// How a batch calls the program itself: for its runs, and for the replays of cases that share one.

#include <string>
#include <vector>

#include "tools/puffin/batch/book.hpp"

namespace puffin::tools {

/// Of `puffin run` for a job that goes alone, with --resume where it can go on; of `puffin together` for a group with
/// one flow, whose list it writes. preset: "" none.
std::vector<std::string> run_arguments(const std::vector<std::size_t>& group, int threads, const std::string& preset,
                                       const Jobs& plan, const Book& book);

/// The exit code of one of the jobs that ran in a process which returned `code` and whose words are in the log of
/// `starter`. Of a shared flow each has its own, and why it failed goes to the end of its own log too.
int own_code(std::size_t job, std::size_t starter, int code, const Jobs& plan, const Book& book);

/// What a finished run still lacks: `puffin replay` for each case of the job that differs from its run in the
/// micro-models and has none of these laws yet, and `puffin report` if it was killed before its page was written. False
/// if a case has no tables for all that, which is told.
bool complete(std::size_t job, const cases::Study& study, const Jobs& plan, const Book& book);

}  // namespace puffin::tools
