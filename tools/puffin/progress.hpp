#pragma once
// How far a run is: on the terminal and in status.json.

#include <chrono>

#include "cases/build.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/recorder.hpp"

namespace puffin::tools {

/// A line that is rewritten on a terminal, plain lines elsewhere, nothing if quiet; status.json (every second) and
/// index.html (every three) always.
class Progress {
 public:
  Progress(const cases::Simulation& s, const output::OutputFolder& folder, bool quiet);

  void update(const Recorder& recorder, const std::vector<std::string>& warnings, bool now);
  void finish() const;

 private:
  const char* phase() const;
  double work(double t) const;

  const cases::Simulation& sim_;
  const output::OutputFolder& folder_;
  double end_;  // [s]
  bool quiet_, terminal_;
  std::chrono::steady_clock::time_point start_;
  double last_ = -1e9, last_page_ = -1e9, last_line_ = -1e9;  // [s] of wall clock
  double begun_at_;  // work done before, by the part of the run that this one resumes
};

/// status.json of a run that has only just got its folder, so that what follows is known to be a run.
void announce(const output::OutputFolder& folder, const std::string& name, double end_time);

/// How the run ended, in status.json and on its page. wall_clock: of summary.json [s]; 0: as it stands. state
/// "finished" leaves nothing to go.
void close_status(const output::OutputFolder& folder, const std::string& state,
                  const std::vector<output::HistoryRow>& history, double wall_clock = 0.0);

/// The same for a run that an exception ends, as far as it can still be written (on a full disk it cannot) and it was
/// not closed before.
void close_failed(const output::OutputFolder& folder, const std::vector<output::HistoryRow>& history) noexcept;

}  // namespace puffin::tools
