#pragma once
// A time series that ParaView opens: NAME.pvd and one zlib-compressed VTK file a moment beside it.

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/output/frames.hpp"

namespace puffin::output {

struct SeriesEntry {
  double time = 0.0;  // [s]
  int part = 0;       // several regions of one moment are parts 0, 1, ...
  std::string file;   // relative to the folder of the .pvd
};

/// Writes folder/NAME.pvd and folder/NAME_000000[_part].vti|vtp. Every file appears under a temporary name and is then
/// renamed, the data before the .pvd: whatever moment the program is killed at, the .pvd names complete files only.
/// Nothing waits for the disk before sync(), as a small frame is written a hundred times faster than synced.
class VtkSeries {
 public:
  /// keep: go on with an existing series after its first so many entries and remove the rest; absent: start anew.
  /// Throws OutputError if the existing series is shorter.
  VtkSeries(std::filesystem::path folder, std::string name, std::optional<std::size_t> keep = {});

  void append(double time, const FieldFrame& frame, int part = 0);
  void append(double time, const CarrierFrame& frame, int part = 0);
  void append(double time, const WallFrame& frame, int part = 0);

  /// Puts all frames so far onto the disk. Throws OutputError.
  void sync();

  const std::vector<SeriesEntry>& entries() const { return entries_; }

 private:
  std::string next_file(double time, int part, const char* extension);
  void commit(double time, int part, const std::string& file);

  std::filesystem::path folder_;
  std::string name_;
  std::vector<SeriesEntry> entries_;
  std::set<std::filesystem::path> unsynced_;
  int next_number_ = 0;
};

/// Single frames. The array names are those of the interface: `velocity`, `pressure`, `fines_<scalar>`, `fluid`;
/// `id`, `diameter`, `velocity`, `spin`, `fines`, `asleep`; `fines`, `hits`, `energy`, `patch`.
/// Throw OutputError if the file cannot be written, std::invalid_argument if the arrays disagree in length.
void write_vti(const std::filesystem::path& file, const FieldFrame& frame);
void write_vtp(const std::filesystem::path& file, const CarrierFrame& frame);
void write_vtp(const std::filesystem::path& file, const WallFrame& frame);

/// The way back. Throw OutputError if a file is missing or damaged.
std::vector<SeriesEntry> read_pvd(const std::filesystem::path& file);
FieldFrame read_field_frame(const std::filesystem::path& file);
CarrierFrame read_carrier_frame(const std::filesystem::path& file);
WallFrame read_wall_frame(const std::filesystem::path& file);

}  // namespace puffin::output
