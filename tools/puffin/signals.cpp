#include "tools/puffin/signals.hpp"

#include <atomic>
#include <csignal>

#include "tools/puffin/exit_codes.hpp"

namespace puffin::tools {
namespace {

std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may write nothing else");

void note(int number) { noted = number; }

int alive = 0;  // Signals, all of one thread

}  // namespace

Signals::Signals() {
  if (alive++ == 0) noted = 0;
  terminate_ = std::signal(SIGTERM, note);
  interrupt_ = std::signal(SIGINT, note);
}

Signals::~Signals() {
  std::signal(SIGTERM, terminate_);
  std::signal(SIGINT, interrupt_);
  --alive;
}

int Signals::received() { return noted; }

int Signals::code() {
  const int signal = noted;
  return signal == 0 ? ok : (signal == SIGINT ? interrupted : stopped);
}

}  // namespace puffin::tools
