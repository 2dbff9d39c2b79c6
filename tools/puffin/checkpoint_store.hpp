#pragma once
// The checkpoints folder of a run: when one is due, writing, keeping the newest, finding one to go on from.

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "cases/build.hpp"
#include "coupling/checkpoint/file.hpp"
#include "tools/output/output_folder.hpp"

namespace puffin::tools {

class CheckpointStore {
 public:
  CheckpointStore(const cases::Simulation& s, const output::OutputFolder& folder);

  /// True once every output.checkpoint.wall of wall-clock time.
  bool due() const;
  /// Writes it with what identifies the case, and removes all but the newest output.checkpoint.keep. Throws
  /// std::system_error if the disk refuses; older checkpoints are then still there.
  void write(coupling::Checkpoint& checkpoint);
  /// Gives the newest sound checkpoint to `use`, which may throw CheckpointDamaged; damaged ones are named in the log
  /// and the next older is taken. Throws output::OutputError if none is sound, coupling::CheckpointForeign if it
  /// belongs to another case, version or lattice. Nothing longer than `longest` [byte] is read.
  void restore_newest(std::size_t longest, const std::function<void(const coupling::Checkpoint&)>& use);

 private:
  void require_same_case(const coupling::Checkpoint& checkpoint) const;

  const output::OutputFolder& folder_;
  std::string identity_;  // lines that must be equal
  double interval_;       // [s]
  int keep_;
  std::int64_t next_number_ = 1;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Whether this is what restore_newest has thrown, which no later try of the same kind can mend.
bool cannot_go_on(std::string_view message);

/// One line for each value that the course of the simulation depends on: the resolved case without what may change
/// between two parts of a run (threads, stop time, checkpoints, reference values), version, surface, lattice.
std::string identity_of(const cases::Simulation& s);

}  // namespace puffin::tools
