#include "tools/puffin/batch/pool.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>

namespace puffin::tools {

Child::Child(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  // Everything that allocates is done before the fork: other threads may hold the allocator's lock.
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string log_name = log.string();
  const pid_t parent = getpid();
  // Held up until the child has no handler of ours any more: what came between fork and exec would be noted and
  // forgotten.
  sigset_t held, before;
  sigemptyset(&held);
  sigaddset(&held, SIGTERM);
  sigaddset(&held, SIGINT);
  pthread_sigmask(SIG_BLOCK, &held, &before);
  pid_ = fork();
  const int failed = errno;
  if (pid_ == 0) {
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGINT, SIG_DFL);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (pid_ < 0) throw std::system_error(failed, std::generic_category(), "cannot start a run");
  if (pid_ > 0) return;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(75);  // the batch died in between
  setpgid(0, 0);                       // Ctrl-C reaches the batch alone, which stops its runs in order
  const int null = open("/dev/null", O_RDWR);
  const int text = open(log_name.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  dup2(null, STDIN_FILENO);
  dup2(null, STDOUT_FILENO);
  dup2(text >= 0 ? text : null, STDERR_FILENO);
  execv(argv[0], argv.data());
  _exit(1);
}

std::optional<int> Child::ended() {
  int status = 0;
  const pid_t result = waitpid(pid_, &status, WNOHANG);
  if (result == 0) return std::nullopt;
  if (result < 0) return 1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void Child::terminate() const { kill(pid_, SIGTERM); }

std::string last_line(const std::filesystem::path& log) {
  std::ifstream stream(log);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) last = line;
  return last.substr(0, 400);
}

int threads_for_next(int free_cores, int free_places, int waiting) {
  const int starting = std::max(1, std::min(free_places, waiting));
  return std::max(1, free_cores / starting);
}

}  // namespace puffin::tools
