#pragma once
// The one exception of the output writers: the disk is full, a folder cannot be written, a stored file is damaged.

#include <stdexcept>

namespace puffin::output {

/// Input or output failed. The text names the file and what to do; the program ends with exit code 7.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace puffin::output
