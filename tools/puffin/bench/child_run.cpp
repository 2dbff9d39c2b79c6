#include "tools/puffin/bench/child_run.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tools/bench/machine.hpp"
#include "tools/puffin/batch/pool.hpp"
#include "tools/puffin/exit_codes.hpp"
#include "tools/puffin/signals.hpp"
#include "tools/puffin/verify_run.hpp"

namespace puffin::tools {
namespace {

/// Of all children that have ended.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& v) { return static_cast<double>(v.tv_sec) + 1e-6 * v.tv_usec; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

ChildRun run_child(const std::filesystem::path& case_file, const std::vector<cases::Override>& sets,
                   const std::filesystem::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> words{"run", case_file.string(), "--out", folder.string(), "--quiet", "--no-report"};
  for (const cases::Override& o : sets) {
    words.emplace_back("--set");
    words.push_back(o.key + "=" + o.value);
  }
  words.insert(words.end(), more.begin(), more.end());
  const std::filesystem::path log = folder.string() + ".log";
  ChildRun run;
  const bench::ForeignLoad load;
  const double spent = processor_seconds();
  const auto start = std::chrono::steady_clock::now();
  Child child(words, log);
  std::optional<int> code;
  bool told = false;
  while (!(code = child.ended())) {
    if (!told && Signals::received() != 0) child.terminate(), told = true;  // Ctrl-C does not reach it
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (Signals::received() != 0) throw BenchStopped{};
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.processor_seconds = processor_seconds() - spent;
  run.foreign_load = load.share();
  run.exit_code = *code;
  if (run.exit_code == ok)
    run.output = read_run(folder);
  else
    run.problem = last_line(log);
  return run;
}

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_(std::filesystem::temp_directory_path() / (name + "-" + std::to_string(static_cast<long>(getpid())))) {
  std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::fresh() { return path_ / std::to_string(++count_); }

}  // namespace puffin::tools
