#pragma once
// The finished contacts of a run that is still going on: plain records, one behind the other, that survive a kill.

#include <filesystem>
#include <fstream>
#include <optional>
#include <span>

#include "tools/output/events_file.hpp"
#include "tools/output/replay_tables.hpp"

namespace puffin::output {

/// Append-only. A head tells the size of a record; every record before the last sync() survives a power failure, every
/// one before the last flush() a kill.
class EventsJournal {
 public:
  /// keep: go on with an existing journal after its first so many records and drop the rest. Throws OutputError if the
  /// file cannot be written or, on resuming, is shorter or of another version.
  explicit EventsJournal(std::filesystem::path file, std::optional<std::int64_t> keep = {});

  /// Throws OutputError if the disk refuses.
  void append(std::span<const EventRecord> records);
  void flush();
  void sync();
  /// Records so far.
  std::int64_t size() const { return size_; }

  /// All records, then `more`, and `tables` if given, as events.h5, which is replaced whole or not at all. Throws
  /// OutputError.
  void write_events(const std::filesystem::path& events, std::span<const EventRecord> more,
                    const ReplayTables* tables = nullptr);

 private:
  void check() const;

  std::filesystem::path file_;
  std::ofstream stream_;
  std::int64_t size_ = 0;
};

}  // namespace puffin::output
