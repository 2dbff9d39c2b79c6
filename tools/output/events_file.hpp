#pragma once
// events.h5: every finished contact of a run, enough to evaluate the fines again without air and carriers.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace puffin::output {

struct EventRecord {
  double time_start = 0.0;        // first touch [s]
  double time_end = 0.0;          // separation, or the end of the run [s]
  std::int32_t a = -1;            // carrier
  std::int32_t b = -1;            // other carrier; -1: a wall
  std::int32_t triangle = -1;     // triangle of the wall; -1: a carrier
  double normal_speed = 0.0;      // at first touch [m/s]
  double tangential_speed = 0.0;  // at first touch [m/s]
  double energy = 0.0;            // 1/2 m v^2 of a single carrier [J]
  double max_force = 0.0;         // [N]
  double max_overlap = 0.0;       // [m]
  double detached = 0.0;          // fines that left a carrier [number, of single carriers]
  double attached = 0.0;          // of these, fines that stayed on the wall
  // for a replay with other micro-models
  double angle = 90.0;                    // between velocity and surface [degrees]; 90: head on
  double order = -1.0;                    // contacts that began before it; -1: not known
  double drag_a = 0.0, drag_b = 0.0;      // fines that drag asked for since the partner's last contact
  std::int32_t a_loses = 0, b_loses = 0;  // 1: counted, and with air in reach: the partner could lose fines
};

/// Data set /events (compound, chunked, shuffled and deflated); attributes of the root: format = "puffin-events",
/// format_version = 1. Records are collected and written in blocks. A kill can leave such a file unreadable, so while a
/// run goes on its records are in an EventsJournal.
class EventsFile {
 public:
  /// Throws OutputError if the file cannot be written.
  explicit EventsFile(const std::filesystem::path& file);
  ~EventsFile();
  EventsFile(EventsFile&&) noexcept;
  EventsFile& operator=(EventsFile&&) noexcept;

  /// Throws OutputError if the disk refuses.
  void append(std::span<const EventRecord> records);
  void flush();
  /// Records so far, written or collected.
  std::int64_t size() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Throws OutputError if the file is missing, damaged or of another format.
std::vector<EventRecord> read_events(const std::filesystem::path& file);

}  // namespace puffin::output
