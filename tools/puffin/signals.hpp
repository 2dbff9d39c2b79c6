#pragma once
// SIGTERM and Ctrl-C: noted, and looked for where a run can stop.

namespace puffin::tools {

/// While one lives, SIGTERM and Ctrl-C are only noted; then they do again what they did before. Of several, one within
/// another (a run within a benchmark), the outermost counts.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// SIGTERM, SIGINT, or 0: the last that came since the outermost Signals began. Any thread may ask.
  static int received();
  /// What the program ends with for the signal received: `interrupted` or `stopped`; `ok` if none came.
  static int code();

 private:
  void (*terminate_)(int);
  void (*interrupt_)(int);
};

}  // namespace puffin::tools
