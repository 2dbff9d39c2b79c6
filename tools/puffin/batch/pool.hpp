#pragma once
// Child processes of the program itself.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace puffin::tools {

/// A running `puffin ...`. Ends with the batch: the system sends it SIGTERM when the batch dies, whatever kills it, and
/// it writes a checkpoint.
class Child {
 public:
  /// stdout is dropped, stderr goes behind what `log` holds. Throws std::system_error.
  Child(const std::vector<std::string>& arguments, const std::filesystem::path& log);
  /// Its exit code once it has ended, 128 + n if signal n killed it; empty while it runs.
  std::optional<int> ended();
  void terminate() const;  // SIGTERM

 private:
  pid_t pid_ = -1;
};

/// The last line of a child's log that is not empty, or its first 400 characters.
std::string last_line(const std::filesystem::path& log);

/// Threads for the next run: the free cores divided among the runs that will start now.
int threads_for_next(int free_cores, int free_places, int waiting);

}  // namespace puffin::tools
