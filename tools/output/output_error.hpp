#pragma once
// The one exception of the output writers: the disk is full, a folder cannot be written, a stored file is damaged.

#include <filesystem>
#include <stdexcept>

namespace puffin::output {

/// Input or output failed. The text names the file and what to do; the program ends with exit code 7.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws OutputError if there is a pipe, a device or a folder in place of a file, which may never end.
inline void demand_regular(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    throw OutputError(file.string() + " is no regular file, so it may never end");
}

}  // namespace puffin::output
