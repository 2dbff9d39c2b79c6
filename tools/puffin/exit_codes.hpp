#pragma once
// What the program returns. Scripts rely on these numbers.

#include <exception>
#include <stdexcept>

namespace puffin::tools {

enum ExitCode : int {
  ok = 0,
  internal_error = 1,
  usage = 2,
  case_invalid = 3,
  geometry_invalid = 4,
  diverged = 5,
  resources = 6,
  input_output = 7,
  batch_failed = 8,
  out_of_tolerance = 9,
  stopped = 75,       // cleanly, at --walltime or SIGTERM; can be resumed
  interrupted = 130,  // Ctrl-C, after a checkpoint
};

/// A command line that cannot be meant.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// More memory, disk or time than there is.
struct ResourceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The exit code that an exception stands for.
ExitCode exit_code(const std::exception& error);

}  // namespace puffin::tools
