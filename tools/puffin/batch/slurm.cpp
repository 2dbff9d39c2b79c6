#include "tools/puffin/batch/slurm.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

namespace fs = std::filesystem;

struct Answer {
  std::string text;
  int code = 0;
};

/// What a command prints, with its errors.
Answer ask(const std::string& command) {
  Answer answer;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw output::OutputError("cannot start " + command);
  char piece[4096];
  while (const std::size_t n = fread(piece, 1, sizeof piece, pipe)) answer.text.append(piece, n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  while (!answer.text.empty() && answer.text.back() == '\n') answer.text.pop_back();
  return answer;
}

std::string listed(const std::vector<std::size_t>& jobs) {
  std::string text;
  for (const std::size_t n : jobs) {
    if (!text.empty()) text += ',';
    text += std::to_string(n);
  }
  return text;
}

fs::path file_of(const fs::path& folder, std::size_t job, const char* kind) {
  std::string name = "task-";
  name += std::to_string(job);
  name += kind;
  return folder / name;
}
fs::path code_file(const fs::path& folder, std::size_t job) { return file_of(folder, job, ".exit"); }
fs::path script_file(const fs::path& folder, std::size_t job) { return file_of(folder, job, ".sh"); }

}  // namespace

std::string shell_quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

SlurmArray::SlurmArray(const fs::path& study) : folder_(study / "slurm") {
  std::ifstream stream(folder_ / "array.txt");
  stream >> id_;
  for (std::size_t job = 0; stream >> job;) open_.push_back(job);
}

bool SlurmArray::queued() {
  if (id_.empty() || states().empty()) return false;
  return !open_.empty();
}

void SlurmArray::submit(const std::string& name, const std::vector<SlurmTask>& tasks, int cores, int at_a_time) {
  fs::create_directories(folder_);
  open_.clear();
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  for (const SlurmTask& task : tasks) {
    std::string command = shell_quoted(program);
    for (const std::string& word : task.arguments) command.append(" ").append(shell_quoted(word));
    fs::remove(code_file(folder_, task.job));
    // Slurm's SIGTERM must reach the program, which then writes a checkpoint: the shell waits twice, as a trap ends
    // `wait`.
    output::write_whole(script_file(folder_, task.job),
                        command + " 2>> " + shell_quoted(task.log.string()) +
                            " > /dev/null < /dev/null &\nrun=$!\ntrap 'kill -TERM $run' TERM\nwait $run\ncode=$?\n"
                            "if kill -0 $run 2> /dev/null; then wait $run; code=$?; fi\necho $code > " +
                            shell_quoted(code_file(folder_, task.job).string()) + "\nexit $code\n");
    open_.push_back(task.job);
  }
  output::write_whole(folder_ / "array.sh",
                      "#!/bin/sh\n#SBATCH --job-name=" + output::folder_name(name) + "\n#SBATCH --cpus-per-task=" +
                          std::to_string(cores) + "\n#SBATCH --output=/dev/null\n#SBATCH --signal=B:TERM@120\n. " +
                          shell_quoted((folder_ / "task-").string()) + "\"$SLURM_ARRAY_TASK_ID\".sh\n");
  const Answer answer =
      ask("sbatch --parsable --array=" + listed(open_) + (at_a_time > 0 ? "%" + std::to_string(at_a_time) : "") + " " +
          shell_quoted((folder_ / "array.sh").string()));
  if (answer.code != 0)
    throw output::OutputError("sbatch refused the array (exit code " + std::to_string(answer.code) +
                              "): " + answer.text);
  id_ = answer.text.substr(0, answer.text.find_first_of("; \n"));
  std::string book = id_ + "\n";
  for (const std::size_t job : open_) book += std::to_string(job) + "\n";
  output::write_whole(folder_ / "array.txt", book);
}

/// Of the tasks that are in the queue: PENDING, RUNNING, COMPLETING, ... An array that Slurm no longer knows is empty.
std::map<std::size_t, std::string> SlurmArray::states() const {
  const Answer answer =
      ask("squeue --noheader --array --states=PENDING,CONFIGURING,RUNNING,COMPLETING,SUSPENDED,REQUEUED"
          " --format='%K %T' --jobs=" +
          shell_quoted(id_));
  std::map<std::size_t, std::string> states;
  if (answer.code != 0) {
    if (answer.text.find("Invalid job id") != std::string::npos) return states;
    throw output::OutputError("squeue fails (exit code " + std::to_string(answer.code) + "): " + answer.text);
  }
  std::istringstream lines(answer.text);
  std::size_t job = 0;
  for (std::string state; lines >> job >> state;) states[job] = state;
  return states;
}

std::vector<SlurmArray::Change> SlurmArray::poll() {
  const std::map<std::size_t, std::string> queue = states();
  std::vector<Change> changes;
  std::vector<std::size_t> still;
  for (const std::size_t job : open_) {
    if (const auto found = queue.find(job); found != queue.end()) {
      still.push_back(job);
      if (found->second == "RUNNING") changes.push_back({job, false, 0});
      continue;
    }
    std::ifstream stream(code_file(folder_, job));
    int code = stopped;
    if (!(stream >> code)) code = stopped;  // ended by Slurm: out of time, a node lost
    changes.push_back({job, true, code});
  }
  open_ = still;
  return changes;
}

}  // namespace puffin::tools
