#include "tools/puffin/thread_limit.hpp"

#include <latch>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {

void require_threads(int wanted) {
  if (wanted <= static_cast<int>(std::thread::hardware_concurrency())) return;
  std::latch all_tried(1);
  std::vector<std::jthread> threads;  // joined at the end of the scope, after the latch opened
  threads.reserve(static_cast<std::size_t>(wanted));
  try {
    while (static_cast<int>(threads.size()) < wanted) threads.emplace_back([&all_tried] { all_tried.wait(); });
    all_tried.count_down();
  } catch (const std::system_error& e) {
    all_tried.count_down();
    throw ResourceError(std::to_string(wanted) + " threads cannot be started (" + e.code().message() +
                        "); take fewer (--threads, numerics.threads)");
  }
}

}  // namespace puffin::tools
