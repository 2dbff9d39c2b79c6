#pragma once
// Everything that is wrong with a case file, at once.

#include <stdexcept>
#include <string>
#include <vector>

namespace puffin::cases {

/// One mistake of the user. `text` says what is wrong with which key and value, and what to do.
struct Problem {
  std::string file;  // as given by the user; "--set" for an override, "--preset NAME" for a preset
  int line = 0;      // 1-based; 0: no place in a file
  int column = 0;
  std::string key;  // dotted, may be empty
  std::string text;
  std::string to_string() const;  // file:line:column: error: text; one line without control characters
};

/// Thrown by the readers with all the problems of a file; what() is one line a problem.
struct CaseError : std::runtime_error {
  explicit CaseError(std::vector<Problem> problems);
  std::vector<Problem> problems;
};

}  // namespace puffin::cases
