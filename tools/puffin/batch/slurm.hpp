#pragma once
// The runs of a study as one job array of Slurm (sbatch, squeue). What a task needs is on disk: slurm/ in the folder of
// the study, which every node must see under the same path.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace puffin::tools {

struct SlurmTask {
  std::size_t job = 0;                 // index in the plan; also the array index
  std::vector<std::string> arguments;  // of this program
  std::filesystem::path log;           // what it says goes here
};

class SlurmArray {
 public:
  /// Remembers the array of an earlier call, if slurm/array.txt names one. `names`: of the study's jobs now.
  SlurmArray(const std::filesystem::path& study, std::vector<std::string> names);

  /// Whether the remembered array still has tasks in the queue. Then open() are those not yet booked as ended. Throws
  /// output::OutputError if it has and its jobs are not those of the study now.
  bool queued();
  /// Writes slurm/task-N.sh and slurm/array.sh and sends them with sbatch; `at_a_time` 0: no limit. Partition, account
  /// and time limit are sbatch's own environment variables (SBATCH_PARTITION, ...). Throws output::OutputError with
  /// what sbatch said.
  void submit(const std::string& name, const std::vector<SlurmTask>& tasks, int cores, int at_a_time);

  struct Change {
    std::size_t job = 0;
    bool ended = false;  // else: it is running
    int exit_code = 0;   // of the program; 75 if Slurm ended the task before it could say
  };
  /// What is new in the queue.
  std::vector<Change> poll();

  const std::string& id() const { return id_; }
  /// Jobs whose end has not been seen yet.
  const std::vector<std::size_t>& open() const { return open_; }

 private:
  std::map<std::size_t, std::string> states() const;

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  bool same_study_ = true;  // as when the remembered array was sent
  std::string id_;
  std::vector<std::size_t> open_;
};

/// A word as the shell reads it back: in single quotes.
std::string shell_quoted(const std::string& word);

}  // namespace puffin::tools
