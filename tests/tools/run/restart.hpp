#pragma once
// A run of the program as a child that can be killed, and the comparison of two finished runs.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace puffin {

inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream all;
  all << stream.rdbuf();
  return all.str();
}

class Child {
 public:
  Child(const std::vector<std::string>& arguments, const std::filesystem::path& log) : process_(fork()) {
    if (process_ != 0) return;
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    const std::string program = std::string(PUFFIN_BINARY_DIR) + "/puffin";
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execv(program.c_str(), words.data());
    _exit(127);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (!waited_) kill(process_, SIGKILL), wait();
  }
  void send(int signal) const { kill(process_, signal); }
  /// From now on no file of it may grow beyond this.
  void limit_file_size(const rlimit& limit) const { prlimit(process_, RLIMIT_FSIZE, &limit, nullptr); }
  /// Threads that it has now; 0 once it has ended.
  int threads() const {
    std::error_code error;
    const std::filesystem::directory_iterator tasks("/proc/" + std::to_string(process_) + "/task", error), end;
    return error ? 0 : static_cast<int>(std::distance(tasks, end));
  }
  /// True if it ended by itself within the time.
  bool ends_within(std::chrono::milliseconds time) {
    for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) {
      if (waitpid(process_, &status_, WNOHANG) == process_) return waited_ = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  /// Exit code, or -signal.
  int wait() {
    if (!waited_) waitpid(process_, &status_, 0);
    waited_ = true;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  }

 private:
  pid_t process_;
  int status_ = 0;
  bool waited_ = false;
};

/// Every table, HDF5 file and VTK file of two finished runs has the same bytes, and summary.json (of which summary.csv
/// is the table) the same numbers but for those that say how long it took on which machine.
inline void expect_same_outputs(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto outputs = [](const std::filesystem::path& run) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(run)) {
      const std::string kind = entry.path().extension();
      if (entry.path().filename() == "summary.csv") continue;
      if (kind == ".csv" || kind == ".h5" || kind == ".pvd" || kind == ".vti" || kind == ".vtp")
        names.insert(entry.path().lexically_relative(run));
    }
    return names;
  };
  ASSERT_EQ(outputs(a), outputs(b));
  for (const std::string& name : outputs(a)) EXPECT_TRUE(file_text(a / name) == file_text(b / name)) << name;
  std::istringstream left(file_text(a / "summary.json")), right(file_text(b / "summary.json"));
  const auto timed = [](const std::string& line) {
    for (const char* key : {"\"wall_clock\"", "\"threads\"", "\"mlups\"", "\"mlups_active\"", "\"memory_peak\"",
                            "\"seconds_saved\"", "\"set-up\"", "\"air\"", "\"walls and openings\"", "\"exchange\"",
                            "\"carriers\": ", "\"fines\": ", "\"transport\"", "\"output\"", "\"other\""})
      if (line.find(key) != std::string::npos && line.find('{') == std::string::npos) return true;
    return false;
  };
  for (std::string x, y; std::getline(left, x);) {
    ASSERT_TRUE(std::getline(right, y));
    if (!timed(x)) {
      EXPECT_EQ(x, y);
    }
  }
}

}  // namespace puffin
