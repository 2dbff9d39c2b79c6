#include "tools/puffin/batch/slurm.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <utility>

#include "tools/output/output_error.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

namespace fs = std::filesystem;

struct Answer {
  std::string text, errors;  // what it prints, and what it says of itself: plug-ins of a site are told there
  int code = 0;
};

Answer ask(const std::string& command, const fs::path& folder) {
  Answer answer;
  const fs::path errors = folder / "errors.txt";
  FILE* pipe = popen((command + " 2> " + shell_quoted(errors.string())).c_str(), "r");
  if (!pipe) throw output::OutputError("cannot start " + command);
  char piece[4096];
  while (const std::size_t n = fread(piece, 1, sizeof piece, pipe)) answer.text.append(piece, n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  answer.errors = output::read_whole(errors);
  for (std::string* text : {&answer.text, &answer.errors})
    while (!text->empty() && text->back() == '\n') text->pop_back();
  return answer;
}

/// Of "77" or "77;cluster", in a line of its own after whatever else a site prints.
std::string id_in(const std::string& text) {
  std::istringstream lines(text);
  std::string id;
  for (std::string line; std::getline(lines, line);) {
    const std::string first = line.substr(0, line.find(';'));
    if (!first.empty() && first.find_first_not_of("0123456789") == std::string::npos) id = first;
  }
  return id;
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

SlurmArray::SlurmArray(const fs::path& study, std::vector<std::string> names)
    : folder_(study / "slurm"), names_(std::move(names)) {
  std::ifstream stream(folder_ / "array.txt");
  stream >> id_;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::size_t job = 0;
    std::string name;
    if (!(words >> job)) continue;
    open_.push_back(job);
    std::getline(words >> std::ws, name);
    same_study_ = same_study_ && job < names_.size() && (name.empty() || names_[job] == name);
  }
}

bool SlurmArray::queued() {
  if (id_.empty() || open_.empty() || states().empty()) return false;
  if (!same_study_)
    throw output::OutputError("the study has other runs than when Slurm job " + id_ +
                              " was sent, which is still in the queue; end it with 'scancel " + id_ +
                              "', or give the changed study another folder with --out");
  return true;
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
              shell_quoted((folder_ / "array.sh").string()),
          folder_);
  if (answer.code != 0)
    throw output::OutputError("sbatch refused the array (exit code " + std::to_string(answer.code) +
                              "): " + answer.errors + answer.text);
  id_ = id_in(answer.text);
  if (id_.empty()) throw output::OutputError("sbatch gave no number of a job: " + answer.text + answer.errors);
  same_study_ = true;
  std::string book = id_ + "\n";
  for (const std::size_t job : open_) book += std::to_string(job) + " " + names_.at(job) + "\n";
  output::write_whole(folder_ / "array.txt", book);
}

/// Of the tasks that are in the queue: PENDING, RUNNING, COMPLETING, ... An array that Slurm no longer knows is empty.
std::map<std::size_t, std::string> SlurmArray::states() const {
  const Answer answer =
      ask("squeue --noheader --array --states=PENDING,CONFIGURING,RUNNING,COMPLETING,SUSPENDED,REQUEUED"
          " --format='%K %T' --jobs=" +
              shell_quoted(id_),
          folder_);
  std::map<std::size_t, std::string> states;
  if (answer.code != 0) {
    if ((answer.errors + answer.text).find("Invalid job id") != std::string::npos) return states;
    throw output::OutputError("squeue fails (exit code " + std::to_string(answer.code) + "): " + answer.errors +
                              answer.text);
  }
  std::istringstream lines(answer.text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::size_t job = 0;
    std::string state;
    if (words >> job >> state) states[job] = state;  // other lines are of the site's plug-ins
  }
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
