#pragma once
// The loop of a run: steps, outputs, health, checkpoints, and the way back from a failure.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "coupling/checkpoint/checkpoint.hpp"
#include "coupling/health.hpp"
#include "tools/puffin/checkpoint_store.hpp"
#include "tools/puffin/progress.hpp"
#include "tools/puffin/recorder.hpp"

namespace puffin::tools {

/// What a run remembers of itself across checkpoints.
struct RunMemory {
  double wall_clock = 0.0;            // [s] of the parts before this one
  double output = 0.0;                // [s] of these, spent on writing
  std::int32_t retreats = 0;          // from failures
  std::vector<std::string> warnings;  // of the start, then one a retreat
};

/// How the loop came to its end.
struct Ending {
  std::string state = "finished", message;  // as in summary.json
  int code = 0;
  bool goes_on = false;  // finished at --until, before the stop time of the case: there is a checkpoint
};

class Stepping {
 public:
  /// resume: go on from the newest checkpoint of the folder. `start`: of the program, from which `walltime` [s] counts.
  /// `until`: the run ends there [s] if its stop time is later. Throws as CheckpointStore and Recorder.
  Stepping(cases::Simulation& s, const output::OutputFolder& folder, bool quiet,
           std::chrono::steady_clock::time_point start, double walltime, double until);

  /// Steps until the end, a signal, the wall time or a failure. After a failure the last good state is restored and the
  /// time step halved, at most three times; every hundred steps the health of the state is asked for, and every five
  /// hundred it is remembered. A step whose contacts take longer than ten seconds is given up for a signal or the wall
  /// time. Before it returns a code other than 0 there is a checkpoint of the last good state.
  Ending run();
  /// Writes what belongs to the end of the outputs.
  void finish(const Ending& ending);
  /// When summary.json is written: what only a run that goes on needs is removed.
  void close(const Ending& ending);

  const Recorder& recorder() const { return *recorder_; }
  const RunMemory& memory() const { return memory_; }
  double output_seconds() const { return output_seconds_; }

 private:
  void step();
  void look_after();
  void remember(coupling::Checkpoint& checkpoint) const;
  void write_checkpoint(coupling::Checkpoint& checkpoint);
  bool retreat(const std::string& why);
  void reopen_outputs();
  void get_ready();
  bool shall_stop() const;
  Ending stop();
  double wall_clock() const;
  std::int64_t steps() const;

  cases::Simulation& s_;
  const output::OutputFolder& folder_;
  std::chrono::steady_clock::time_point start_;
  double walltime_;
  bool shortened_;  // --until comes before the stop time of the case
  coupling::Health health_;
  CheckpointStore store_;
  RunMemory memory_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Progress> progress_;
  coupling::Checkpoint good_;         // the last good state
  coupling::Checkpoint before_slow_;  // before the present step, if the one before it took long
  double step_began_ = 0.0;           // [s] of wall_clock()
  double spent_before_ = 0.0;         // [s] of the carriers, before the present step
  std::int64_t checked_ = 0, remembered_ = 0, advanced_ = 0;
  double output_seconds_ = 0.0;
};

}  // namespace puffin::tools
