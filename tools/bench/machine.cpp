#include "tools/bench/machine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

#include "lbm/kernel.hpp"

namespace puffin::bench {

Machine describe_machine(const std::string& commit) {
  Machine m;
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; m.processor.empty() && std::getline(in, line);)
    if (line.rfind("model name", 0) == 0) m.processor = line.substr(line.find(':') + 2);
  m.isa = lbm::name(lbm::detect_isa());
  m.cores = static_cast<int>(std::thread::hardware_concurrency());
  m.commit = commit;
  return m;
}

ForeignLoad::Ticks ForeignLoad::now() {
  Ticks t;
  std::ifstream in("/proc/stat");
  std::string line;
  std::getline(in, line);  // cpu user nice system idle iowait irq softirq steal ...
  std::istringstream words(line.substr(4));
  double value = 0.0;
  for (int k = 0; k < 8 && words >> value; ++k) {
    t.all += value;
    if (k != 3 && k != 4) t.busy += value;
  }
  const auto seconds = [](const timeval& v) { return static_cast<double>(v.tv_sec) + 1e-6 * v.tv_usec; };
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    t.own += (seconds(usage.ru_utime) + seconds(usage.ru_stime)) * static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  return t;
}

ForeignLoad::ForeignLoad() : start_(now()) {}

double ForeignLoad::share() const {
  const Ticks end = now();
  const double all = end.all - start_.all;
  if (all <= 0.0) return 0.0;
  return std::max(0.0, (end.busy - start_.busy - (end.own - start_.own)) / all);
}

}  // namespace puffin::bench
