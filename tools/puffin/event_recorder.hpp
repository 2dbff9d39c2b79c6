#pragma once
// The contacts of a run, each with the fines it moved: a journal while it goes on, events.h5 at its end.

#include <cstdint>
#include <optional>
#include <vector>

#include "cases/build.hpp"
#include "tools/output/events_journal.hpp"
#include "tools/output/output_folder.hpp"
#include "tools/puffin/recorder_state.hpp"

namespace puffin::tools {

class EventRecorder {
 public:
  /// resume: go on with the journal from where it was then. Throws OutputError if it is shorter.
  EventRecorder(const output::OutputFolder& folder, const RecorderState* resume);

  /// Reads the contacts of the exchange that has just been done.
  void take(const cases::Simulation& s);
  /// Its part of a checkpoint.
  void save(RecorderState& state) const;
  /// Everything so far is on the disk.
  void sync();
  /// Writes events.h5, with the contacts that go on as if they ended now.
  void finish(const cases::Simulation& s);
  /// Removes the journal, which only a resumed run would need. The last call.
  void forget_journal();

 private:
  std::vector<output::EventRecord> open_contacts(const cases::Simulation& s) const;

  const output::OutputFolder& folder_;
  std::optional<output::EventsJournal> journal_;
  MovedFines moved_;        // by contacts that are not over yet
  std::int64_t begun_ = 0;  // contacts so far
};

}  // namespace puffin::tools
