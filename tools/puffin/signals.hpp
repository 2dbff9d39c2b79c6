#pragma once
// SIGTERM and Ctrl-C: noted, and looked for where a run can stop.

namespace puffin::tools {

/// While one lives, SIGTERM and Ctrl-C are only noted; then they do again what they did before.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// SIGTERM, SIGINT, or 0: the last that came since the newest Signals began. Any thread may ask.
  static int received();

 private:
  void (*terminate_)(int);
  void (*interrupt_)(int);
};

}  // namespace puffin::tools
