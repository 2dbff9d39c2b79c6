#include "tools/puffin/signals.hpp"

#include <atomic>
#include <csignal>

namespace puffin::tools {
namespace {

std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may write nothing else");

void note(int number) { noted = number; }

}  // namespace

Signals::Signals() {
  noted = 0;
  terminate_ = std::signal(SIGTERM, note);
  interrupt_ = std::signal(SIGINT, note);
}

Signals::~Signals() {
  std::signal(SIGTERM, terminate_);
  std::signal(SIGINT, interrupt_);
}

int Signals::received() { return noted; }

}  // namespace puffin::tools
