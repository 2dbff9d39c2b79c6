#pragma once
// A run of a case in a process of its own, as a benchmark needs it: nothing left over from the one before.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/read_case.hpp"
#include "cases/verification/evaluate.hpp"

namespace puffin::tools {

struct ChildRun {
  int exit_code = 0;
  double seconds = 0.0;                    // wall-clock of the whole process
  double processor_seconds = 0.0;          // of all its threads
  double foreign_load = 0.0;               // share of the cores that other processes used meanwhile
  std::string problem;                     // the last line that it logged, where it failed
  std::optional<cases::RunOutput> output;  // of a run that ended well
};

/// A signal came: the run that it came in has been ended, and the rest is not made. Signals::code() is the exit code.
struct BenchStopped {};

/// Runs `puffin run CASE --set ... --out FOLDER --quiet`, waits, and reads what it left. FOLDER must not exist.
/// std::system_error if no process can be had; BenchStopped after a signal that a living Signals has noted.
ChildRun run_child(const std::filesystem::path& case_file, const std::vector<cases::Override>& sets,
                   const std::filesystem::path& folder, const std::vector<std::string>& more = {});

/// A folder for runs that is removed at the end.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// A path in it that nothing has yet.
  std::filesystem::path fresh();

 private:
  std::filesystem::path path_;
  int count_ = 0;
};

}  // namespace puffin::tools
