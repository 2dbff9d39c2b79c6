#include "tools/puffin/thread_limit.hpp"

#include <latch>
#include <new>
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
  struct Opening {
    std::latch& latch;
    ~Opening() { latch.count_down(); }
  } const opening{all_tried};  // however the scope is left, before the threads are joined
  try {
    threads.reserve(static_cast<std::size_t>(wanted));
    while (static_cast<int>(threads.size()) < wanted) threads.emplace_back([&all_tried] { all_tried.wait(); });
  } catch (const std::system_error& e) {
    throw ResourceError(std::to_string(wanted) + " threads cannot be started (" + e.code().message() +
                        "); take fewer (--threads, numerics.threads)");
  } catch (const std::bad_alloc&) {
    throw ResourceError(std::to_string(wanted) +
                        " threads cannot be started (no memory for them); take fewer "
                        "(--threads, numerics.threads)");
  }
}

}  // namespace puffin::tools
