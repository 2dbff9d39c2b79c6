#include "tools/puffin/available_memory.hpp"

#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace puffin::tools {
namespace {

namespace fs = std::filesystem;
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number after a word of a file of lines "word number"; infinity if it is not there.
double number_of(const fs::path& file, const std::string& word) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(word)) try {
        return std::stod(line.substr(word.size()));
      } catch (const std::exception&) {
        return unlimited;
      }
  return unlimited;
}

/// Without /proc what no one uses, caches not counted: less than what is available.
double of_the_machine() {
  const double available = 1024.0 * number_of("/proc/meminfo", "MemAvailable:");
  if (struct sysinfo info{}; available == unlimited && sysinfo(&info) == 0)
    return static_cast<double>(info.freeram) * info.mem_unit;
  return available;
}

double of_the_process() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const double used = 1024.0 * number_of("/proc/self/status", "VmSize:");
  return static_cast<double>(limit.rlim_cur) - (used == unlimited ? 0.0 : used);
}

/// What a control group leaves; caches of files that are not in use give way. A group without limit says "max", or a
/// number beyond any machine.
double of_group(const fs::path& group, const char* most, const char* now) {
  const double limit = number_of(group / most, ""), used = number_of(group / now, "");
  const double caches = number_of(group / "memory.stat", "inactive_file ");
  if (limit == unlimited || used == unlimited) return unlimited;
  return limit - used + (caches == unlimited ? 0.0 : caches);
}

double of_the_groups() {
  double least = unlimited;
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const bool second = line.starts_with("0::");
    const auto names = line.find(':'), path = line.find(":/");
    if (path == std::string::npos || (!second && line.substr(names, path - names).find("memory") == std::string::npos))
      continue;
    const fs::path root = second ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    for (fs::path group = root / fs::path(line.substr(path + 1)).relative_path();; group = group.parent_path()) {
      least = std::min(least, second ? of_group(group, "memory.max", "memory.current")
                                     : of_group(group, "memory.limit_in_bytes", "memory.usage_in_bytes"));
      if (group == root || !group.has_relative_path()) break;
    }
  }
  return least;
}

}  // namespace

double available_memory() { return std::max(0.0, std::min({of_the_machine(), of_the_process(), of_the_groups()})); }

}  // namespace puffin::tools
