#pragma once
// What a batch knows of its runs, on disk: study.json, and status.json with a page while it goes on.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/puffin/batch/jobs.hpp"

namespace puffin::tools {

enum class JobState { waiting, running, done, failed, stopped };

struct JobRecord {
  JobState state = JobState::waiting;
  int exit_code = 0;
  std::string message;   // why it failed: the last line of its log
  double seconds = 0.0;  // of the last attempt
  int attempts = 0;
  int threads = 0;
};

/// The folder of a study, held by one batch at a time. Throws output::OutputError if another batch holds it.
class Book {
 public:
  Book(std::filesystem::path folder, const cases::Study& study, const Jobs& plan);
  ~Book();
  Book(const Book&) = delete;
  Book& operator=(const Book&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path run_folder(std::size_t job) const { return folder_ / plan_.jobs[job].id; }
  std::filesystem::path log_file(std::size_t job) const { return folder_ / plan_.jobs[job].id / "run.log"; }
  /// The list of the runs that share the flow of `job`, for puffin together.
  std::filesystem::path flow_file(std::size_t job) const { return folder_ / (plan_.jobs[job].flow + ".json"); }
  /// What the replay for a member writes; read by the tables.
  std::filesystem::path replay_file(std::size_t job, const Member& member) const;
  JobRecord& record(std::size_t job) { return records_[job]; }
  const JobRecord& record(std::size_t job) const { return records_[job]; }

  /// Whether the run's folder holds the finished run of this very case. Throws output::OutputError if it holds the
  /// finished run of another one.
  bool finished(std::size_t job) const;
  /// Whether there is a checkpoint to go on from.
  bool resumable(std::size_t job) const;
  /// Waits, at most 20 s, for a process of a killed batch that is still closing the files of this run.
  void wait_until_free(std::size_t job) const;
  /// Moves what a failed run left behind to ID.failed-N.
  void move_aside(std::size_t job) const;

  /// Moves aside what a run left whose summary.json cannot be read, and says so; false: there is no such thing.
  bool set_damaged_aside(std::size_t job) const;

  /// study.json, whole or not at all: the cases, their runs, and the state of each.
  void write() const;
  /// status.json and index.html. state: running, finished, failed, stopped.
  void write_live(const std::string& state, double wall_clock) const;

 private:
  std::filesystem::path folder_;
  const cases::Study& study_;
  const Jobs& plan_;
  std::vector<JobRecord> records_;
  int lock_ = -1;
};

const char* name_of(JobState state);

}  // namespace puffin::tools
